"""The machine cycle: one function that reads like the model."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from attnlab.attention import Attention
from attnlab.behaviours.base import RobotSenses
from attnlab.exploration.base import Exploration
from attnlab.fusion.base import Fusion
from attnlab.needs.base import Body
from attnlab.penalty.base import Penalty, check_shares
from attnlab.simulators.base import Simulator

Moment = tuple[float, ...]  # (cycles moved, behaviours active when the last stretch began, energy, *needs)


class History(list[Moment]):
    """An episode's moments: the start, and the end of each stretch. Compiled code writes them to ``table`` instead, the
    first ``rows`` of it."""
    table: npt.NDArray[np.float64] | None = None
    rows = 0

    def columns(self) -> npt.NDArray[np.float64]:
        """All of them, shape (n, 3 + needs)."""
        return np.array(self, np.float64) if self.table is None else self.table[:self.rows]

    def add(self, cycle: int, active: int, body: Body) -> None:
        self.append((cycle, active, body.energy, *body.values))


@dataclass
class Agent:
    """A robot with all its parts."""
    attentions: list[Attention]
    body: Body
    simulator: Simulator
    fusion: Fusion
    penalty: Penalty
    max_cycles: int

    def __post_init__(self) -> None:
        self.now, self.history = RobotSenses(self.simulator, self.body), History()
        for attention in self.attentions:
            attention.curiosity.attach(self.now)
        self.fusion.attach(self.attentions)
        layout = getattr(self.simulator, "layout", None)  # none where the parts alone are asked
        if layout is not None:
            self.body.larder.wander([solid.kind for solid in layout.solids])

    def start(self, x: float, y: float, heading: float) -> None:
        """Everything as at the start of an episode, with the robot at this pose."""
        self.simulator.place(x, y, heading)
        self.body.start()
        self.now.start()
        for attention in self.attentions:
            attention.start()
        self.history.clear()
        self.history.add(0, 0, self.body)

    def died(self, cause: str, learning: bool) -> list[float]:
        """The robot died of ``cause``: the penalty of each behaviour."""
        shares = check_shares(self.penalty, cause, [attention.behaviour for attention in self.attentions])
        return [attention.died(share, learning) for attention, share in zip(self.attentions, shares, strict=True)]


def live(agent: Agent, exploration: Exploration, learning: bool) -> str | None:
    """An episode that was started, to its end: the cause of death, or None."""
    cause = None
    while cause is None and agent.simulator.cycle < agent.max_cycles:
        active, cause = machine_cycle(agent, exploration, learning)
        agent.history.add(agent.simulator.cycle, active, agent.body)
    return cause


def machine_cycle(agent: Agent, exploration: Exploration, learning: bool) -> tuple[int, str | None]:
    """One cycle in which a clock fires, and the idle cycles until the next one does.

    Returns (behaviours that were active, cause of death or None). Nothing happens in an idle cycle but motion, contact
    and the passing of time, so they are handed to the simulator and the body in one call each.
    """
    now, body, simulator = agent.now, agent.body, agent.simulator
    start = now.cycle = simulator.cycle
    active, idle_until, held = 0, agent.max_cycles, []
    for attention in agent.attentions:
        # 1. Whoever's clock fires looks, is rewarded for the period that elapsed, learns, and chooses the next.
        if attention.due == start:
            active += attention.activate(now, exploration, learning)
        if attention.due < idle_until:
            idle_until = attention.due
        if attention.command is not None:
            held.append(attention.command)
    # 2. Commands are held until their behaviour looks again; all that are held become one.
    v, w = agent.fusion.fuse(held)
    # 3. The robot moves; contact and the safety distance are tested in every cycle.
    cycles, crashed = simulator.advance(v, w, body.until_death(active, idle_until - start))
    # 4. Needs and energy change, and may end it.
    cause = body.live(active, cycles)
    return active, "crash" if crashed else cause
