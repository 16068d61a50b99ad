"""A clock of any mean period: what equal looks are worth to who does not look at the world."""

from __future__ import annotations

from dataclasses import dataclass
from random import Random

from attnlab.exploration.base import Exploration
from attnlab.learners.base import LearnerContext
from attnlab.learners.fixed import NoLearner
from attnlab.registry import register
from attnlab.settings import setting


@register("learner", "steady")
class Steady(NoLearner):
    """Grants the two periods next to the wanted one in turn, so that their mean is the wanted one and each deviation is
    made up for at the next look: ``period=10`` out of 1, 4, 8, 12 gives 8, 12, 8, 12, ... (error diffusion; ours).

    A ``fixed`` clock has one of the granted periods; this one has any, and so stands at any number of looks: who looks
    as often but is worse than it has gained nothing by its percepts. Draws nothing at random.
    """

    @dataclass
    class Params:
        period: float = setting(6.0, "mean period; the nearest granted one if it is outside of them", unit="mc", low=1)

    params: Params

    def __init__(self, params: Params, context: LearnerContext):
        super().__init__(params, context)
        self._ahead = 0.0

    def start(self) -> None:
        self._ahead = 0.0

    def decide(self, state: int, exploration: Exploration, draw: Random) -> int:
        periods, wanted, chosen = self.context.periods, self.params.period, -1
        for i, period in enumerate(periods):
            if self._beside(period) and (chosen < 0 or self._off(period) < self._off(periods[chosen])):
                chosen = i
        self._ahead += periods[chosen] - wanted
        return chosen

    def _off(self, period: int) -> float:
        """How far the mean would be off after this one, summed over periods."""
        return abs(self._ahead + period - self.params.period)

    def _beside(self, period: int) -> bool:
        """Is no other granted period between this one and the wanted one, on its side?"""
        wanted, nearest = self.params.period, True
        for other in self.context.periods:
            nearest = nearest and not (period < other <= wanted or wanted <= other < period)
        return nearest
