"""Bandwidth: behaviours bid for looks, and a budget that all share sets the price."""

from __future__ import annotations

from dataclasses import dataclass

from attnlab.learners.base import LearnerContext
from attnlab.learners.self_triggered import Watchful
from attnlab.registry import register
from attnlab.settings import setting


class Market:
    """What behaviours that share a budget of looks know of each other: the price of a look, and the mean period of
    each, those that are known first."""

    def __init__(self) -> None:
        self.price, self.known = 0.1, 0
        self.means: list[float] = []


@register("learner", "bandwidth")
class Bandwidth(Watchful):
    """Value of information under a shared budget. f(k), the cost of age, is the chance of danger or death k cycles
    after a look at a percept (ours, as in ``self_triggered``). A behaviour looks after the period with the least cost a
    cycle at the price lambda of a look, (lambda + sum_{0<k<p} f(k)) / p. Where f rises that is the first p at which
    Whittle's index of f, (p - 1) f(p) - sum_{0<k<p} f(k), exceeds lambda (Tripathi & Modiano 2019, arXiv 1908.10438, on
    a channel that loses nothing). Values are minus that cost.

    lambda is one number for all behaviours: with every cycle it grows by ``step`` (looks a cycle - ``budget``), not
    below 0, the looks a cycle being the sum over behaviours of one by the mean period of its latest ones. At a
    dangerous percept danger is known, and each cycle in which it is not watched costs one. Draws nothing at random.
    """

    @dataclass
    class Params(Watchful.Params):
        budget: float = setting(0.4, "looks a cycle of all behaviours together", above=0)
        step: float = setting(0.02, "how fast the price follows", unit="mc", above=0, high=10)
        memory: float = setting(0.95, "of the mean period", low=0, high=0.999)

    params: Params

    def __init__(self, params: Params, context: LearnerContext):
        self.market: Market = context.shared.setdefault("market", Market())
        self.market.means.append(0.0)
        self._place = -1
        super().__init__(params, context)

    def values(self, state: int) -> list[float]:
        x, price, values = state % self.context.bins, self.market.price, []
        for p in self.context.periods:
            harm = float(p - 1) if self.dangerous[x] else 0.0
            for chance in self.trace[x][1:p]:
                harm += chance
            values.append(-(price + harm) / p)
        return values

    def update(self, state: int, action: int, reward: float, next_state: int, next_action: int, cycles: int) -> None:
        self._learn(state, action, cycles, next_state % self.context.bins)
        p, market = self.params, self.market
        if self._place < 0:
            self._place, market.known = market.known, market.known + 1
            market.means[self._place] = float(cycles)
        market.means[self._place] = p.memory * market.means[self._place] + (1.0 - p.memory) * cycles
        looks = 0.0
        for mean in market.means[:market.known]:
            looks += 1.0 / mean
        market.price = max(0.0, market.price + p.step * (looks - p.budget) * cycles / market.known)
