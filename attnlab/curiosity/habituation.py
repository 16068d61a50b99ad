"""A habituating novelty filter over the sonars."""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, inf

from attnlab.arithmetic import distance
from attnlab.curiosity.base import Curiosity
from attnlab.registry import register
from attnlab.settings import setting
from attnlab.simulators.robot import SONARS


class Units:
    """Prototypes of the sonar ring (16 numbers in [0, 1] each) and how fresh each still is (1 new, towards 0): ``n`` of
    them, then room."""

    def __init__(self, room: int):
        self.n = 0
        self.weights = [[0.0] * len(SONARS) for _ in range(room)]
        self.fresh = [0.0] * room

    def winner(self, view: list[float]) -> tuple[int, float]:
        """(index, activity exp(-||x - w||)) of the nearest unit; (-1, 0) if there is none."""
        nearest, least = -1, inf
        for i in range(self.n):
            away = distance(view, self.weights[i])
            if away < least:
                nearest, least = i, away
        return nearest, exp(-least)

    def grow(self, weights: list[float]) -> int:
        """A new unit; its index."""
        self.weights[self.n][:] = weights
        self.fresh[self.n] = 1.0
        self.n += 1
        return self.n - 1


@register("curiosity", "habituation")
class Habituation(Curiosity):
    """Marsland, Nehmzow & Shapiro 2000 (SAB; arXiv cs/0006007) with the growing network of Marsland, Shapiro & Nehmzow
    2002 (Neural Networks 15:1041), less its edges: units grow over the 16 sonars. A new unit moves and habituates at
    once, and there are none at first (both ours).

    A unit's activity is exp(-||x - w||), x the ring's distances over ``range_m``, at most 1. Novelty (the liking) is
    the freshness y of the winner. When the winner is seen, y <- y + (alpha (1 - y) - 1)/tau, not below 0, and w moves
    by ``rate`` y towards x. If its activity is below ``activity`` though it is habituated (y below ``habituated``), x
    is new: liking 1, and a unit grows halfway between. At ``units`` units growth stops. Reads the sonars; ignores the
    percept. Draws nothing at random.
    """

    @dataclass
    class Params:
        range_m: float = setting(2.0, "distances from here on look alike", unit="m", above=0)
        activity: float = setting(0.6, "below it a habituated winner does not stand for the view", above=0, high=1)
        habituated: float = setting(0.3, "freshness below which a unit is habituated", above=0, high=1)
        tau: float = setting(3.33, "time constant of habituation", unit="observations", low=1)
        alpha: float = setting(1.05, "recovery; freshness tends to 1 - 1/alpha", above=0)
        rate: float = setting(0.1, "of the winner's move towards the view", low=0, high=1)
        units: int = setting(100, "most units", low=1, high=10_000)
        persists: bool = setting(True, "keep the units from one episode to the next")

    params: Params

    def memory(self) -> Units:
        return Units(self.params.units)

    def _view(self) -> list[float]:
        reach = self.params.range_m
        return [d / reach if d < reach else 1.0 for d in self.now.ring()]

    def _is_new(self, memory: Units, winner: int, activity: float) -> bool:
        p = self.params
        return winner < 0 or (activity < p.activity and memory.fresh[winner] < p.habituated
                              and memory.n < p.units)

    def liking(self, memory: Units, percept: int) -> float:
        winner, activity = memory.winner(self._view())
        return 1.0 if self._is_new(memory, winner, activity) else memory.fresh[winner]

    def observe(self, memory: Units, percept: int) -> None:
        view, p = self._view(), self.params
        winner, activity = memory.winner(view)
        if self._is_new(memory, winner, activity):
            winner = memory.grow([(x + memory.weights[winner][i]) / 2 if winner >= 0 else x
                                  for i, x in enumerate(view)])
        fresh, unit = memory.fresh[winner], memory.weights[winner]
        for i, x in enumerate(view):
            unit[i] += p.rate * fresh * (x - unit[i])
        memory.fresh[winner] = max(0.0, fresh + (p.alpha * (1.0 - fresh) - 1.0) / p.tau)
