"""Baselines that learn nothing: a fixed period, a random one, no clocks at all."""

from __future__ import annotations

from dataclasses import dataclass
from random import Random

from attnlab.errors import ConfigError
from attnlab.exploration.base import Exploration
from attnlab.learners.base import Learner, LearnerContext
from attnlab.registry import register
from attnlab.settings import setting


class NoLearner(Learner):
    """Counts what was chosen, learns nothing; in validation as in training."""
    learns = False

    def update(self, state: int, action: int, reward: float, next_state: int, next_action: int, cycles: int) -> None:
        self.visits[state][action] += 1

    def terminal(self, state: int, action: int, reward: float) -> None:
        self.visits[state][action] += 1


@register("learner", "fixed", presets={f"fixed_{p}": {"period": p} for p in (1, 4, 8, 12)})
class Fixed(NoLearner):
    """Always the same period; ``periods`` sets it by behaviour ("avoid": 4), -1 there means a random one.

    ``fixed_1``, ``fixed_4``, ``fixed_8``, ``fixed_12`` are ready-made. Draws from the exploration stream only for -1.
    """

    @dataclass
    class Params:
        period: int = setting(4, "of every behaviour not named in periods", unit="mc")
        periods: dict[str, int] = setting({}, "period by behaviour, -1 for a random one", unit="mc")

    params: Params

    def __init__(self, params: Params, context: LearnerContext):
        super().__init__(params, context)
        period = params.periods.get(context.behaviour, params.period)
        if period != -1 and period not in context.periods:
            raise ConfigError("period", f"{period} is not one of the periods {list(context.periods)}")
        self._action = None if period == -1 else list(context.periods).index(period)

    def decide(self, state: int, exploration: Exploration, draw: Random) -> int:
        return int(draw.random() * self.actions) if self._action is None else self._action


@register("learner", "random")
class RandomPeriod(NoLearner):
    """A period drawn uniformly at every activation (stream ``exploration/<behaviour>``)."""

    def decide(self, state: int, exploration: Exploration, draw: Random) -> int:
        return int(draw.random() * self.actions)


@register("learner", "always_on")
class AlwaysOn(NoLearner):
    """No clocks: every behaviour looks in every cycle. With costs a cycle it is the same robot as ``fixed_1``, and a
    study that holds both can check that."""

    def decide(self, state: int, exploration: Exploration, draw: Random) -> int:
        return 0
