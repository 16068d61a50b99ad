"""Double Q-learning: two tables, so that luck is not taken for value."""

from __future__ import annotations

from attnlab.equations import q_update
from attnlab.learners.base import LearnerContext
from attnlab.learners.q_learning import QLearning, TabularParams
from attnlab.registry import register


@register("learner", "double_q")
class DoubleQ(QLearning):
    """van Hasselt 2010 (NIPS 23): a coin (stream ``learner/<behaviour>``) picks the table to update; the best next
    action is that table's, its value the other's: Q1(s,a) <- (1 - alpha) Q1(s,a) + alpha (R + gamma Q2(s', argmax
    Q1(s'))).

    ``q`` and ``values`` are the mean of both. Draws one number an update.
    """
    def __init__(self, params: TabularParams, context: LearnerContext):
        super().__init__(params, context)
        self._tables = [[[0.0] * self.actions for _ in range(context.states)] for _ in range(2)]

    def _learn(self, state: int, action: int, reward: float, next_state: int | None, discount: float) -> None:
        coin = 1 if self.context.draw.random() < 0.5 else 0
        mine, other = self._tables[coin], self._tables[1 - coin]
        best = 0.0
        if next_state is not None:
            row = mine[next_state]
            best = other[next_state][row.index(max(row))]
        mine[state][action] = q_update(mine[state][action], reward, best, self.params.alpha, discount)
        self.q[state][action] = 0.5 * (mine[state][action] + other[state][action])
        self.visits[state][action] += 1

    def update(self, state: int, action: int, reward: float, next_state: int, next_action: int, cycles: int) -> None:
        self._learn(state, action, reward, next_state, self._discount[cycles])

    def terminal(self, state: int, action: int, reward: float) -> None:
        self._learn(state, action, reward, None, 0.0)
