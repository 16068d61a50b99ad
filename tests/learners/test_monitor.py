"""Monitoring functions by hand; schedules and bandits."""

from math import log, sqrt
from random import Random

import pytest

from attnlab.errors import ConfigError
from attnlab.testing import make

PERIODS = [1, 4, 8, 12]


def periods(learner, percepts, before=0):
    """The periods granted to these percepts; ``before`` is the index of the period that elapsed."""
    learner.start()
    found = []
    for percept in percepts:
        before = learner.decide(before * 6 + percept, None, None)
        found.append(PERIODS[before])
    return found


def test_linear():
    # 1, 3.2, 5.4, 7.6, 9.8, 12 -> the nearest of 1, 4, 8, 12
    assert periods(make("learner", "monitor"), range(6)) == [1, 4, 4, 8, 8, 12]
    assert periods(make("learner", "monitor", behaviour="eat"), range(6)) == [12, 8, 8, 4, 4, 1]


def test_bend():
    learner = make("learner", "monitor", behaviours={"avoid": {"bend": 2.0}})
    # 11 * (i/5)^2 + 1 = 1, 1.44, 2.76, 4.96, 8.04, 12
    assert periods(learner, range(6)) == [1, 1, 4, 4, 8, 12]


def test_table():
    learner = make("learner", "monitor", behaviours={"avoid": {"kind": "table", "table": [1, 1, 4, 4, 8, 12]}})
    assert periods(learner, range(6)) == [1, 1, 4, 4, 8, 12]
    with pytest.raises(ConfigError, match=r"must be 6 periods out of \[1, 4, 8, 12\]"):
        make("learner", "monitor", behaviours={"avoid": {"kind": "table", "table": [1, 2, 3]}})
    with pytest.raises(ConfigError, match="learner.behaviours.avoid.knd: no such setting. Did you mean 'kind'"):
        make("learner", "monitor", behaviours={"avoid": {"knd": "table"}})


def test_derivative_watches_what_changes():
    learner = make("learner", "monitor", behaviours={"avoid": {"kind": "derivative", "gain": 20.0}})
    # nothing to compare with: 1; then no change: 12; from 3 to 1 in 12 cycles: 12/(1 + 20*2/48) = 6.5 -> 8
    assert periods(learner, [3, 3, 1]) == [1, 12, 8]
    # 5 -> 0 in one cycle: 12/(1 + 20*5/6) = 0.7 -> 1
    assert periods(learner, [5, 0]) == [1, 1]


def test_ucb1():
    ucb = make("exploration", "ucb1", c=2.0)
    assert ucb.choose([5.0, 0.0, 1.0], [3, 1, 0], None) == 2
    values, visits = [0.5, 0.4, 0.0], [10, 2, 4]
    bounds = [q + 2.0 * sqrt(2 * log(16) / n) for q, n in zip(values, visits, strict=True)]
    assert ucb.choose(values, visits, None) == bounds.index(max(bounds)) == 1
    assert make("exploration", "ucb1", c=0.0).choose(values, visits, None) == 0


def test_annealed():
    falling = make("exploration", "annealed", over="softmax", what="tau", first=8.0, last=2.0, episodes=10)
    assert [falling.value(e) for e in (0, 5, 10, 99)] == pytest.approx([8.0, 4.0, 2.0, 2.0])
    linear = make("exploration", "annealed", over={"name": "epsilon_greedy"}, what="epsilon", first=1.0, last=0.0,
                  episodes=4, shape="linear")
    assert [linear.value(e) for e in range(5)] == pytest.approx([1.0, 0.75, 0.5, 0.25, 0.0])
    assert linear.probabilities([0.0, 1.0], [1, 1]) == [0.0, 1.0]  # before training it is at its end
    linear.start(0)
    assert linear.probabilities([0.0, 1.0], [1, 1]) == [0.5, 0.5]
    assert len({linear.choose([0.0, 1.0], [1, 1], Random(s)) for s in range(20)}) == 2


@pytest.mark.parametrize(("settings", "message"), [
    ({"what": "taau"}, r"exploration.over.taau: no such setting. Did you mean 'tau'"),
    ({"first": -1.0}, "needs first and last above 0"),
    ({"over": "epsilon"}, "no exploration is called 'epsilon'. Did you mean 'epsilon_greedy'"),
    ({"over": "epsilon_greedy", "what": "epsilon", "first": 2.0}, "is 2.0, must be at most 1"),
])
def test_annealed_refuses(settings, message):
    with pytest.raises(ConfigError, match=message):
        make("exploration", "annealed", **settings)
