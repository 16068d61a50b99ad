"""TempoRL: how long to go on, learned beside what to do."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from attnlab.equations import q_update
from attnlab.learners.base import Learner, LearnerContext
from attnlab.registry import register
from attnlab.settings import setting


class TempoTables:
    """Biedenkapp et al. 2021 (ICML, PMLR 139:914), tabular: ``behaviour`` is Q(s,a) of doing a for one step, learned by
    Q-learning; ``skip`` is Q_J(s,j|a) of doing it for j steps, learned towards sum_{k<j} gamma^k r_{t+k} + gamma^j
    max_a' Q(s_{t+j},a'), from every stretch within a skip. Indices: state, action, and of skip the place of j in
    ``skips``."""

    def __init__(self, states: int, actions: int, skips: Sequence[int], alpha: float, gamma: float):
        self.alpha, self.gamma = alpha, gamma
        self.skips = list(skips)
        self.behaviour = [[0.0] * actions for _ in range(states)]
        self.skip = [[[0.0] * len(skips) for _ in range(actions)] for _ in range(states)]

    def step(self, state: int, action: int, reward: float, after: int | None) -> None:
        """One step of ``action``; ``after``: where it led, None if to an end."""
        row = self.behaviour[state]
        row[action] = q_update(row[action], reward, self._best(after), self.alpha, self.gamma)

    def stretch(self, state: int, action: int, earned: float, length: int, after: int | None) -> None:
        """``length`` steps of ``action``, which earned this much, discounted."""
        row = self.skip[state][action]
        j = self.skips.index(length)
        row[j] = q_update(row[j], earned, self._best(after), self.alpha, self.gamma ** length)

    def path(self, states: Sequence[int], action: int, rewards: Sequence[float], ended: bool) -> None:
        """A whole skip: n + 1 states, n rewards; ``ended``: the last state is an end, and longer skips to it are worth
        the same."""
        last = len(rewards) - 1
        for k, reward in enumerate(rewards):
            after = None if ended and k == last else states[k + 1]
            self.step(states[k], action, reward, after)
            earned = 0.0
            for i in range(k, -1, -1):
                earned, length = rewards[i] + self.gamma * earned, k + 1 - i
                if length in self.skips:
                    self.stretch(states[i], action, earned, length, after)
                if ended and k == last:
                    for longer in self.skips:
                        if longer > length:
                            self.stretch(states[i], action, earned, longer, after)

    def _best(self, state: int | None) -> float:
        return 0.0 if state is None else max(self.behaviour[state])


@register("learner", "tempo_rl")
class TempoRL(Learner):
    """TempoRL (Biedenkapp et al. 2021, as in :class:`TempoTables`) with periods for skips. A behaviour has one thing to
    do, its motor schema, so that Q(s) is the value of looking in every cycle from here on, and Q_J(s,p) that of doing
    so after a period p.

    ``observe=endpoints``: only what was looked at is known; the period's one reward R, which comes at its end, is taken
    for the rate of reward throughout it (ours: Q_J(s,p) <- sum_{k<p} gamma^k R + gamma^p Q(s'), and Q(s) learns from
    periods of one cycle). ``observe=all``: the percepts and rewards between
    looks are known, as TempoRL has it, and every stretch is learned from; whoever replays a log can give them, a robot
    that did not look cannot. Draws nothing at random.
    """

    @dataclass
    class Params:
        alpha: float = setting(0.5, "learning rate", above=0, high=1)
        gamma: float = setting(0.9, "discount a cycle", low=0, high=1)
        observe: Literal["endpoints", "all"] = setting("endpoints", "what is known of the cycles between two looks")

    params: Params

    def __init__(self, params: Params, context: LearnerContext):
        super().__init__(params, context)
        self.needs_between = params.observe == "all"
        self.tables = TempoTables(context.states, 1, context.periods, params.alpha, params.gamma)
        self._during = [0.0]
        for k in range(max(context.periods)):
            self._during.append(self._during[k] + params.gamma ** k)

    def update(self, state: int, action: int, reward: float, next_state: int, next_action: int, cycles: int) -> None:
        self._learn(state, action, reward, self._during[cycles], next_state)

    def terminal(self, state: int, action: int, reward: float) -> None:
        self._learn(state, action, reward, 1.0, None)

    def _learn(self, state: int, action: int, reward: float, during: float, after: int | None) -> None:
        self.visits[state][action] += 1
        period = self.context.periods[action]
        if period == 1:
            self.tables.step(state, 0, reward, after)
        self.tables.stretch(state, 0, during * reward, period, after)
        self.q[state][action] = self.tables.skip[state][0][action]

    def watched(self, path: Sequence[int], rewards: Sequence[float], ended: bool) -> None:
        self.tables.path(path, 0, rewards, ended)
        for state in path:
            self.q[state][:] = self.tables.skip[state][0]
