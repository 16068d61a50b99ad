"""Expected SARSA: learn from the mean over the actions that may be taken next."""

from __future__ import annotations

from random import Random

from attnlab.equations import q_update
from attnlab.exploration.base import Exploration
from attnlab.learners.q_learning import QLearning
from attnlab.registry import register


@register("learner", "expected_sarsa")
class ExpectedSarsa(QLearning):
    """Q(s,a) <- (1 - alpha) Q(s,a) + alpha (R + gamma sum_a' pi(a'|s') Q(s',a')) (van Seijen et al. 2009, ADPRL, p.
    177), pi being the exploration in use, which must say how likely its choices are. Draws nothing at random."""
    _policy: Exploration | None = None

    def decide(self, state: int, exploration: Exploration, draw: Random) -> int:
        self._policy = exploration
        return exploration.choose(self.q[state], self.visits[state], draw)

    def expected(self, state: int) -> float:
        """The value of a state under the policy; under the greedy one before anything was decided."""
        values = self.q[state]
        if self._policy is None:
            return max(values)
        chances = self._policy.probabilities(values, self.visits[state])
        mean = 0.0
        for action, chance in enumerate(chances):
            mean += chance * values[action]
        return mean

    def update(self, state: int, action: int, reward: float, next_state: int, next_action: int, cycles: int) -> None:
        row, following = self.q[state], self.expected(next_state)
        row[action] = q_update(row[action], reward, following, self.params.alpha, self._discount[cycles])
        self.visits[state][action] += 1
