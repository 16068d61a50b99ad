"""AMRL: looking costs; in between, a learned model says where the robot is."""

from __future__ import annotations

from dataclasses import dataclass

from attnlab.equations import q_update
from attnlab.learners.base import Learner, LearnerContext
from attnlab.registry import register
from attnlab.settings import setting


class Followed:
    """The model of AMRL-Q: what follows a state and an action is taken to be the state that was seen to do so most
    often, the first seen of equals."""

    def __init__(self, states: int, actions: int):
        self.often = [[[0] * states for _ in range(actions)] for _ in range(states)]
        self.first = [[[0] * states for _ in range(actions)] for _ in range(states)]  # at which look first
        self.usual = [[-1] * actions for _ in range(states)]  # the estimates, -1 where none was seen
        self.looks = 0

    def saw(self, state: int, action: int, after: int) -> None:
        """A measurement of what followed."""
        self.looks += 1
        often, first, usual = self.often[state][action], self.first[state][action], self.usual[state][action]
        often[after] += 1
        if often[after] == 1:
            first[after] = self.looks
        if usual < 0 or (often[usual], first[after]) < (often[after], first[usual]):
            self.usual[state][action] = after


@register("learner", "amrl")
class ActiveMeasure(Learner):
    """Active-measure reinforcement learning, AMRL-Q (Bellinger, Coles, Crowley & Tamblyn 2020, arXiv 2005.12697; Can.
    AI 2021): every measurement of the state costs c; while the state is not measured a model learned from those that
    were stands in for it, and values are learned of the states it estimates, too.

    On a clock (ours): Q(s,p) <- (1 - alpha) Q(s,p) + alpha (R - c + gamma max Q(s')), and for each granted q < p with
    p - q granted, s^ being the state that most often followed s after q cycles (counts; none before the first):
    Q(s^,p - q) learns the same, as if the robot had looked there. The cost of the look that begins the next period is
    in each target. Draws nothing at random.
    """

    @dataclass
    class Params:
        alpha: float = setting(0.5, "learning rate", above=0, high=1)
        gamma: float = setting(0.9, "discount", low=0, high=1)
        look_cost: float = setting(0.1, "c: of one look; the rewards of a period are within 0 and 1", unit="UoR", low=0)

    params: Params

    def __init__(self, params: Params, context: LearnerContext):
        super().__init__(params, context)
        periods = list(context.periods)
        self.model = Followed(context.states, len(periods))
        self._rest = [[periods.index(p - q) if p - q in periods else -1 for q in periods] for p in periods]

    def estimate(self, state: int, action: int) -> int | None:
        """The state that most often followed after this period; the first seen of equals. None if none was seen."""
        usual = self.model.usual[state][action]
        return usual if usual >= 0 else None

    def update(self, state: int, action: int, reward: float, next_state: int, next_action: int, cycles: int) -> None:
        self._learn(state, action, reward, max(self.q[next_state]), self.params.gamma)
        self.model.saw(state, action, next_state)

    def terminal(self, state: int, action: int, reward: float) -> None:
        self._learn(state, action, reward, 0.0, 0.0)

    def _learn(self, state: int, action: int, reward: float, best: float, gamma: float) -> None:
        earned, alpha = reward - self.params.look_cost, self.params.alpha
        self.visits[state][action] += 1
        self.q[state][action] = q_update(self.q[state][action], earned, best, alpha, gamma)
        for before, after in enumerate(self._rest[action]):
            there = self.model.usual[state][before]
            if there >= 0 and after >= 0:
                self.q[there][after] = q_update(self.q[there][after], earned, best, alpha, gamma)
