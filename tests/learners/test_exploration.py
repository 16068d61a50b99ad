"""Explorations by hand, with the numbers they draw."""

from __future__ import annotations

from math import log, sqrt

import pytest

from attnlab.errors import ConfigError
from attnlab.testing import make
from tests.behaviours.senses import Draws

VALUES, VISITS = [1.0, 3.0, 2.0, 3.0], [4, 4, 4, 4]


def test_greedy_takes_the_first_of_the_best():
    greedy = make("exploration", "greedy")
    assert greedy.choose(VALUES, VISITS, None) == 1
    assert greedy.probabilities(VALUES, VISITS) == [0.0, 1.0, 0.0, 0.0]


@pytest.mark.parametrize(("ties", "draws", "action", "chances"), [
    ("last", (), 2, [0.0, 0.0, 1.0, 0.0]), ("random", (0.49,), 1, [0.0, 0.5, 0.5, 0.0]),
    ("random", (0.51,), 2, [0.0, 0.5, 0.5, 0.0])])
def test_greedy_between_equals(ties, draws, action, chances):
    greedy = make("exploration", "greedy", ties=ties)
    assert greedy.choose([1.0, 3.0, 3.0, 2.0], VISITS, Draws(*draws)) == action
    assert greedy.probabilities([1.0, 3.0, 3.0, 2.0], VISITS) == chances
    assert greedy.choose([1.0, 3.0, 4.0, 2.0], VISITS, Draws()) == 2  # draws nothing where one is best


@pytest.mark.parametrize(("draws", "action"), [
    ((0.25,), 1), ((0.3,), 1), ((0.24, 0.0), 0), ((0.0, 0.25), 1), ((0.24, 0.74), 2), ((0.1, 0.99), 3)])
def test_epsilon_greedy(draws, action):
    """epsilon 0.25: below it a second number chooses among the four, from it on the first of the best is taken."""
    stream = Draws(*draws)
    assert make("exploration", "epsilon_greedy", epsilon=0.25).choose(VALUES, VISITS, stream) == action
    assert stream.numbers == []


def test_probabilities_of_epsilon_greedy():
    explore = make("exploration", "epsilon_greedy", epsilon=0.4)
    assert explore.probabilities(VALUES, VISITS) == pytest.approx([0.1, 0.7, 0.1, 0.1])


@pytest.mark.parametrize(("drawn", "action"), [(0.0, 0), (0.24, 0), (0.25, 1), (0.5, 2), (0.75, 3), (0.99, 3)])
def test_softmax_of_equals(drawn, action):
    assert make("exploration", "softmax").choose([7.0] * 4, VISITS, Draws(drawn)) == action


def test_softmax_by_hand():
    """e^(q/tau) is 1, 4, 2, 1 at tau 2: an eighth, a half, a quarter, an eighth."""
    explore = make("exploration", "softmax", tau=2.0)
    values = [0.0, 2 * log(4), 2 * log(2), 0.0]
    assert explore.probabilities(values, VISITS) == pytest.approx([0.125, 0.5, 0.25, 0.125])
    assert [explore.choose(values, VISITS, Draws(x)) for x in (0.12, 0.13, 0.62, 0.63, 0.87, 0.88)] \
        == [0, 1, 1, 2, 2, 3]


def test_softmax_takes_the_best_if_rounding_leaves_nothing():
    assert make("exploration", "softmax").choose([0.0, 1.0, 0.5], VISITS, Draws(1.0 + 1e-9)) == 1


@pytest.mark.parametrize("c", [1.0, 2.0])
def test_ucb1_by_hand(c):
    """20 trials, 15 and 5: by uncertainty alone the second is ahead by c (sqrt(2 ln 20 / 5) - sqrt(2 ln 20 / 15)),
    and a value that much higher makes up for it."""
    ucb, ahead = make("exploration", "ucb1", c=c), c * (sqrt(2 * log(20) / 5) - sqrt(2 * log(20) / 15))
    for more, best in ((-0.01, 1), (0.01, 0)):
        assert ucb.choose([1.0 + ahead + more, 1.0], [15, 5], None) == best
        assert ucb.probabilities([1.0 + ahead + more, 1.0], [15, 5]) == [1.0 - best, best]
    assert ucb.choose([9.0, 0.0, 0.0], [3, 0, 0], None) == 1  # what was never tried comes first


def test_annealed_by_hand():
    """From 8 to 2 in ten episodes: half way 8 / 2 by equal factors, 5 in a straight line; 2 for ever after."""
    for shape, halfway in (("exponential", 4.0), ("linear", 5.0)):
        schedule = make("exploration", "annealed", first=8.0, last=2.0, episodes=10, shape=shape)
        assert [schedule.value(e) for e in (0, 5, 10, 11, 500)] == pytest.approx([8.0, halfway, 2.0, 2.0, 2.0])


def test_annealed_down_to_nothing_only_in_a_straight_line():
    straight = make("exploration", "annealed", over="epsilon_greedy", what="epsilon", first=0.5, last=0.0, episodes=2,
                    shape="linear")
    assert [straight.value(e) for e in (0, 1, 2)] == [0.5, 0.25, 0.0]
    with pytest.raises(ConfigError, match="needs first and last above 0"):
        make("exploration", "annealed", over="epsilon_greedy", what="epsilon", first=0.5, last=0.0)
