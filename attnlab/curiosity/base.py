"""What a model of curiosity is."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from random import Random
from typing import Any

from attnlab.equations import mixed_reward
from attnlab.reading import Reading

NONE, LOW, LH, HH = "none", "low", "LH", "HH"


@dataclass(frozen=True)
class CuriosityContext:
    """What a curiosity is built from. ``bins``: number of percepts; ``draw``: its own random stream."""
    reading: Reading
    bins: int
    draw: Random


class Curiosity(ABC):
    """A model of curiosity, the same object for all behaviours; what it remembers of each is a *memory*.

    Reading and learning are apart: ``wanting``, ``liking``, ``level`` and ``mix`` change nothing; ``observe`` learns.
    ``levels`` names the curiosity levels that enter the state; wanting and liking are within [0, 1].
    """
    name: str
    levels: tuple[str, ...] = (LOW, LH, HH)
    high_liking: float = 0.5

    def __init__(self, params, context: CuriosityContext):
        self.params, self.reading, self.bins, self.draw = params, context.reading, context.bins, context.draw

    @abstractmethod
    def memory(self) -> Any:
        """A fresh memory of one behaviour's percepts: plain data that can be copied and pickled."""

    @abstractmethod
    def wanting(self, memory: Any, energy: float) -> float:
        """w in [0, 1]; energy in UoE. Pure."""

    @abstractmethod
    def liking(self, memory: Any, percept: int) -> float:
        """R_l in [0, 1] of a percept (0 to bins - 1). Pure."""

    @abstractmethod
    def observe(self, memory: Any, percept: int) -> None:
        """Learn that this percept was seen."""

    def level(self, wanting: float, liking: float) -> int:
        """Index into ``levels``: w = 0 merges LL and HL, otherwise liking decides between LH and HH. Pure."""
        if wanting <= 0.0:
            return 0
        return 2 if liking > self.high_liking else 1

    def mix(self, extrinsic: float, liking: float, wanting: float) -> float:
        """The reward, eq (4). Pure."""
        return mixed_reward(extrinsic, liking, wanting)
