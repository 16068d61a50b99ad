"""SARSA: learn from the action that is really taken next."""

from __future__ import annotations

from attnlab.equations import q_update
from attnlab.learners.q_learning import QLearning
from attnlab.registry import register


@register("learner", "sarsa")
class Sarsa(QLearning):
    """Q(s,a) <- (1 - alpha) Q(s,a) + alpha (R + gamma Q(s',a')) (Rummery & Niranjan 1994; Sutton & Barto 1998, 6.4):
    eq (2) of Di Nocera et al. 2014 with the next action in place of the best one. Draws nothing at random."""
    on_policy = True

    def update(self, state: int, action: int, reward: float, next_state: int, next_action: int, cycles: int) -> None:
        row = self.q[state]
        row[action] = q_update(row[action], reward, self.q[next_state][next_action], self.params.alpha,
                               self._discount[cycles])
        self.visits[state][action] += 1
