"""Self-triggered looking: look again before harm costs more than the look."""

from __future__ import annotations

from dataclasses import dataclass

from attnlab.learners.base import Learner, LearnerContext
from attnlab.learners.chain import Chain
from attnlab.registry import register
from attnlab.settings import setting


class Watchful(Learner):
    """Learners that foresee harm: the chances of a percept that is dangerous, or of death, from a chain of percepts
    that they estimate."""

    @dataclass
    class Params:
        below: dict[str, float] = setting({"avoid": 0.5}, "by behaviour: percepts whose place in [0, 1] is below this "
                                          "are dangerous")
        above: dict[str, float] = setting({"eat": 0.67, "drink": 0.67}, "by behaviour: percepts above this are; for a "
                                          "behaviour that is in neither, those below a third")

    params: Params

    def __init__(self, params: Params, context: LearnerContext):
        super().__init__(params, context)
        self.chain = Chain(context.bins, context.periods)
        below, above = params.below.get(context.behaviour), params.above.get(context.behaviour)
        if below is None and above is None:
            below = 1 / 3
        places = [(x + 0.5) / context.bins for x in range(context.bins)]
        self.dangerous = [(below is not None and place < below) or (above is not None and place > above)
                          for place in places]
        self.trace = [[0.0] * len(self.chain.powers) for _ in self.dangerous]
        self.plan = [[0.0] * self.actions for _ in range(context.bins)]
        self._foresee()

    def values(self, state: int) -> list[float]:
        return self.plan[state % self.context.bins]

    def update(self, state: int, action: int, reward: float, next_state: int, next_action: int, cycles: int) -> None:
        self._learn(state, action, cycles, next_state % self.context.bins)

    def terminal(self, state: int, action: int, reward: float) -> None:
        self._learn(state, action, self.context.periods[action], self.chain.death)

    def _learn(self, state: int, action: int, cycles: int, after: int) -> None:
        self.visits[state][action] += 1
        if self.chain.add(state % self.context.bins, cycles, after):
            self.chain.renew()
            self._foresee()

    def _foresee(self) -> None:
        """``trace[x][k]``: chance that k cycles after a look at x there is danger, or death, that was not there."""
        for x, known in enumerate(self.dangerous):
            for k, power in enumerate(self.chain.powers):
                chance = 0.0
                for i, harmful in enumerate(self.dangerous):
                    if harmful and not known:
                        chance += power[x][i]
                self.trace[x][k] = chance if known else chance + power[x][self.chain.death]
        self.replan()

    def replan(self) -> None:
        """New values from what is foreseen, if they are kept."""


@register("learner", "self_triggered")
class SelfTriggered(Watchful):
    """Self-triggering (Trimpe & Baumann 2019, IEEE IoT J. 6:5013, arXiv 1901.07531): at a look, the next one is set to
    where the predicted cost of not looking exceeds the cost of a look.

    Here (ours) the former is the expected number of cycles in danger before the next look, sum_{0<k<p} chance of danger
    or death k cycles from now, from a chain of percepts that is estimated as it goes, noise and all; the longest period
    for which it stays below ``look_cost`` is best. Values: p / longest where it does, look_cost minus it where not. At
    a dangerous percept nothing is foreseen, for it is known: it is looked at in every cycle. Draws nothing at random.
    """

    @dataclass
    class Params(Watchful.Params):
        look_cost: float = setting(0.5, "of one look, in cycles of danger that was not seen", unit="mc", low=0)

    params: Params

    def replan(self) -> None:
        longest, shortest = max(self.context.periods), min(self.context.periods)
        for x, trace in enumerate(self.trace):
            for i, p in enumerate(self.context.periods):
                harm = 0.0
                for chance in trace[1:p]:
                    harm += chance
                if self.dangerous[x]:
                    self.plan[x][i] = 1.0 if p == shortest else -p / longest
                else:
                    self.plan[x][i] = p / longest if harm <= self.params.look_cost else self.params.look_cost - harm
