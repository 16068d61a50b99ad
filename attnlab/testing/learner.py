"""Checks of a learner and of an exploration."""

from __future__ import annotations

import copy
import math
import pickle
from random import Random
from typing import Any

from attnlab.learners.base import Learner
from attnlab.testing.build import make


def journey(name: str, settings: dict[str, Any], steps: int = 400, restart: bool = False
            ) -> tuple[Learner, list[tuple[int, list[float]]]]:
    """(learner, actions and values) of a walk through random states, an episode every 100 steps."""
    learner: Learner = make("learner", name, **settings)
    walk, draw, exploration = Random(5), Random(6), make("exploration", "softmax")
    trace, state, action = [], 0, 0
    for step in range(steps):
        if step % 100 == 0:
            learner.start()
        if restart and step == steps // 2:
            learner = pickle.loads(pickle.dumps(learner))
        after = walk.randrange(learner.context.states)
        chosen = learner.decide(after, exploration, draw) if learner.on_policy else -1
        if step % 100 == 99:
            learner.terminal(state, action, -1500.0)
        else:
            learner.update(state, action, walk.random(), after, chosen, learner.context.periods[action])
        action = chosen if learner.on_policy else learner.decide(after, exploration, draw)
        state = after
        trace.append((action, list(learner.values(state))))
    return learner, trace


def actions_in_range(name: str, **settings: Any) -> None:
    """Every decision is an index of the periods, every value is a finite number, one for each period."""
    learner, trace = journey(name, settings)
    for action, values in trace:
        assert isinstance(action, int) and 0 <= action < learner.actions, f"{name}: chose {action}, no period's index"
        assert len(values) == learner.actions and all(map(math.isfinite, values)), f"{name}: values {values}"


def values_pure(name: str, **settings: Any) -> None:
    """Reading values changes nothing."""
    learner, _ = journey(name, settings)
    before = pickle.dumps(learner)
    first = [list(learner.values(s)) for s in range(learner.context.states)]
    assert first == [list(learner.values(s)) for s in range(learner.context.states)]
    assert pickle.dumps(learner) == before, f"{name}: values() changed the learner; learn in update"


def deterministic(name: str, **settings: Any) -> None:
    """The same experience teaches the same, draws from context.draw included."""
    assert journey(name, settings)[1] == journey(name, settings)[1], f"{name}: the same experience taught otherwise"


def serialisable(name: str, **settings: Any) -> None:
    """A learner that was pickled and read back goes on as if nothing had happened."""
    assert journey(name, settings)[1] == journey(name, settings, restart=True)[1]


def counts_visits(name: str, **settings: Any) -> None:
    """Every update and every terminal adds one visit: the policy table reports them."""
    learner, _ = journey(name, settings, steps=250)
    assert sum(map(sum, learner.visits)) == 250, f"{name}: {sum(map(sum, learner.visits))} visits after 250 updates"


LEARNER = (actions_in_range, values_pure, deterministic, serialisable, counts_visits)

VALUES = ([0.0, 0.0, 0.0, 0.0], [1.0, 2.0, 3.0, 2.5], [-1200.0, 0.5, 0.4, 0.3], [5.0], [1e6, -1e6])


def chooses_in_range(name: str, **settings: Any) -> None:
    """The choice is an index of the values; values and visits stay as they are; the stream decides alone."""
    runs = []
    for _ in range(2):
        exploration, draw, chosen = make("exploration", name, **settings), Random(1), []
        for episode in range(30):
            exploration.start(episode)
            for values in VALUES:
                visits = [episode] * len(values)
                before = copy.deepcopy((values, visits))
                action = exploration.choose(values, visits, draw)
                assert isinstance(action, int) and 0 <= action < len(values), f"{name}: chose {action} of {len(values)}"
                assert (values, visits) == before, f"{name}: changed the values or visits it was shown"
                chosen.append(action)
        runs.append(chosen)
    assert runs[0] == runs[1], f"{name}: the same stream gave other choices"


def probabilities_match(name: str, **settings: Any) -> None:
    """``probabilities`` sum to 1 and are the frequencies of ``choose``."""
    exploration, draw = make("exploration", name, **settings), Random(2)
    exploration.start(3)
    values, visits, n = [0.0, 1.0, 0.5, 0.2], [3, 3, 3, 3], 4000
    expected = exploration.probabilities(values, visits)
    assert math.isclose(sum(expected), 1.0) and min(expected) >= 0.0
    counts = [0] * 4
    for _ in range(n):
        counts[exploration.choose(values, visits, draw)] += 1
    for count, p in zip(counts, expected, strict=True):
        assert abs(count / n - p) < 5 * math.sqrt(0.25 / n), f"{name}: chose {counts}, said {expected}"


EXPLORATION = (chooses_in_range, probabilities_match)
