"""What an exploration is."""

from __future__ import annotations

from abc import ABC, abstractmethod
from random import Random
from typing import Any


class Exploration(ABC):
    """Chooses an action by its value."""
    name: str
    interpreted = ""  # why it runs as Python alone, where it does not compile

    def __init__(self, params: Any, context: None = None):
        self.params = params

    def start(self, episode: int) -> None:
        """Called before each training episode, for schedules; ``episode`` counts from 0."""

    @abstractmethod
    def choose(self, values: list[float], visits: list[int], draw: Random) -> int:
        """The index of the chosen action; ``visits`` counts how often each was tried in this state."""

    def probabilities(self, values: list[float], visits: list[int]) -> list[float]:
        """How likely each action is; only learners that average over their own policy ask."""
        raise NotImplementedError(f"exploration '{self.name}' does not say how likely its choices are")
