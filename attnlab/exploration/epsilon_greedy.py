"""Epsilon-greedy exploration."""

from __future__ import annotations

from dataclasses import dataclass
from random import Random

from attnlab.exploration.base import Exploration
from attnlab.registry import register
from attnlab.settings import setting


@register("exploration", "epsilon_greedy")
class EpsilonGreedy(Exploration):
    """Any action with probability epsilon, otherwise the best, the first of equals (Sutton & Barto 1998, 2.2). Draws
    one uniform number a choice, two when it explores."""

    @dataclass
    class Params:
        epsilon: float = setting(0.1, "probability of a random action", low=0, high=1)

    params: Params

    def choose(self, values: list[float], visits: list[int], draw: Random) -> int:
        if draw.random() < self.params.epsilon:
            return int(draw.random() * len(values))
        return values.index(max(values))

    def probabilities(self, values: list[float], visits: list[int]) -> list[float]:
        share = self.params.epsilon / len(values)
        chances = [share] * len(values)
        chances[values.index(max(values))] += 1.0 - self.params.epsilon
        return chances
