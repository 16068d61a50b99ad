"""From what happened in an episode to rows of the five tables. Runs once an episode, off the hot path."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from attnlab.cycle import Agent
from attnlab.needs.base import Body
from attnlab.probes.base import Lived, Probe, Values
from attnlab.robot.guards import check_commands
from attnlab.robot.identities import check_safety
from attnlab.robot.observers import Observers
from attnlab.robot.quick import Quick
from attnlab.robot.series import Brief, Series, lengths
from attnlab.robot.summaries import bouts, guard_of, held
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

    def episode(self, agent: Agent, phase: str, episode: int, death: str | None, penalties: list[float], full: bool,
                quick: Quick | None = None) -> None:
        """Rows of one episode; ``full`` stores its cycles too. ``quick``: compiled code that may say the rest."""
        visits = self._visits.setdefault(phase, np.zeros(self._cells, np.int64))
        brief = quick(self.check, visits) if quick and not (full or self.probes or self.observers) else None
        if self.check:
            check_commands(agent)
        added: dict[str, dict[str, Any]] = {"episodes": {}, "behaviours": {}, "cycles": {}}
        if brief is None:
            series = Series(agent, self.layout)
            if self.check:
                series.check()
            brief = series.brief()
            if series.placed:
                self._cover(visits, series.path[1:])
            if self.probes or self.observers:
                lived = _lived(series, phase, episode, death)
                for probe in self.probes:
                    added[probe.table] |= probe.checked(lived)
                self.observers.episode(lived)
            if full:
                self._cycles(series, phase, episode, added["cycles"])
        if self.check:
            self._check_safety(agent, brief)
        self._episode(agent, brief, phase, episode, death, added["episodes"])
        for attention, acts, penalty in zip(agent.attentions, brief.acts, penalties, strict=True):
            name = attention.behaviour.name
            self._add("behaviours", **self.run_columns, phase=phase, episode=episode, behaviour=name,
                      activations=acts.activations, releases=acts.releases, reward=acts.reward,
                      reward_extrinsic=acts.reward_extrinsic, penalty=penalty, liking_mean=acts.liking_mean,
                      period_mean=acts.period_mean, **self.swept,
                      **{column: values[name] for column, values in added["behaviours"].items()})

    def _episode(self, agent: Agent, brief: Brief, phase: str, episode: int, death: str | None,
                 added: Mapping[str, Any]) -> None:
        body, n, nothing = agent.body, agent.simulator.cycle, (None, None, None)
        three = {"safety": brief.safety or nothing, "safety_held": brief.safety_held or nothing,
                 "energy": brief.energy}
        two = {"hunger": (None, None), "thirst": (None, None), **brief.needs}
        self._add("episodes", **self.run_columns, phase=phase, episode=episode, cycles=n,
                  survival=n / agent.max_cycles, death=death or "none", active_cycles=brief.active_cycles,
                  meals=_meals(body, "hunger"), drinks=_meals(body, "thirst"),
                  **{f"{name}_{what}": value for name, values in three.items()
                     for what, value in zip(("mean", "min", "max"), values, strict=True)},
                  **{f"{name}_{what}": value for name, values in two.items()
                     for what, value in zip(("mean", "max"), values, strict=True)},
                  wanting_mean=brief.wanting_mean, path_m=brief.path_m, turn_rad=brief.turn_rad, **bouts(brief.fell),
                  **self.swept, **added)

    def _check_safety(self, agent: Agent, brief: Brief) -> None:
        guard = guard_of(agent.attentions)
        for values in (brief.safety, brief.safety_held):
            if guard is not None and values is not None:
                activations = brief.acts[agent.attentions.index(guard)].activations
                check_safety(values[0], agent.simulator.cycle, activations, max(guard.periods), min(guard.periods))

    def _cover(self, visits: npt.NDArray[np.int64], path: Values) -> None:
        nx, ny = self._cells
        i = np.clip((path[:, 0] / CELL_M).astype(np.int64), 0, nx - 1)
        j = np.clip((path[:, 1] / CELL_M).astype(np.int64), 0, ny - 1)
        visits += np.bincount(i * ny + j, minlength=nx * ny).reshape(nx, ny)

    def _cycles(self, series: Series, phase: str, episode: int, added: dict[str, Any]) -> None:
        agent, needs = series.agent, series.needs
        before, path, dt = series.path[:-1], series.path[1:], agent.simulator.dt_s
        n, turn = len(path), (path[:, 2] - before[:, 2] + np.pi) % (2 * np.pi) - np.pi
        safeties = {"safety": series.safety, "safety_held": series.safety_held}
        columns = self.tables["cycles"]
        rows: dict[str, Any] = {"run": [self.run_columns["run"]] * n, "phase": [phase] * n, "episode": [episode] * n,
                "cycle": range(n), "x_m": path[:, 0], "y_m": path[:, 1], "heading_rad": path[:, 2],
                "v_m_s": lengths(path[:, 0] - before[:, 0], path[:, 1] - before[:, 1]) / dt, "w_rad_s": turn / dt,
                "hunger": needs.get("hunger", [None] * n), "thirst": needs.get("thirst", [None] * n),
                "energy": series.energy, "wanting": series.wanting,
                **{name: [None] * n if values is None else values for name, values in safeties.items()}}
        if not series.placed:
            rows |= {name: [None] * n for name in ("x_m", "y_m", "heading_rad", "v_m_s", "w_rad_s")}
        rows.update({name: values for name, values in needs.items() if name not in rows})
        for attention, seen in zip(agent.attentions, series.looks, strict=True):
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
            for x, y in np.argwhere(cells).tolist():
                self._add("coverage", run=run, phase=phase, x_cell=x, y_cell=y, visits=int(cells[x, y]))
        return self.tables


def _lived(series: Series, phase: str, episode: int, death: str | None) -> Lived:
    """The episode as those see it who only look: arrays that cannot be written to."""
    agent = series.agent

    def fixed(values: Values) -> Values:
        view = values.view()
        view.flags.writeable = False
        return view
    return Lived(phase, episode, agent.simulator.cycle, agent.max_cycles, death, fixed(series.path),
                 fixed(series.energy), fixed(series.wanting), None if series.safety is None else fixed(series.safety),
                 None if series.safety_held is None else fixed(series.safety_held),
                 {name: fixed(values) for name, values in series.needs.items()},
                 {a.behaviour.name: a.log.looks() for a in agent.attentions})


def _meals(body: Body, need: str) -> int | None:
    return body.meals[body.index[need]] if need in body.index else None
