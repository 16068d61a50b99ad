"""Q-learning."""

from __future__ import annotations

from dataclasses import dataclass

from attnlab.equations import q_update
from attnlab.learners.base import Learner, LearnerContext
from attnlab.registry import register
from attnlab.settings import setting


@dataclass
class TabularParams:
    alpha: float = setting(0.8, "learning rate (Table 4)", above=0, high=1)
    gamma: float = setting(0.9, "discount (Table 4)", low=0, high=1)


@register("learner", "q_learning")
class QLearning(Learner):
    """Eq (2) of Di Nocera et al. 2014 (Watkins & Dayan 1992), one table a behaviour, all values 0 at the start.

    ``reading.q_update=smdp`` discounts by gamma^period instead of gamma (Bradtke & Duff 1995). Draws nothing at random.
    """
    Params = TabularParams
    params: TabularParams

    def __init__(self, params: TabularParams, context: LearnerContext):
        super().__init__(params, context)
        longest = max(context.periods)
        smdp = context.reading.q_update == "smdp"
        self._discount = [params.gamma ** (cycles if smdp else 1) for cycles in range(longest + 1)]

    def update(self, state: int, action: int, reward: float, next_state: int, next_action: int, cycles: int) -> None:
        row = self.q[state]
        row[action] = q_update(row[action], reward, max(self.q[next_state]), self.params.alpha, self._discount[cycles])
        self.visits[state][action] += 1

    def terminal(self, state: int, action: int, reward: float) -> None:
        row = self.q[state]
        row[action] = q_update(row[action], reward, 0.0, self.params.alpha, 0.0)
        self.visits[state][action] += 1
