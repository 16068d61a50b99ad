"""Optimism in the face of uncertainty."""

from __future__ import annotations

from dataclasses import dataclass
from math import log, sqrt
from random import Random

from attnlab.arithmetic import total
from attnlab.exploration.base import Exploration
from attnlab.registry import register
from attnlab.settings import setting


@register("exploration", "ucb1")
class Ucb1(Exploration):
    """Auer et al. 2002 (Machine Learning 47:235), each state a bandit of its own: an action not yet tried there,
    otherwise the one of highest Q + c sqrt(2 ln n / n_a), the first of equals; c is ours (theirs is 1, for rewards
    in [0, 1]). Draws nothing at random."""

    @dataclass
    class Params:
        c: float = setting(1.0, "weight of uncertainty, in the units of Q", low=0)

    params: Params

    def choose(self, values: list[float], visits: list[int], draw: Random) -> int:
        return self._best(values, visits)

    def _best(self, values: list[float], visits: list[int]) -> int:
        if 0 in visits:
            return visits.index(0)
        spread = 2.0 * log(total(visits))
        bounds = [q + self.params.c * sqrt(spread / visits[i]) for i, q in enumerate(values)]
        return bounds.index(max(bounds))

    def probabilities(self, values: list[float], visits: list[int]) -> list[float]:
        best = self._best(values, visits)
        return [1.0 if i == best else 0.0 for i in range(len(values))]
