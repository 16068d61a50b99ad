"""The best action."""

from __future__ import annotations

from random import Random

from attnlab.exploration.base import Exploration
from attnlab.registry import register


@register("exploration", "greedy")
class Greedy(Exploration):
    """The action of highest value; the first (the shortest period) of equals. Draws nothing at random."""

    def choose(self, values: list[float], visits: list[int], draw: Random) -> int:
        return values.index(max(values))

    def probabilities(self, values: list[float], visits: list[int]) -> list[float]:
        best = values.index(max(values))
        return [1.0 if i == best else 0.0 for i in range(len(values))]
