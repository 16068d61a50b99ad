"""Timing as an action: one model of a cycle, from which every period is planned."""

from __future__ import annotations

from dataclasses import dataclass

from attnlab.learners.base import Learner, LearnerContext
from attnlab.learners.chain import Chain
from attnlab.registry import register
from attnlab.settings import setting


@register("learner", "timing")
class Timing(Learner):
    """Timing as an action (Zhou, Huang, Azizzadenesheli, Childers & Lipton 2024, AISTATS, PMLR 238), tabular and
    model-based: delays add no parameters to the model, because what happens in p cycles is P^p.

    P is estimated over percepts and death from looks of all periods together (expectation maximisation, ours:
    :mod:`attnlab.learners.chain`), the mean reward of arriving at a percept after a period is counted, and values are
    those of the model's own plan: Q(x,p) = sum_x' P^p(x,x') (r(p,x') - c + gamma max Q(x')) + P^p(x,death) r(death),
    by sweeps of value iteration. It knows percepts only: neither the period in force nor curiosity sets its states
    apart. Draws nothing at random.
    """

    @dataclass
    class Params:
        gamma: float = setting(0.9, "discount of a decision", low=0, high=0.999)
        look_cost: float = setting(0.0, "c: of one look", unit="UoR", low=0)
        sweeps: int = setting(20, "of value iteration whenever the model is renewed", low=1, high=1000)

    params: Params

    def __init__(self, params: Params, context: LearnerContext):
        super().__init__(params, context)
        self.chain = Chain(context.bins, context.periods)
        self.earned = [[0.0] * context.bins for _ in context.periods]
        self.arrived = [[0] * context.bins for _ in context.periods]
        self.died, self.deaths = 0.0, 0
        self.plan = [[0.0] * self.actions for _ in range(context.bins)]

    def values(self, state: int) -> list[float]:
        return self.plan[state % self.context.bins]

    def update(self, state: int, action: int, reward: float, next_state: int, next_action: int, cycles: int) -> None:
        self.visits[state][action] += 1
        after = next_state % self.context.bins
        self.arrived[action][after] += 1
        self.earned[action][after] += (reward - self.earned[action][after]) / self.arrived[action][after]
        self._learn(state, cycles, after)

    def terminal(self, state: int, action: int, reward: float) -> None:
        self.visits[state][action] += 1
        self.deaths += 1
        self.died += (reward - self.died) / self.deaths
        self._learn(state, self.context.periods[action], self.chain.death)

    def _learn(self, state: int, cycles: int, after: int) -> None:
        if self.chain.add(state % self.context.bins, cycles, after):
            self.chain.renew()
            self._replan()

    def _replan(self) -> None:
        p, n = self.params, self.context.bins
        for _ in range(p.sweeps):
            best = [max(row) for row in self.plan]
            for i, period in enumerate(self.context.periods):
                reached = self.chain.powers[period]
                worth = [self.earned[i][x] - p.look_cost + p.gamma * best[x] for x in range(n)]
                for x in range(n):
                    value = reached[x][n] * self.died
                    for k, then in enumerate(worth):
                        value += reached[x][k] * then
                    self.plan[x][i] = value
