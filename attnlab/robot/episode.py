"""One episode."""

from __future__ import annotations

from attnlab.cycle import Agent, machine_cycle
from attnlab.exploration.base import Exploration
from attnlab.robot.record import Moment


def run_episode(agent: Agent, exploration: Exploration, start: tuple[float, float, float], learning: bool
                ) -> tuple[list[Moment], str | None, list[float]]:
    """One episode from ``start`` (m, m, rad): its history, the cause of death or None, each behaviour's penalty."""
    agent.start(*start)
    simulator, body = agent.simulator, agent.body
    history, death = [(0, 0, body.energy, *body.values)], None
    while death is None and simulator.cycle < agent.max_cycles:
        active, death = machine_cycle(agent, exploration, learning)
        history.append((simulator.cycle, active, body.energy, *body.values))
    body.dead = death is not None
    penalties = agent.died(death, learning) if death else [0.0] * len(agent.attentions)
    return history, death, penalties
