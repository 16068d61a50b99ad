"""A budget of looks over any learner."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from random import Random
from typing import Any, cast

from attnlab import registry
from attnlab.errors import ConfigError
from attnlab.exploration.base import Exploration
from attnlab.learners.base import Learner, LearnerContext
from attnlab.registry import register
from attnlab.settings import setting


class Looks:
    """How many looks each of those who share a budget has taken in this episode, after its first: ``taken[place]``."""

    def __init__(self) -> None:
        self.taken: list[int] = []

    def join(self) -> int:
        """One more shares it; its place."""
        self.taken.append(0)
        return len(self.taken) - 1

    def together(self) -> int:
        """Of all."""
        together = 0
        for taken in self.taken:
            together += taken
        return together


@register("learner", "capped")
class Capped(Learner):
    """Another learner that may not look more often than a budget allows, ours: the behaviours of a robot share
    ``looks_per_s``, and what was not used is kept. A period is granted as the other one wants it if, when it has
    elapsed, no more looks will have been taken than the time since the episode's start allows (each behaviour's first
    one is free, and looks that others have been granted but not yet taken are not known); otherwise the shortest longer
    one that keeps to it, or the longest there is. The other learns from what was granted. n behaviours cannot keep
    fewer than n looks in the longest period: they look rarely. Draws what the other draws.
    """

    @dataclass
    class Params:
        of: Any = setting("q_learning", "the learner: a name, or {name: ..., setting: ...}")
        looks_per_s: float = setting(4.0, "of all behaviours together", unit="1/s", above=0)

    params: Params

    def __init__(self, params: Params, context: LearnerContext):
        inner = self.inner = _made(params.of, context)  # before the rest: its tables are ours
        super().__init__(params, context)
        self.learns, self.on_policy, self.needs_between = inner.learns, inner.on_policy, inner.needs_between
        self._a_cycle = params.looks_per_s * context.reading.dt_s
        self._rising = sorted(range(self.actions), key=lambda action: context.periods[action])
        self._begun, self._now = False, 0
        self._looks: Looks = context.shared.setdefault("looks", Looks())
        self._place = self._looks.join()

    @property
    def q(self) -> list[list[float]]:
        return self.inner.q

    @q.setter
    def q(self, _: list[list[float]]) -> None:
        """Every learner is given one; this one has the other's."""

    @property
    def visits(self) -> list[list[int]]:
        return self.inner.visits

    @visits.setter
    def visits(self, _: list[list[int]]) -> None:
        """The same."""

    def values(self, state: int) -> list[float]:
        return self.inner.values(state)

    def start(self) -> None:
        self.inner.start()
        self._begun, self._now = False, 0
        self._looks.taken[self._place] = 0

    def decide(self, state: int, exploration: Exploration, draw: Random) -> int:
        periods = self.context.periods
        if self._begun:
            self._now += periods[state // self.context.bins % len(periods)]
            self._looks.taken[self._place] += 1
        self._begun = True
        wanted, looks = self.inner.decide(state, exploration, draw), 1 + self._looks.together()
        for action in self._rising:
            if periods[action] >= periods[wanted] and looks <= self._a_cycle * (self._now + periods[action]) + 1e-9:
                return action
        return self._rising[-1]

    def update(self, state: int, action: int, reward: float, next_state: int, next_action: int, cycles: int) -> None:
        self.inner.update(state, action, reward, next_state, next_action, cycles)

    def terminal(self, state: int, action: int, reward: float) -> None:
        self.inner.terminal(state, action, reward)

    def watched(self, path: Sequence[int], rewards: Sequence[float], ended: bool) -> None:
        self.inner.watched(path, rewards, ended)


def _made(of: Any, context: LearnerContext) -> Learner:
    """The learner that the setting names. Raises ConfigError."""
    name = of if isinstance(of, str) else str(dict(of or {}).get("name"))
    spec = registry.find("learner", name)
    if spec is None:
        raise registry.unknown("learner", name, "learner.of")
    kind: type[Learner] = spec.cls
    if kind is Capped or kind.rehearses():
        raise ConfigError("learner.of", f"{name} cannot be capped")
    node = {**spec.nodes()[name], **(of if isinstance(of, Mapping) else {})}
    return cast("Learner", registry.make("learner", node, context, "learner.of"))
