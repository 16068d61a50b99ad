"""Novelty by counting."""

from __future__ import annotations

from dataclasses import dataclass

from attnlab.curiosity.base import Curiosity
from attnlab.registry import register
from attnlab.settings import setting


@register("curiosity", "count")
class Count(Curiosity):
    """Liking 1/sqrt(n) of the n-th view of a percept: 1, 0.707, 0.577, ... (the bonus of Strehl & Littman 2008, J.
    Comput. Syst. Sci. 74:1309). Nothing is forgotten. Memory: views of each percept. Draws nothing at random."""

    @dataclass
    class Params:
        persists: bool = setting(True, "go on counting from one episode to the next")

    params: Params

    def memory(self) -> list[int]:
        return [0] * self.bins

    def liking(self, memory: list[int], percept: int) -> float:
        bonus: float = (memory[percept] + 1) ** -0.5
        return bonus

    def observe(self, memory: list[int], percept: int) -> None:
        memory[percept] += 1
