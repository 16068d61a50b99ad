"""Attentional regulations: an emphasis, weighed from bottom-up and top-down influences, sets the period."""

from __future__ import annotations

from dataclasses import dataclass
from math import exp

from attnlab.learners.base import Learner, LearnerContext
from attnlab.registry import register
from attnlab.settings import setting


@register("learner", "regulations")
class Regulations(Learner):
    """Caccavale & Finzi (Auton. Robots 2019; Topics Cogn. Sci. 14:327): the emphasis of a behaviour is a weighted sum
    of influences, e_b = sum_i w_ib c_i, and the weights are learned.

    Ours: the influences are 1 (top-down, constant), the percept's place in [0, 1], the frequency 1/p of the period in
    force (bottom-up), and curiosity's level in [0, 1]; e = 1 / (1 + exp(-sum)), and the wanted period runs from the
    longest at e = 0 to the shortest at e = 1. The weights learn as an actor does whose critic V(percept) follows
    temporal differences (CACLA, van Hasselt & Wiering 2007, ADPRL): where a period turned out better than expected, e
    moves towards the emphasis of that period by ``rate``. Values: minus the distance of a period from the wanted one,
    as a share of the longest, times ``sharpness``. Draws nothing at random.
    """

    @dataclass
    class Params:
        alpha: float = setting(0.2, "learning rate of the critic", above=0, high=1)
        gamma: float = setting(0.9, "discount", low=0, high=1)
        rate: float = setting(0.05, "learning rate of the weights", above=0, high=10)
        sharpness: float = setting(4.0, "of the values, for explorations that go by them", above=0)

    params: Params

    def __init__(self, params: Params, context: LearnerContext):
        super().__init__(params, context)
        self.weights = [0.0, 0.0, 0.0, 0.0]
        self.critic = [0.0] * context.bins
        self._shortest, self._longest = min(context.periods), max(context.periods)

    def influences(self, state: int) -> tuple[float, float, float, float]:
        """c_i of a state."""
        c = self.context
        level, rest = divmod(state, len(c.periods) * c.bins)
        period, percept = divmod(rest, c.bins)
        return (1.0, percept / max(1, c.bins - 1), 1.0 / c.periods[period], level / max(1, len(c.levels) - 1))

    def emphasis(self, state: int) -> float:
        """e of a state, in (0, 1)."""
        drive = 0.0
        for i, influence in enumerate(self.influences(state)):
            drive += self.weights[i] * influence
        return 1.0 / (1.0 + exp(-max(-50.0, min(50.0, drive))))

    def values(self, state: int) -> list[float]:
        wanted = self._longest - (self._longest - self._shortest) * self.emphasis(state)
        return [-self.params.sharpness * abs(p - wanted) / self._longest for p in self.context.periods]

    def update(self, state: int, action: int, reward: float, next_state: int, next_action: int, cycles: int) -> None:
        self._learn(state, action, reward + self.params.gamma * self.critic[next_state % self.context.bins])

    def terminal(self, state: int, action: int, reward: float) -> None:
        self._learn(state, action, reward)

    def _learn(self, state: int, action: int, target: float) -> None:
        self.visits[state][action] += 1
        percept = state % self.context.bins
        better = target > self.critic[percept]
        self.critic[percept] += self.params.alpha * (target - self.critic[percept])
        if better and self._longest > self._shortest:
            shown = (self._longest - self.context.periods[action]) / (self._longest - self._shortest)
            step = self.params.rate * (shown - self.emphasis(state))
            for i, influence in enumerate(self.influences(state)):
                self.weights[i] += step * influence
