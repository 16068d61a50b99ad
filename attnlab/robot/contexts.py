"""What each part is built from, once for runs and for tests of parts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from attnlab.attention import Attention
from attnlab.behaviours.base import BehaviourContext
from attnlab.callbacks.base import CallbackContext
from attnlab.curiosity.base import CuriosityContext
from attnlab.cycle import Agent
from attnlab.learners.base import LearnerContext, Look
from attnlab.learners.observation import observation
from attnlab.probes.base import ProbeContext
from attnlab.reading import Reading
from attnlab.simulators.base import SimulatorContext
from attnlab.streams import stream
from attnlab.worlds.base import Layout


@dataclass(frozen=True)
class Making:
    """What is known of a run when its parts are made. ``levels``: of curiosity; ``behaviour``: whose learner it is;
    ``shared``: by the learners of one robot."""
    reading: Reading
    seed: int
    layout: Layout
    periods: Sequence[int]
    levels: Sequence[str] = ()
    behaviour: str = ""
    shared: dict[str, Any] = field(default_factory=dict)
    run: str = "run"
    folder: Path | None = None

    def context(self, group: str, name: str) -> Any:
        """The context that a part of this group is built from; every stream by its own name."""
        r, seed = self.reading, self.seed
        if group == "behaviours":
            return BehaviourContext(r, stream(seed, "behaviour", name))
        if group == "curiosity":
            return CuriosityContext(r, r.percept_bins, stream(seed, "curiosity"))
        if group == "learner":
            return LearnerContext(r, self.behaviour, self.levels, self.periods, r.percept_bins,
                                  stream(seed, "learner", self.behaviour), self.shared)
        if group == "simulator":
            return SimulatorContext(self.layout, r.dt_s, r.max_cycles, r.safety_distance_m
                                    if r.crash == "safety_distance" else None, stream(seed, "simulator"))
        if group == "probe":
            return ProbeContext(r, self.layout)
        if group == "callback":
            return CallbackContext(self.run, self.folder)
        return r if group in ("needs", "fusion", "penalty") else None


def look_of(agent: Agent, attention: Attention) -> Look:
    """What a behaviour of this robot perceives while it decides. A function, so that it is no part of what is kept."""
    behaviour, energy_max = attention.behaviour, attention.reading.energy_max

    def look() -> list[float]:
        sigma = behaviour.percept(agent.now)
        return observation(sigma, behaviour.sigma_low, behaviour.sigma_high, attention.action, len(attention.periods),
                           attention.wanting, attention.liking, agent.body.energy, energy_max)
    return look


class NoSimulator:
    """Stands in for a simulator while parts are only constructed."""
    cycle = 0
