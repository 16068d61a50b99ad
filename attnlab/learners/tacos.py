"""TaCoS: an action and how long it lasts, with a price for each interaction."""

from __future__ import annotations

from dataclasses import dataclass

from attnlab.equations import q_update
from attnlab.learners.base import Learner, LearnerContext
from attnlab.registry import register
from attnlab.settings import setting


@register("learner", "tacos")
class Tacos(Learner):
    """Time-adaptive control and sensing (Treven et al. 2024, NeurIPS, arXiv 2406.01163), discretised: the extended
    process's action is (what to do, for how long), its reward the integral of the running reward over that time less a
    cost of the interaction, and any learner solves it: Q(s,p) <- (1 - alpha) Q(s,p) + alpha (sum_{k<p} gamma^k R - c +
    gamma^p max Q(s')).

    Ours: R, which is known at the end of a period only, is taken for the rate of reward throughout it, and the time
    left, which is part of the paper's state, is left out. Draws nothing at random.
    """

    @dataclass
    class Params:
        alpha: float = setting(0.3, "learning rate", above=0, high=1)
        gamma: float = setting(0.98, "discount a cycle", low=0, high=1)
        look_cost: float = setting(1.0, "c: of one interaction, in rewards of a cycle", unit="UoR", low=0)

    params: Params

    def __init__(self, params: Params, context: LearnerContext):
        super().__init__(params, context)
        self._after = [params.gamma ** p for p in range(max(context.periods) + 1)]
        self._during = [0.0]
        for p in range(max(context.periods)):
            self._during.append(self._during[p] + self._after[p])

    def update(self, state: int, action: int, reward: float, next_state: int, next_action: int, cycles: int) -> None:
        earned = self._during[cycles] * reward - self.params.look_cost
        row = self.q[state]
        row[action] = q_update(row[action], earned, max(self.q[next_state]), self.params.alpha, self._after[cycles])
        self.visits[state][action] += 1

    def terminal(self, state: int, action: int, reward: float) -> None:
        row = self.q[state]
        row[action] = q_update(row[action], reward - self.params.look_cost, 0.0, self.params.alpha, 0.0)
        self.visits[state][action] += 1
