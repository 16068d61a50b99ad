"""Boltzmann exploration."""

from __future__ import annotations

from dataclasses import dataclass
from random import Random

from attnlab.equations import softmax
from attnlab.exploration.base import Exploration
from attnlab.registry import register
from attnlab.settings import setting


@register("exploration", "softmax")
class Softmax(Exploration):
    """Eq (3) of Di Nocera et al. 2014 (Sutton & Barto 1998, 2.3). Draws one uniform number a choice."""

    @dataclass
    class Params:
        tau: float = setting(1.0, "temperature (Table 4)", above=0)

    params: Params

    def choose(self, values: list[float], visits: list[int], draw: Random) -> int:
        left = draw.random()
        for action, probability in enumerate(softmax(values, self.params.tau)):
            left -= probability
            if left < 0.0:
                return action
        return values.index(max(values))  # rounding: the probabilities summed to a hair less than 1

    def probabilities(self, values: list[float], visits: list[int]) -> list[float]:
        return softmax(values, self.params.tau)
