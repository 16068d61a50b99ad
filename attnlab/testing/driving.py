"""A learner on a chain of percepts (:mod:`attnlab.testing.processes`), without a robot."""

from __future__ import annotations

from collections.abc import Callable
from random import Random
from typing import Any

from attnlab.learners.base import Learner
from attnlab.testing.build import make
from attnlab.testing.processes import BINS, PERIODS, Matrix


def clock(name: str, **settings: Any) -> Any:
    """The learner of AVOID's clock without levels of curiosity: states are ``period * BINS + percept``."""
    return make("learner", name, levels=("none",), **settings)


def drive(learner: Any, step: Matrix, reward: Callable[[int, int], float], looks: int, seed: int = 0,
          choose: Callable[[int], int] | None = None) -> Any:
    """``learner`` after so many looks. A period p that leads to x' earns ``reward(p, x')``; one with ``needs_between``
    is shown every cycle, each of which earns ``reward(1, x')``. Periods at random, unless ``choose(state)`` says
    otherwise."""
    draw = Random(seed)
    percept, action = 0, 0
    state = action * BINS + percept
    for _ in range(looks):
        action = draw.randrange(len(PERIODS)) if choose is None else choose(state)
        path = [percept]
        for _ in range(PERIODS[action]):
            path.append(draw.choices(range(BINS), step[path[-1]])[0])
        after = action * BINS + path[-1]
        if learner.needs_between:
            learner.watched([state, *(action * BINS + x for x in path[1:])], [reward(1, x) for x in path[1:]], False)
        else:
            learner.update(state, action, reward(PERIODS[action], path[-1]), after, -1, PERIODS[action])
        percept, state = path[-1], after
    return learner


def greedy(learner: Learner, state: int) -> int:
    """The action of the largest value, the first of equals."""
    values = learner.values(state)
    return values.index(max(values))
