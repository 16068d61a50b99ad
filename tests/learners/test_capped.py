"""A budget of looks: by hand, and over whole episodes."""

import pytest

from attnlab.errors import ConfigError
from attnlab.reading import Reading
from attnlab.testing import make, run

PERIODS = [1, 4, 8, 12]


def grants(learner, times):
    """The periods granted one after the other at the same percept."""
    learner.start()
    found, action = [], 0
    for _ in range(times):
        action = learner.decide(action * 6, None, None)
        found.append(PERIODS[action])
    return found


def capped(per_cycle, of="always_on"):
    return make("learner", "capped", of=of, looks_per_s=per_cycle / Reading().dt_s, levels=("none",))


@pytest.mark.parametrize(("per_cycle", "periods"), [
    (1.0, [1, 1, 1, 1]),  # as often as it wants
    (0.25, [4, 4, 4, 4]),  # the first look is free, the k-th after it not before cycle 4 k
    (0.5, [4, 1, 1, 4, 1, 1]),  # what was not used is kept: 1 of 2, 2 of 2.5, 3 of 3; the fourth waits for cycle 8
    (0.1, [12, 8, 12, 8]), (0.01, [12, 12, 12])])
def test_by_hand(per_cycle, periods):
    assert grants(capped(per_cycle), len(periods)) == periods


def test_a_longer_period_that_is_wanted_is_granted():
    assert grants(capped(0.5, "fixed_12"), 3) == [12, 12, 12]
    assert grants(capped(1.0, {"name": "fixed", "period": 8}), 2) == [8, 8]


def test_the_other_learns_what_was_granted():
    made = make("learner", "capped", of={"name": "q_learning", "alpha": 1.0}, levels=("none",))
    made.update(0, 2, 3.0, 5, -1, 8)
    made.terminal(1, 3, -4.0)
    assert made.q[0][2] == made.inner.q[0][2] == 3.0 and made.values(1) == [0.0, 0.0, 0.0, -4.0]
    assert made.visits[0] == [0, 0, 1, 0] and made.learns and not made.on_policy
    assert make("learner", "capped", of="sarsa").on_policy and not make("learner", "capped", of="random").learns


@pytest.mark.parametrize("looks_per_s", [2.0, 4.0, 8.0])
def test_a_robot_keeps_to_its_budget_and_shares_it(looks_per_s):
    """Three behaviours that would look in every cycle (19 a second): no episode has more than the cap, but for the
    three that are free and three that were granted together, and it is used."""
    tables = run(learner={"name": "capped", "of": "always_on", "looks_per_s": looks_per_s}, curiosity="none",
                 max_cycles=600)
    episodes, behaviours = tables["episodes"], tables["behaviours"]
    for episode, cycles, phase in zip(episodes["episode"], episodes["cycles"], episodes["phase"], strict=True):
        looks = sum(n for n, e, p in zip(behaviours["activations"], behaviours["episode"], behaviours["phase"],
                                         strict=True) if (e, p) == (episode, phase))
        budget = looks_per_s * cycles * Reading().dt_s
        assert 0.8 * budget - 3 <= looks <= budget + 6


def test_a_wide_budget_changes_nothing():
    def numbers(learner):
        tables = run(learner=learner, curiosity="none")
        return tables["episodes"], tables["policy"], tables["behaviours"]
    assert repr(numbers({"name": "capped", "looks_per_s": 1000.0})) == repr(numbers("q_learning"))


@pytest.mark.parametrize(("of", "match"), [("capped", "cannot be capped"), ("evolution", "cannot be capped"),
                                           ("q_lerning", "Did you mean 'q_learning'"), ({}, "no learner is called"),
                                           ({"name": "q_learning", "alpah": 1}, "learner.of.alpah: no such setting")])
def test_what_cannot_be_capped(of, match):
    with pytest.raises(ConfigError, match=match):
        make("learner", "capped", of=of)
