"""One step of every learner by hand: alpha 0.5, gamma 0.5 unless said otherwise; periods 1, 4, 8, 12."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from attnlab.errors import ConfigError
from attnlab.testing import make
from tests.behaviours.senses import Draws

HALF = {"alpha": 0.5, "gamma": 0.5}


def learner(name, **settings):
    """A learner of q(0, 1) = 2 whose next state 5 has the values 1, 8, 4, 0."""
    made = make("learner", name, **{**HALF, **settings})
    made.q[0][1] = 2.0
    made.q[5] = [1.0, 8.0, 4.0, 0.0]
    return made


@pytest.mark.parametrize(("name", "how", "after"), [
    ("q_learning", {}, 1.0 + 0.5 * (3.0 + 0.5 * 8.0)), ("sarsa", {}, 1.0 + 0.5 * (3.0 + 0.5 * 4.0)),
    ("q_learning", {"q_update": "smdp"}, 1.0 + 0.5 * (3.0 + 0.0625 * 8.0)),
    ("sarsa", {"q_update": "smdp"}, 1.0 + 0.5 * (3.0 + 0.0625 * 4.0)),
    ("expected_sarsa", {}, 1.0 + 0.5 * (3.0 + 0.5 * 8.0)),  # nothing was decided yet: the greedy policy
    ("q_lambda", {}, 2.0 + 0.5 * (3.0 + 0.5 * 8.0 - 2.0))])
def test_one_period(name, how, after):
    """A reward of 3 after 4 cycles; the third action comes next. 0.5^4 is a sixteenth."""
    made = learner(name, how=how)
    made.update(0, 1, 3.0, 5, 2, 4)
    assert made.q[0] == [0.0, pytest.approx(after), 0.0, 0.0]
    assert (made.visits[0], sum(map(sum, made.visits))) == ([0, 1, 0, 0], 1)


@pytest.mark.parametrize("name", ["q_learning", "sarsa", "expected_sarsa", "q_lambda"])
def test_the_longest_period_and_the_last_one(name):
    """Discounts go up to the 12th cycle; after death nothing is to be expected: 2 becomes (2 - 10) / 2."""
    made = learner(name, gamma=1.0)
    made.update(7, 3, 0.0, 5, 1, 12)
    assert made.q[7][3] == pytest.approx(4.0)
    made.terminal(0, 1, -10.0)
    assert made.q[0][1] == pytest.approx(-4.0) and made.visits[0] == [0, 1, 0, 0]


def test_the_smallest_of_what_is_discounted():
    """gamma 0 looks at nothing to come, and the first cycle of smdp is discounted once."""
    made = learner("q_learning", how={"q_update": "smdp"})
    made.update(0, 1, 0.0, 5, -1, 1)
    assert made.q[0][1] == pytest.approx(1.0 + 0.5 * 0.5 * 8.0)
    blind = learner("q_learning", gamma=0.0)
    blind.update(0, 1, 3.0, 5, -1, 4)
    assert blind.q[0][1] == pytest.approx(2.5)


def test_expected_sarsa_averages_over_its_exploration():
    """epsilon 0.4: 0.1 each, and 0.6 more for the best of 1, 8, 4, 0: 0.1 * 13 + 0.6 * 8 = 6.1."""
    made = learner("expected_sarsa")
    made.decide(5, make("exploration", "epsilon_greedy", epsilon=0.4), Draws(0.9))
    assert made.expected(5) == pytest.approx(6.1)
    made.update(0, 1, 3.0, 5, -1, 4)
    assert made.q[0][1] == pytest.approx(1.0 + 0.5 * (3.0 + 0.5 * 6.1))


def double(*coins):
    """Double Q-learning with tables of q(0, 1) = 2 and 6 and next values best at different actions."""
    made = make("learner", "double_q", **HALF)
    made.context = SimpleNamespace(draw=Draws(*coins))
    tails, heads = made._tables
    tails[0][1], heads[0][1], tails[5], heads[5] = 2.0, 6.0, [1.0, 8.0, 4.0, 0.0], [3.0, 10.0, 20.0, 7.0]
    return made


@pytest.mark.parametrize(("coin", "mine", "other"), [
    (0.5, 1.0 + 0.5 * (3.0 + 0.5 * 10.0), 6.0),  # the first table picks action 1, the second says it is worth 10
    (0.499, 3.0 + 0.5 * (3.0 + 0.5 * 4.0), 2.0), (0.0, 5.5, 2.0), (0.99, 5.0, 6.0)])
def test_double_q_asks_one_table_and_believes_the_other(coin, mine, other):
    made = double(coin)
    made.update(0, 1, 3.0, 5, -1, 4)
    assert made.q[0] == [0.0, pytest.approx((mine + other) / 2), 0.0, 0.0] and made.visits[0] == [0, 1, 0, 0]
    made = double(coin)
    made.terminal(0, 1, -10.0)
    assert made.q[0][1] == pytest.approx(((6.0 if coin < 0.5 else 2.0) / 2 - 5.0 + other) / 2)
    assert made.visits[0] == [0, 1, 0, 0]


def test_both_tables_of_double_q_begin_at_zero():
    """One of them learns half of 4; the mean of both is 1."""
    made = make("learner", "double_q", **HALF)
    made.update(0, 1, 4.0, 5, -1, 4)
    assert made.q[0] == [0.0, 1.0, 0.0, 0.0]


def traced(lam=0.5, **settings):
    """Q(lambda) with alpha 0.5 and gamma 0.8, so that a trace fades by 0.4 a period."""
    return make("learner", "q_lambda", alpha=0.5, gamma=0.8, lam=lam, **settings)


def test_traces_by_hand():
    """0 -> 1 -> 2 with the rewards 10 and 20 and no values: 5, then 10 of which 0.4 go back to the first."""
    made = traced()
    made.update(0, 1, 10.0, 1, 0, 4)
    made.update(1, 2, 20.0, 2, 0, 4)
    assert (made.q[0][1], made.q[1][2]) == (pytest.approx(5.0 + 4.0), pytest.approx(10.0))
    made.terminal(2, 3, -100.0)
    assert (made.q[2][3], made.q[1][2], made.q[0][1]) == pytest.approx((-50.0, 10.0 - 20.0, 9.0 - 8.0))
    made.update(3, 0, 10.0, 4, 0, 4)  # after death nothing is traced
    assert (made.q[0][1], made.q[3][0]) == pytest.approx((1.0, 5.0))


def test_a_trace_replaces_itself():
    """Seen twice running, its trace is 1 and not 1.4: 5, then 5 + 0.5 (20 - 5)."""
    made = traced()
    made.update(0, 1, 10.0, 1, 0, 4)
    made.update(0, 1, 20.0, 1, 0, 4)
    assert made.q[0][1] == pytest.approx(12.5)


@pytest.mark.parametrize(("chosen", "back"), [(1, 4.0), (0, 0.0)])
def test_a_choice_that_is_not_greedy_cuts_the_traces(chosen, back):
    """The next state is worth 5 by action 1: Q(0, 1) = 0.5 * 0.8 * 5 = 2; then a reward of 20 is learned there."""
    made = traced()
    made.q[1][1] = 5.0
    made.update(0, 1, 0.0, 1, chosen, 4)
    assert made.q[0][1] == pytest.approx(2.0)
    made.update(2, 2, 20.0, 3, 0, 4)
    assert made.q[0][1] == pytest.approx(2.0 + back)


def test_the_least_trace_is_kept_and_a_smaller_one_dropped():
    """It fades by a quarter a period: to 0.25 and then to 0.0625."""
    for least, kept in ((0.0625, 0.5 * 16.0 * 0.0625), (0.07, 0.0)):
        made = make("learner", "q_lambda", alpha=0.5, gamma=0.5, lam=0.5, least=least)
        made.update(0, 1, 0.0, 1, 0, 4)
        made.update(1, 1, 0.0, 2, 0, 4)
        made.update(2, 1, 16.0, 3, 0, 4)
        assert made.q[0][1] == pytest.approx(kept)


def test_an_episode_begins_without_traces():
    made = traced()
    made.update(0, 1, 0.0, 1, 0, 4)
    made.start()
    made.update(1, 1, 20.0, 2, 0, 4)
    assert made.q[0][1] == 0.0


def test_baselines_count_and_choose():
    for name in ("fixed", "random", "always_on", "monitor"):
        made = make("learner", name)
        made.update(3, 1, 0.5, 4, -1, 4)
        made.terminal(3, 1, -1500.0)
        assert made.visits[3] == [0, 2, 0, 0] and made.q[3] == [0.0] * 4
    assert make("learner", "always_on").decide(0, None, None) == 0
    assert [make("learner", f"fixed_{p}").decide(0, None, None) for p in (1, 4, 8, 12)] == [0, 1, 2, 3]
    assert make("learner", "fixed", periods={"avoid": 8}).decide(0, None, None) == 2
    with pytest.raises(ConfigError, match="5 is not one of the periods"):
        make("learner", "fixed", period=5)


@pytest.mark.parametrize(("drawn", "action"), [(0.0, 0), (0.24, 0), (0.25, 1), (0.74, 2), (0.75, 3), (0.99, 3)])
def test_a_random_period_is_uniform(drawn, action):
    """A quarter of [0, 1) for each of the four."""
    assert make("learner", "random").decide(0, None, Draws(drawn)) == action
    assert make("learner", "fixed", period=-1).decide(0, None, Draws(drawn)) == action


def test_tables_begin_at_zero_for_every_state():
    """Three levels, four periods, six percepts; a state is (level * 4 + period) * 6 + percept."""
    made = make("learner", "q_learning")
    assert made.context.states == 72 and made.q == [[0.0] * 4] * 72 and made.visits == [[0] * 4] * 72
