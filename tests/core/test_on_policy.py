"""Who chooses before it learns, what it learns from, and what an activation leaves behind."""

from __future__ import annotations

import pytest

from attnlab.attention import Attention
from attnlab.streams import stream
from attnlab.testing import make
from attnlab.testing.build import reading
from tests.core.test_attention import Choose, Scripted, drive

PERIODS = (1, 4, 8, 12)


class Diary:
    """A learner that only writes down what happens to it; ``choices`` are the actions it takes in turn."""
    def __init__(self, choices, on_policy): self.on_policy, self.choices, self.said = on_policy, list(choices), []
    def start(self): pass

    def decide(self, state, exploration, draw):
        self.said.append(("decide", state))
        return self.choices.pop(0)

    def update(self, *what): self.said.append(("update", *what))
    def terminal(self, *what): self.said.append(("terminal", *what))


def attention(sigmas, learner, curiosity="none", periods=PERIODS, **how):
    if isinstance(learner, str):
        levels = make("curiosity", curiosity, how=how).levels
        learner = make("learner", learner, how=how, levels=levels)
    return Attention(Scripted(sigmas), periods, make("curiosity", curiosity, how=how), learner, reading(**how),
                     stream(0, "e"))


# Percept 0, then percept 3 after 4 cycles (state 1 * 6 + 3), then percept 0 after 8 (state 2 * 6 + 0).
SIGMAS = [0.0, 0.5, 0.0]
REWARDS = 0.5 * (3 / 11 + 0.5), 0.5 * (7 / 11 + 0.0)


def test_off_policy_learns_and_then_chooses():
    diary = Diary([1, 2, 3], on_policy=False)
    drive(attention(SIGMAS, diary), None, 13)
    assert diary.said == [
        ("decide", 0), ("update", 0, 1, pytest.approx(REWARDS[0]), 9, -1, 4),
        ("decide", 9), ("update", 9, 2, pytest.approx(REWARDS[1]), 12, -1, 8), ("decide", 12)]


def test_on_policy_chooses_once_and_then_learns():
    diary = Diary([1, 2, 3], on_policy=True)
    drive(attention(SIGMAS, diary), None, 13)
    assert diary.said == [
        ("decide", 0), ("decide", 9), ("update", 0, 1, pytest.approx(REWARDS[0]), 9, 2, 4),
        ("decide", 12), ("update", 9, 2, pytest.approx(REWARDS[1]), 12, 3, 8)]


def test_the_first_action_may_be_chosen_first():
    """Action 0 is an action: it is not chosen a second time."""
    diary = Diary([0, 0], on_policy=True)
    drive(attention(SIGMAS, diary), None, 2)
    assert diary.said == [("decide", 0), ("decide", 3), ("update", 0, 0, 0.25, 3, 0, 1)]


def test_rewarded_for_the_chosen_period_it_chooses_first_whatever_the_learner():
    """The 12 cycles newly chosen earn a whole period term; none is left out or chosen twice."""
    diary = Diary([1, 3], on_policy=False)
    drive(attention(SIGMAS, diary, reward_period="chosen"), None, 5)
    assert diary.said == [("decide", 0), ("decide", 9), ("update", 0, 1, pytest.approx(0.5 * (1.0 + 0.5)), 9, 3, 4)]


def test_sarsa_learns_from_the_action_it_takes():
    """Q(s,a) = 0.8 (R + 0.9 Q(s',a')): a' is the third action, worth 2, and not the best one, worth 5."""
    for learner, following in (("sarsa", 2.0), ("q_learning", 5.0)):
        a = attention(SIGMAS, learner)
        a.learner.q[9] = [0.0, 5.0, 2.0, 0.0]
        drive(a, Choose([1, 2]), 5)
        assert a.learner.q[0][1] == pytest.approx(0.8 * (REWARDS[0] + 0.9 * following))


def test_the_state_holds_level_period_and_percept():
    """Litman at E = 4600: level 2 (likes what is new) of four periods and six percepts each."""
    diary = Diary([1, 2, 3], on_policy=False)
    drive(attention(SIGMAS, diary, curiosity="litman"), None, 5)
    assert [said[1] for said in diary.said if said[0] == "decide"] == [2 * 24 + 0, 2 * 24 + 6 + 3]


def test_an_episode_begins_at_the_shortest_period_wherever_it_stands():
    """Periods 8, 1, 4: the first state is (1) * 6 + percept, and terms are those of the periods: 1, 0 and 3/7."""
    diary = Diary([2, 0, 1], on_policy=False)
    a = attention([0.0], diary, periods=(8, 1, 4))
    assert (a.due, a.action, a.period, a.command, a.log, a.wanting, a.liking) == (0, 1, 1, None, [], 0.0, 0.0)
    drive(a, None, 13)
    assert diary.said[0] == ("decide", 6)
    assert [said[3] for said in diary.said if said[0] == "update"] == pytest.approx([0.5 * 3 / 7, 0.5 * 1.0])
    a.start()
    assert (a.due, a.action, a.period, a.state, a.log) == (0, 1, 1, -1, [])


def test_with_one_period_its_term_is_none():
    diary = Diary([0, 0], on_policy=False)
    drive(attention([0.5], diary, periods=(4,)), None, 5)
    assert diary.said[1] == ("update", 3, 0, 0.25, 3, -1, 4)


def test_what_an_activation_leaves_behind():
    """w at E = 3833.5 is a half of it; the second view of a percept is liked by 0.9; R mixes 0.5 (3/11 + 0.9)."""
    a = drive(attention([0.9, 0.9], Diary([1, 3], False), curiosity="litman"), None, 5, energy=3833.5)
    first, second = a.log
    assert first == (0, 0.9, 5, 2, 4, pytest.approx(0.5), 1.0, True, None, None)
    earned = 0.5 * (3 / 11 + 0.9)
    assert second == (4, 0.9, 5, 2, 12, pytest.approx(0.5), 0.9, True, pytest.approx(0.5 * earned + 0.45),
                      pytest.approx(earned))
    assert (a.due, a.command, a.wanting, a.liking) == (16, (0.1, 0.0), pytest.approx(0.5), 0.9)


def test_what_is_remembered_outlives_the_episode_only_if_it_persists():
    for persists, liking in ((False, 1.0), (True, 0.9)):
        a = drive(attention([0.5], Diary([3, 3], False), curiosity="litman", novelty_persists=persists), None, 1)
        a.start()
        drive(a, None, 1)
        assert a.log[0].liking == liking


def test_dying():
    """The penalty belongs to the running period, also in state 0; before the first look nobody is to blame."""
    diary = Diary([3], on_policy=False)
    a = attention([0.0], diary)
    assert a.died(1.0, True) == 0.0
    drive(a, None, 1)
    assert (a.died(0.5, True), a.died(0.0, True), a.died(1.0, False)) == (-750.0, 0.0, -1500.0)
    assert diary.said == [("decide", 0), ("terminal", 0, 3, -750.0)]


def test_the_penalty_is_mixed_only_inside():
    """w = 0.5, liking 1: half of it and a half; outside it is the whole."""
    for mix, penalty in (("inside", -749.5), ("outside", -1500.0)):
        a = drive(attention([0.5], Diary([3], False), "litman", penalty_mix=mix), None, 1, energy=3833.5)
        assert a.died(1.0, True) == pytest.approx(penalty)
        assert a.learner.said[-1] == ("terminal", 2 * 24 + 3, 3, pytest.approx(penalty))


def test_nothing_is_learned_in_validation():
    diary = Diary([1, 2, 3], on_policy=True)
    a = drive(attention(SIGMAS, diary), None, 13, learning=False)
    assert [said[0] for said in diary.said] == ["decide"] * 3
    assert a.log[1].reward == pytest.approx(REWARDS[0])
