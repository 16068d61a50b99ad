"""The same numbers of an episode from compiled code, where an agent's logs are tables."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from attnlab.attention import Attention
from attnlab.cycle import Agent
from attnlab.robot.guards import SLACK
from attnlab.robot.series import Acts, Brief, Three, is_balanced
from attnlab.robot.summaries import guard_of
from attnlab.tables.schema import CELL_M

Whole = npt.NDArray[np.int64]
Quick = Callable[[bool, Whole], Brief | None]


def quick(agent: Agent, looks: npt.NDArray[np.float64]) -> Quick:
    """What says of the episode that the agent has just lived what :class:`attnlab.robot.series.Series` does, and adds
    where it was to ``visits`` (x, y); None if a check found something, which the series then has to say.

    ``looks``: the tables of all logs, shape (behaviours, most looks, fields)."""
    from attnlab.compiled import summary as s
    body, trace, moments, attentions = agent.body, agent.simulator.trace, agent.history.table, agent.attentions
    guard = guard_of(attentions)
    place = -1 if guard is None else attentions.index(guard)
    needs = np.array([(n.per_cycle, n.start, n.per_activation, n.feeds_energy) for n in body.needs],
                     np.float64).reshape(-1, 4)
    boxes = np.array([(b.x_m, b.y_m, *b.footprint) for b in agent.simulator.layout.solids]).reshape(-1, 6)
    bounds = np.array([_bounds(attention) for attention in attentions])
    balanced = is_balanced(body)
    rows = np.zeros(len(attentions), np.int64)
    fell = np.zeros((len(needs), agent.max_cycles + 1), np.int64)
    scratch = np.zeros((s.SERIES, agent.max_cycles + 3))
    found, acts = np.zeros(s.NEEDS + 2 * len(needs)), np.zeros((len(attentions), len(Acts._fields)))
    names = [need.name for need in body.needs]

    def brief(check: bool, visits: Whole) -> Brief | None:
        rows[:] = [attention.log.rows for attention in attentions]
        if not s.summary(trace, agent.simulator.cycle, moments, agent.history.rows, looks, rows, needs, boxes, bounds,
                         place, body.e_u, body.e_nb, balanced, check, CELL_M, visits, fell, scratch, found, acts):
            return None
        f = found.tolist()

        def three(at: int) -> Three:
            return f[at], f[at + 1], f[at + 2]
        return Brief(agent.history.rows - 1, three(s.ENERGY), f[s.WANTING],
                     None if guard is None else three(s.SAFETY), None if guard is None else three(s.HELD),
                     f[s.PATH], f[s.TURN],
                     {name: (f[s.NEEDS + 2 * i], f[s.NEEDS + 2 * i + 1]) for i, name in enumerate(names)},
                     {need.name: fell[i, 1:1 + fell[i, 0]].tolist() for i, need in enumerate(body.needs)
                      if need.feeds_energy},
                     [Acts(int(row[0]), int(row[1]), *row[2:]) for row in acts.tolist()])
    return brief


def _bounds(attention: Attention) -> tuple[float, ...]:
    """Of what it may perceive, with slack; how many levels; where its percept ends; its shortest and longest period."""
    behaviour, periods = attention.behaviour, attention.periods
    slack = SLACK * (1.0 + abs(behaviour.sigma_high))
    return (behaviour.sigma_low - slack, behaviour.sigma_high + slack, len(attention.curiosity.levels),
            behaviour.sigma_high, min(periods), max(periods))
