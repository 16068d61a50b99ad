"""The best action."""

from __future__ import annotations

from dataclasses import dataclass
from random import Random
from typing import Literal

from attnlab.exploration.base import Exploration
from attnlab.registry import register
from attnlab.settings import setting


@register("exploration", "greedy")
class Greedy(Exploration):
    """The action of highest value. Of equals the first (the shortest period), the last, or any: then it draws one
    uniform number a choice between equals, otherwise nothing."""

    @dataclass
    class Params:
        ties: Literal["first", "last", "random"] = setting(
            "first", "which of equal values: first (the shortest period), last, or random", late=True)

    params: Params

    def choose(self, values: list[float], visits: list[int], draw: Random) -> int:
        best = max(values)
        if self.params.ties == "first":
            return values.index(best)
        equals = [action for action, value in enumerate(values) if value == best]
        if self.params.ties == "last" or len(equals) == 1:
            return equals[-1]
        return equals[int(draw.random() * len(equals))]

    def probabilities(self, values: list[float], visits: list[int]) -> list[float]:
        best = max(values)
        equals = [action for action, value in enumerate(values) if value == best]
        if self.params.ties != "random":
            equals = [equals[0] if self.params.ties == "first" else equals[-1]]
        return [1.0 / len(equals) if action in equals else 0.0 for action in range(len(values))]
