"""What a model of curiosity is."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from random import Random
from typing import Any

from attnlab import equations
from attnlab.reading import Reading
from attnlab.simulators.base import Surroundings

NONE, LOW, LH, HH = "none", "low", "LH", "HH"


@dataclass(frozen=True)
class CuriosityContext:
    """What a curiosity is built from. ``bins``: number of percepts; ``draw``: its own random stream; ``depth``: of a
    model inside another."""
    reading: Reading
    bins: int
    draw: Random
    depth: int = 0


class Curiosity(ABC):
    """A model of curiosity, the same object for all behaviours; what it remembers of each is a *memory*.

    Reading and learning are apart: ``wanting``, ``liking``, ``level`` and ``mix`` change nothing; ``observe`` learns.
    ``levels`` names the curiosity levels that enter the state; wanting and liking are within [0, 1]. Only ``memory``,
    ``liking`` and ``observe`` must be written: the rest is the paper's unless it is overridden. ``composed`` takes each
    from another model.

    ``now`` is what the robot senses (:class:`~attnlab.simulators.base.Surroundings`) while a behaviour is active, for
    models that need more than the percept; a sensor is read when it is asked for. ``persists``: does what is remembered
    outlive the episode?
    """
    name: str
    interpreted = ""  # why it runs as Python alone, where it does not compile
    levels: tuple[str, ...] = (LOW, LH, HH)
    high_wanting: float = 0.0
    high_liking: float = 0.5
    now: Surroundings

    def __init__(self, params: Any, context: CuriosityContext):
        self.params, self.reading, self.bins, self.draw = params, context.reading, context.bins, context.draw
        self.persists = getattr(params, "persists", self.reading.novelty_persists)

    def attach(self, now: Surroundings) -> None:
        """The robot is built; this is what it senses from now on."""
        self.now = now

    @abstractmethod
    def memory(self) -> Any:
        """A fresh memory of one behaviour's percepts: plain data that can be copied and pickled."""

    def wanting(self, memory: Any, energy: float) -> float:
        """w in [0, 1]; energy in UoE. Pure. The residual energy, eq (11)."""
        return equations.wanting(energy, self.reading.energy_well, self.reading.energy_max)

    @abstractmethod
    def liking(self, memory: Any, percept: int) -> float:
        """R_l in [0, 1] of a percept (0 to bins - 1). Pure."""

    @abstractmethod
    def observe(self, memory: Any, percept: int) -> None:
        """Learn that this percept was seen."""

    def level(self, wanting: float, liking: float) -> int:
        """Index into ``levels``: w = 0 merges LL and HL, otherwise liking decides between LH and HH. Pure."""
        if wanting <= self.high_wanting:
            return 0
        return 2 if liking > self.high_liking else 1

    def mix(self, extrinsic: float, liking: float, wanting: float) -> float:
        """The reward, eq (4). Pure."""
        return equations.mixed_reward(extrinsic, liking, wanting)
