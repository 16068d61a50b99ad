"""One episode."""

from __future__ import annotations

from attnlab.cycle import Agent, live
from attnlab.exploration.base import Exploration


def run_episode(agent: Agent, exploration: Exploration, start: tuple[float, float, float], learning: bool
                ) -> tuple[str | None, list[float]]:
    """One episode from ``start`` (m, m, rad): the cause of death or None, each behaviour's penalty."""
    agent.start(*start)
    death = live(agent, exploration, learning)
    agent.body.dead = death is not None
    penalties = agent.died(death, learning) if death else [0.0] * len(agent.attentions)
    return death, penalties
