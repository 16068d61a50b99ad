"""Q(lambda): what was done a while ago learns too."""

from __future__ import annotations

from dataclasses import dataclass

from attnlab.learners.base import LearnerContext
from attnlab.learners.q_learning import QLearning, TabularParams
from attnlab.registry import register
from attnlab.settings import setting


@register("learner", "q_lambda")
class QLambda(QLearning):
    """Watkins's Q(lambda) (Watkins 1989; Sutton & Barto 1998, 7.6, 7.8): with delta = R + gamma max Q(s') - Q(s,a),
    every Q(x,b) grows by alpha delta e(x,b); the trace e(s,a) is 1 when visited (replacing), fades by gamma lambda,
    and all are cut when the next action is not a greedy one, and at the start of an episode. Draws nothing at
    random."""
    on_policy = True

    @dataclass
    class Params(TabularParams):
        lam: float = setting(0.8, "lambda: fading of the traces", low=0, high=1)
        least: float = setting(1e-3, "traces below this are dropped", above=0, high=1)

    params: Params

    def __init__(self, params: Params, context: LearnerContext):
        super().__init__(params, context)
        self._traces = [[0.0] * self.actions for _ in range(context.states)]
        self._traced, self._n = [0] * (context.states * self.actions), 0  # where there are any: the first n

    def start(self) -> None:
        self._fade(0.0)

    def _fade(self, factor: float) -> None:
        kept = 0
        for place in self._traced[:self._n]:
            x, b = divmod(place, self.actions)
            trace = factor * self._traces[x][b]
            self._traces[x][b] = trace if trace >= self.params.least else 0.0
            if trace >= self.params.least:
                self._traced[kept] = place
                kept += 1
        self._n = kept

    def _spread(self, state: int, action: int, delta: float) -> None:
        if self._traces[state][action] == 0.0:
            self._traced[self._n] = state * self.actions + action
            self._n += 1
        self._traces[state][action] = 1.0
        step = self.params.alpha * delta
        for place in self._traced[:self._n]:
            x, b = divmod(place, self.actions)
            self.q[x][b] += step * self._traces[x][b]
        self.visits[state][action] += 1

    def update(self, state: int, action: int, reward: float, next_state: int, next_action: int, cycles: int) -> None:
        following, discount = self.q[next_state], self._discount[cycles]
        best = max(following)
        greedy = following[next_action] == best
        self._spread(state, action, reward + discount * best - self.q[state][action])
        self._fade(discount * self.params.lam if greedy else 0.0)

    def terminal(self, state: int, action: int, reward: float) -> None:
        self._spread(state, action, reward - self.q[state][action])
        self._fade(0.0)
