"""The clock, the order of learning, who is penalised: on a robot whose senses are scripted."""

from __future__ import annotations

from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from attnlab.attention import Activation, Attention, Log
from attnlab.curiosity.base import CuriosityContext
from attnlab.curiosity.litman import Litman
from attnlab.curiosity.none import NoCuriosity
from attnlab.exploration.greedy import Greedy
from attnlab.learners.base import LearnerContext
from attnlab.learners.q_learning import QLearning, TabularParams
from attnlab.reading import Reading
from attnlab.streams import stream

PERIODS = (1, 4, 8, 12)


class Scripted:
    """A behaviour that perceives what it is told; reward = sigma."""
    name, sigma_low, sigma_high, charges = "scripted", 0.0, 1.0, ("crash",)

    def __init__(self, sigmas):
        self.sigmas, self.i = list(sigmas), -1

    def start(self): self.i = -1
    def needs(self): return []

    def percept(self, now):
        self.i += 1
        return self.sigmas[self.i % len(self.sigmas)]

    def released(self, now, sigma): return sigma > 0.5
    def command(self, now, sigma): return 0.1, 0.0
    def reward(self, sigma, period): return 0.5 * (period + sigma)


class Choose:
    """Chooses what it is told."""
    def __init__(self, actions): self.actions, self.i = list(actions), -1

    def choose(self, values, visits, draw):
        self.i += 1
        return self.actions[self.i % len(self.actions)]


def attention(sigmas, curiosity=NoCuriosity, **reading):
    r = Reading(**reading)
    c = curiosity(None, CuriosityContext(r, 6, stream(0, "c")))
    learner = QLearning(TabularParams(), LearnerContext(r, "scripted", c.levels, PERIODS, 6, stream(0, "l")))
    return Attention(Scripted(sigmas), PERIODS, c, learner, r, stream(0, "e"))


def drive(a, exploration, cycles, energy=4600.0, learning=True):
    now = SimpleNamespace(cycle=0, body=SimpleNamespace(energy=energy))
    for now.cycle in range(cycles):
        if a.due == now.cycle:
            a.activate(now, exploration, learning)
    return a


@given(st.lists(st.integers(0, 3), min_size=1, max_size=20), st.integers(1, 200))
@settings(max_examples=60, deadline=None)
def test_the_clock_fires_exactly_when_its_period_is_over(actions, cycles):
    a = drive(attention([0.2, 0.9]), Choose(actions), cycles)
    at = [x.cycle for x in a.log]
    assert at[0] == 0
    assert [late - early for early, late in pairwise(at)] == [x.period for x in a.log][:-1]
    assert a.due >= cycles
    assert sum(x.period for x in a.log) == a.due


def test_the_first_update_by_hand():
    """Chosen 12 (action 3) at percept 0; 12 cycles later sigma is 0.9: R = (1 + 0.9) / 2; state holds period 12."""
    a = drive(attention([0.0, 0.9]), Choose([3]), 13)
    assert a.learner.q[0 * 6 + 0][3] == pytest.approx(0.8 * 0.95)
    assert a.log[1].reward == pytest.approx(0.95)
    assert a.state == 3 * 6 + 5
    assert sum(q != 0 for row in a.learner.q for q in row) == 1


def test_bootstrapping_by_hand():
    a = attention([0.5])
    a.learner.q[1 * 6 + 3] = [0.0, 2.0, 0.0, 0.0]
    drive(a, Choose([1]), 5)  # state (period 1, bin 3), action 4 cycles, then state (period 4, bin 3)
    assert a.learner.q[0 * 6 + 3][1] == pytest.approx(0.8 * (0.5 * (3 / 11 + 0.5) + 0.9 * 2.0))


def test_semi_markov_discount():
    a = attention([0.5], q_update="smdp")
    a.learner.q[1 * 6 + 3] = [0.0, 2.0, 0.0, 0.0]
    drive(a, Choose([1]), 5)
    assert a.learner.q[0 * 6 + 3][1] == pytest.approx(0.8 * (0.5 * (3 / 11 + 0.5) + 0.9**4 * 2.0))


def test_the_period_newly_chosen_may_be_the_one_rewarded():
    a = drive(attention([0.0, 0.9], reward_period="chosen"), Choose([3, 0]), 13)
    assert a.log[1].reward == pytest.approx(0.5 * (0.0 + 0.9))


def test_commands_are_held_and_released():
    a = drive(attention([0.9, 0.1]), Choose([1]), 1)
    assert a.command == (0.1, 0.0)
    drive_on = drive(attention([0.9, 0.1]), Choose([1]), 5)
    assert drive_on.command is None
    assert [x.released for x in drive_on.log] == [True, False]


@pytest.mark.parametrize(("active", "expected"), [("fired", [1, 1]), ("released", [1, 0])])
def test_who_counts_as_active(active, expected):
    """Released at 0.9, not at 0.1."""
    a, now = attention([0.9, 0.1], active=active), SimpleNamespace(body=SimpleNamespace(energy=4600.0))
    assert [a.activate(now, Choose([0]), True) for now.cycle in (0, 1)] == expected


def test_what_compiled_code_writes_reads_as_what_was_appended():
    """Two activations, all fields different; of the first nothing was earned. Rows beyond ``rows`` are not of it."""
    looks = Log([Activation(0, 0.5, 3, 2, 4, 0.25, 0.75, True, None, None),
                 Activation(4, 0.125, 1, 0, 8, 0.0, 0.0625, False, 0.375, -0.5)])
    written = Log()
    written.table = np.array([*looks, [99.0] * 10], np.float64)
    written.rows = 2
    assert written.looks() == looks.looks() == tuple(looks)
    assert [type(x) for x in written.looks()[1]] == [int, float, int, int, int, float, float, bool, float, float]
    for one, other in zip(written.columns(), looks.columns(), strict=True):
        assert one.shape == (2,) and np.array_equal(one, other, equal_nan=True)


def test_a_level_is_held_where_nothing_is_learned():
    """Level 0, which has the index of no wanting, where there is wanting; who learns has the level there is."""
    for learning, levels in ((False, {0}), (True, {2})):
        a = attention([0.5], Litman)
        a.clamp = 0
        drive(a, Choose([0]), 3, learning=learning)
        assert {x.level for x in a.log} == levels


def test_penalty_by_share():
    a = drive(attention([0.5]), Choose([3]), 1)
    assert a.died(0.0, True) == 0.0
    assert a.died(1.0, True) == -1500.0
    assert a.learner.q[3][3] == pytest.approx(-1200.0)
    assert drive(attention([0.5]), Choose([3]), 1).died(0.1, False) == -150.0


def test_penalty_inside_the_mix():
    """w at E = 3833.5 is 0.5; liking of a percept never seen before is 1."""
    a = drive(attention([0.5], Litman, penalty_mix="inside"), Choose([3]), 1, energy=3833.5)
    assert a.died(1.0, False) == pytest.approx(0.5 * -1500 + 0.5 * 1.0)


def test_levels_of_curiosity():
    a = drive(attention([0.5], Litman), Choose([0]), 12, energy=4600.0)
    assert [x.level for x in a.log] == [2] * 5 + [1] * 7  # liking 1, .9, .8, .7, .6, then .5 is not above .5
    poor = drive(attention([0.5], Litman), Choose([0]), 3, energy=100.0)
    assert {x.level for x in poor.log} == {0}


def test_reward_mixes_by_wanting():
    a = drive(attention([0.5], Litman), Choose([0]), 2, energy=4600.0)
    assert a.log[1].reward == pytest.approx(0.9)  # w = 1: liking alone, one visit of ten
    assert a.log[1].extrinsic == pytest.approx(0.25)


def test_validation_learns_nothing():
    a = drive(attention([0.5]), Greedy(Greedy.Params()), 20, learning=False)
    assert all(q == 0 for row in a.learner.q for q in row)
