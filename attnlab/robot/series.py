"""An episode that has ended: what it was in every cycle, and what the tables say of it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from attnlab.arithmetic import total
from attnlab.attention import Looks
from attnlab.cycle import Agent
from attnlab.needs.base import Body
from attnlab.robot.guards import check_log
from attnlab.robot.identities import check_balance, check_clock
from attnlab.robot.summaries import Values, distances, guard_of, held, in_order, safety, safety_held, turning
from attnlab.worlds.base import Layout

Three = tuple[float, float, float]  # mean, smallest, largest


class Acts(NamedTuple):
    """What a behaviour did: looks, those at which its motor schema was on, sums of rewards, means over the looks."""
    activations: int
    releases: int
    reward: float
    reward_extrinsic: float
    liking_mean: float
    period_mean: float


class Brief(NamedTuple):
    """An episode in the numbers of its rows. ``needs``: mean and largest of each; ``fell``: the cycles at which each
    that food or water satisfies fell; ``acts`` in the order of the behaviours."""
    active_cycles: int
    energy: Three
    wanting_mean: float
    safety: Three | None
    safety_held: Three | None
    path_m: float | None
    turn_rad: float | None
    needs: dict[str, tuple[float, float]]
    fell: dict[str, list[int]]
    acts: list[Acts]


class Series:
    """Every cycle of the episode that an agent has just lived, arrays of shape (n,): after each cycle. ``path``
    (n + 1, 3); ``safety`` and ``safety_held`` are None where nobody answers for crashes."""

    def __init__(self, agent: Agent, layout: Layout):
        self.agent, n, body = agent, agent.simulator.cycle, agent.body
        self.moments = agent.history.columns()
        self.looks: list[Looks] = [attention.log.columns() for attention in agent.attentions]
        reached = self.moments[:, 0].astype(np.int64)
        self.lengths = np.diff(reached)
        remaining = np.repeat(reached[1:], self.lengths) - np.arange(n) - 1
        self.energy = np.repeat(self.moments[1:, 2], self.lengths) + body.e_u * remaining
        self.needs = {need.name: np.repeat(self.moments[1:, 3 + i], self.lengths) - need.per_cycle * remaining
                      for i, need in enumerate(body.needs)}
        self.path = agent.simulator.trace[:n + 1]
        self.wanting = held(self.looks[0], n, self.looks[0].wanting)
        guard = guard_of(agent.attentions)
        self.safety = self.safety_held = None
        if guard is not None:
            seen = self.looks[agent.attentions.index(guard)]
            gaps = agent.simulator.gaps()
            self.safety = safety(guard, seen, distances(self.path[1:], layout) if gaps is None else gaps)
            self.safety_held = safety_held(guard, seen, n)

    @property
    def placed(self) -> bool:
        """Is it known where the robot was?"""
        return not np.isnan(self.path).any()

    def check(self) -> None:
        """Raise :class:`attnlab.errors.PartError` or :class:`attnlab.robot.identities.IdentityError` if it cannot have
        been so."""
        _check_energy(self.agent.body, self.moments, self.lengths)
        for attention, seen in zip(self.agent.attentions, self.looks, strict=True):
            check_log(attention)
            check_clock(seen.cycle, seen.period, self.agent.simulator.cycle)

    def brief(self) -> Brief:
        steps, placed = np.diff(self.path[:, :2], axis=0), self.placed
        return Brief(len(self.lengths), _three(self.energy), float(self.wanting.mean()),
                     None if self.safety is None else _three(self.safety),
                     None if self.safety_held is None else _three(self.safety_held),
                     float(lengths(steps[:, 0], steps[:, 1]).sum()) if placed else None,
                     turning(self.path) if placed else None,
                     {name: (float(values.mean()), float(values.max())) for name, values in self.needs.items()},
                     {need.name: np.flatnonzero(np.diff(self.needs[need.name], prepend=need.start) < 0).tolist()
                      for need in self.agent.body.needs if need.feeds_energy},
                     [_acts(looks) for looks in self.looks])


def _three(values: Values) -> Three:
    return float(values.mean()), float(values.min()), float(values.max())


def _acts(looks: Looks) -> Acts:
    n, paid = len(looks.cycle), ~np.isnan(looks.reward)
    return Acts(n, int(np.count_nonzero(looks.released)), in_order(looks.reward[paid]), in_order(looks.extrinsic[paid]),
                in_order(looks.liking) / n, in_order(looks.period) / n)


def lengths(x: Values, y: Values) -> Values:
    """Of vectors (x, y), elementwise; not np.hypot, which is the C library's."""
    return np.sqrt(x * x + y * y)


def is_balanced(body: Body) -> bool:
    """Does the balance of energy and needs hold? Not where one of them grows by itself or is cut."""
    return not (body.reading.energy_clipped or body.reading.needs_floored
                or any(need.per_cycle for need in body.needs if need.feeds_energy))


def _check_energy(body: Body, moments: Values, lengths: Values) -> None:
    if is_balanced(body):
        feeding = [i for i, need in enumerate(body.needs) if need.feeds_energy]
        balance = moments[:, 2] + moments[:, [3 + i for i in feeding]].sum(axis=1)
        growth = total(body.needs[i].per_activation for i in feeding)
        check_balance(balance, body.e_u, body.e_nb, growth, moments[1:, 1], lengths)
