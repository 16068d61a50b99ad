"""From what happened in an episode to rows of the five tables. Runs once an episode, off the hot path."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from attnlab.arithmetic import total
from attnlab.attention import Looks
from attnlab.cycle import Agent
from attnlab.needs.base import Body
from attnlab.probes.base import Lived, Probe, Values
from attnlab.robot.guards import check_commands, check_log
from attnlab.robot.identities import check_balance, check_clock, check_safety
from attnlab.robot.observers import Observers
from attnlab.robot.summaries import bouts, distances, guard_of, held, in_order, safety, safety_held, turning
from attnlab.tables.schema import CELL_M
from attnlab.worlds.base import Layout

Tables = dict[str, dict[str, list[Any]]]  # table -> column -> values


class Recorder:
    """Collects rows of one run as lists by column; ``tables`` is handed to the writer at the end. Probes add columns,
    observers are told of every episode."""

    def __init__(self, run: str, seed: int, curiosity: str, swept: dict[str, Any], layout: Layout, check: bool,
                 probes: Sequence[Probe] = (), observers: Observers | None = None):
        self.probes, self.observers = probes, observers or Observers()
        self.run_columns = {"run": run, "seed": seed, "curiosity": curiosity}
        self.swept, self.check, self.layout = swept, check, layout
        self.tables: Tables = {name: defaultdict(list) for name in
                                                   ("episodes", "behaviours", "policy", "cycles", "coverage")}
        self._cells = (int(np.ceil(layout.width_m / CELL_M - 1e-9)), int(np.ceil(layout.depth_m / CELL_M - 1e-9)))
        self._visits: dict[str, npt.NDArray[np.int64]] = {}

    def _add(self, table: str, **row: Any) -> None:
        columns = self.tables[table]
        for name, value in row.items():
            columns[name].append(value)

    def episode(self, agent: Agent, phase: str, episode: int, death: str | None, penalties: list[float], full: bool
                ) -> None:
        """Rows of one episode; ``full`` stores its cycles too."""
        body, n, moments = agent.body, agent.simulator.cycle, agent.history.columns()
        looks = [attention.log.columns() for attention in agent.attentions]
        reached = moments[:, 0].astype(np.int64)
        lengths = np.diff(reached)
        remaining = np.repeat(reached[1:], lengths) - np.arange(n) - 1
        energy = np.repeat(moments[1:, 2], lengths) + body.e_u * remaining
        needs = {need.name: np.repeat(moments[1:, 3 + i], lengths) - need.per_cycle * remaining
                 for i, need in enumerate(body.needs)}
        path = agent.simulator.trace[:n + 1]
        safe, safe_held = self._safety(agent, looks, path[1:])
        steps = np.diff(path[:, :2], axis=0)
        if self.check:
            _check_energy(body, moments, lengths)
            check_commands(agent)
            for attention, seen in zip(agent.attentions, looks, strict=True):
                check_log(attention)
                check_clock(seen.cycle, seen.period, n)
        wanting = held(looks[0], n, looks[0].wanting)
        added: dict[str, dict[str, Any]] = {"episodes": {}, "behaviours": {}, "cycles": {}}
        if self.probes or self.observers:
            lived = _lived(agent, phase, episode, death, path, energy, wanting, safe, safe_held, needs)
            for probe in self.probes:
                added[probe.table] |= probe.checked(lived)
            self.observers.episode(lived)
        means = {f"{name}_{what}": float(values.mean() if what == "mean" else values.max())
                 for name, values in needs.items() for what in ("mean", "max")}
        self._add("episodes", **self.run_columns, phase=phase, episode=episode, cycles=n,
                  survival=n / agent.max_cycles, death=death or "none", active_cycles=len(lengths),
                  meals=_meals(body, "hunger"), drinks=_meals(body, "thirst"),
                  **_of("safety", safe), **_of("safety_held", safe_held),
                  energy_mean=float(energy.mean()), energy_min=float(energy.min()), energy_max=float(energy.max()),
                  **{"hunger_mean": None, "hunger_max": None, "thirst_mean": None, "thirst_max": None, **means},
                  wanting_mean=float(wanting.mean()), path_m=float(_lengths(steps[:, 0], steps[:, 1]).sum()),
                  turn_rad=turning(path), **bouts(_meal_times(body, needs)), **self.swept, **added["episodes"])
        for attention, seen, penalty in zip(agent.attentions, looks, penalties, strict=True):
            mine = {name: values[attention.behaviour.name] for name, values in added["behaviours"].items()}
            self._behaviour(attention.behaviour.name, seen, phase, episode, penalty, mine)
        self._cover(phase, path[1:])
        if full:
            self._cycles(agent, looks, phase, episode, path[1:], needs, energy, wanting,
                         {"safety": safe, "safety_held": safe_held}, added["cycles"])

    def _safety(self, agent: Agent, looks: list[Looks], path: Values) -> tuple[Values | None, Values | None]:
        """Eq (13) in every cycle: from the true distance, and from what AVOID last perceived; None if nobody answers
        for crashes."""
        guard, n = guard_of(agent.attentions), len(path)
        if guard is None:
            return None, None
        seen = looks[agent.attentions.index(guard)]
        both = safety(guard, seen, distances(path, self.layout)), safety_held(guard, seen, n)
        if self.check:
            for values in both:
                check_safety(float(values.mean()), n, len(seen.cycle), max(guard.periods), min(guard.periods))
        return both

    def _behaviour(self, name: str, looks: Looks, phase: str, episode: int, penalty: float, added: dict[str, Any]
                   ) -> None:
        n, paid = len(looks.cycle), ~np.isnan(looks.reward)
        self._add("behaviours", **self.run_columns, phase=phase, episode=episode, behaviour=name, activations=n,
                  releases=int(np.count_nonzero(looks.released)), reward=in_order(looks.reward[paid]),
                  reward_extrinsic=in_order(looks.extrinsic[paid]), penalty=penalty,
                  liking_mean=in_order(looks.liking) / n, period_mean=in_order(looks.period) / n,
                  **self.swept, **added)

    def _cover(self, phase: str, path: Values) -> None:
        nx, ny = self._cells
        i = np.clip((path[:, 0] / CELL_M).astype(np.int64), 0, nx - 1)
        j = np.clip((path[:, 1] / CELL_M).astype(np.int64), 0, ny - 1)
        visits = np.bincount(i * ny + j, minlength=nx * ny)
        self._visits[phase] = self._visits.get(phase, 0) + visits

    def _cycles(self, agent: Agent, looks: list[Looks], phase: str, episode: int, path: Values,
                needs: dict[str, Values], energy: Values, wanting: Values, safeties: dict[str, Values | None],
                added: dict[str, Any]) -> None:
        n, dt = len(path), agent.simulator.dt_s
        before = agent.simulator.trace[:n]
        turn = (path[:, 2] - before[:, 2] + np.pi) % (2 * np.pi) - np.pi
        columns = self.tables["cycles"]
        rows: dict[str, Any] = {"run": [self.run_columns["run"]] * n, "phase": [phase] * n, "episode": [episode] * n,
                "cycle": range(n), "x_m": path[:, 0], "y_m": path[:, 1], "heading_rad": path[:, 2],
                "v_m_s": _lengths(path[:, 0] - before[:, 0], path[:, 1] - before[:, 1]) / dt, "w_rad_s": turn / dt,
                "hunger": needs.get("hunger", [None] * n), "thirst": needs.get("thirst", [None] * n),
                "energy": energy, "wanting": wanting,
                **{name: [None] * n if values is None else values for name, values in safeties.items()}}
        rows.update({name: values for name, values in needs.items() if name not in rows})
        for attention, seen in zip(agent.attentions, looks, strict=True):
            name, levels, active = attention.behaviour.name, attention.curiosity.levels, np.zeros(n, bool)
            active[seen.cycle] = True
            rows[f"{name}_active"] = active
            rows[f"{name}_period"] = held(seen, n, seen.period)
            rows[f"{name}_percept"] = held(seen, n, seen.percept + 1)
            rows[f"{name}_level"] = [levels[int(i)] for i in held(seen, n, seen.level)]
        rows |= added
        for name, values in rows.items():
            columns[name].extend(values.tolist() if isinstance(values, np.ndarray) else values)

    def finish(self, agent: Agent) -> Tables:
        """All tables, with what was learned and where the robot has been."""
        run = self.run_columns["run"]
        for attention in agent.attentions:
            learner, periods = attention.learner, attention.periods
            states = ((level, period, percept + 1) for level in attention.curiosity.levels for period in periods
                      for percept in range(attention.bins))
            for state, (level, period, percept) in enumerate(states):
                for action, (q, visits) in enumerate(zip(learner.values(state), learner.visits[state], strict=True)):
                    self._add("policy", run=run, behaviour=attention.behaviour.name, curiosity_level=level,
                              period=period, percept=percept, action=periods[action], q=q, visits=visits)
        for phase, cells in self._visits.items():
            for cell in np.flatnonzero(cells).tolist():
                self._add("coverage", run=run, phase=phase, x_cell=cell // self._cells[1],
                          y_cell=cell % self._cells[1], visits=int(cells[cell]))
        return self.tables


def _lived(agent: Agent, phase: str, episode: int, death: str | None, path: Values, energy: Values, wanting: Values,
           safety: Values | None, safety_held: Values | None, needs: Mapping[str, Values]) -> Lived:
    """The episode as those see it who only look: arrays that cannot be written to."""
    def fixed(values: Values) -> Values:
        view = values.view()
        view.flags.writeable = False
        return view
    return Lived(phase, episode, agent.simulator.cycle, agent.max_cycles, death, fixed(path), fixed(energy),
                 fixed(wanting), None if safety is None else fixed(safety),
                 None if safety_held is None else fixed(safety_held),
                 {name: fixed(values) for name, values in needs.items()},
                 {a.behaviour.name: a.log.looks() for a in agent.attentions})


def _check_energy(body: Body, moments: Values, lengths: Values) -> None:
    """The balance of energy and needs, unless one of them grows by itself or is cut."""
    if body.reading.energy_clipped or body.reading.needs_floored:
        return
    feeding = [i for i, need in enumerate(body.needs) if need.feeds_energy]
    if not any(body.needs[i].per_cycle for i in feeding):
        balance = moments[:, 2] + moments[:, [3 + i for i in feeding]].sum(axis=1)
        growth = total(body.needs[i].per_activation for i in feeding)
        check_balance(balance, body.e_u, body.e_nb, growth, moments[1:, 1], lengths)


def _lengths(x: Values, y: Values) -> Values:
    """Of vectors (x, y), elementwise; not np.hypot, which is the C library's."""
    return np.sqrt(x * x + y * y)


def _of(name: str, values: Values | None) -> dict[str, float | None]:
    """Mean, smallest and largest of a series, as columns."""
    return {f"{name}_{what}": None if values is None else float(getattr(values, what)())
            for what in ("mean", "min", "max")}


def _meal_times(body: Body, needs: Mapping[str, Values]) -> dict[str, list[int]]:
    """When each need that food or water satisfies fell (cycles), from its values after each cycle."""
    return {need.name: np.flatnonzero(np.diff(needs[need.name], prepend=need.start) < 0).tolist()
            for need in body.needs if need.feeds_energy}


def _meals(body: Body, need: str) -> int | None:
    return body.meals[body.index[need]] if need in body.index else None
