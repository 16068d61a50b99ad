"""Equations (1)-(13) against values computed by hand."""

from __future__ import annotations

from math import exp

import pytest
from hypothesis import given
from hypothesis import strategies as st

from attnlab import equations as eq


def test_clock_period_changes_only_when_it_fires():
    assert eq.clock_period(True, 8, 4) == 8
    assert eq.clock_period(False, 8, 4) == 4


def test_q_update():
    # 0.2 * 2 + 0.8 * (1 + 0.9 * 3) = 0.4 + 0.8 * 3.7
    assert eq.q_update(2.0, 1.0, 3.0, alpha=0.8, gamma=0.9) == pytest.approx(3.36)


def test_one_penalty_from_zero_is_minus_1200():
    assert eq.q_update(0.0, -1500.0, 0.0, alpha=0.8, gamma=0.9) == pytest.approx(-1200.0)


def test_softmax():
    p = eq.softmax([0.0, 1.0], tau=1.0)
    assert p == pytest.approx([1 / (1 + exp(1)), exp(1) / (1 + exp(1))])
    assert eq.softmax([0.0, 2.0], tau=2.0) == pytest.approx(p)


def test_softmax_survives_penalties():
    p = eq.softmax([-1200.0, -1198.0, 5.0, 5.0], tau=1.0)
    assert p == pytest.approx([0, 0, 0.5, 0.5])
    assert eq.softmax([-1200.0] * 4, tau=0.01) == pytest.approx([0.25] * 4)


@given(st.lists(st.floats(-2000, 2000), min_size=1, max_size=8), st.floats(0.01, 100))
def test_softmax_is_a_distribution_that_keeps_the_order(values, tau):
    p = eq.softmax(values, tau)
    assert sum(p) == pytest.approx(1)
    assert all(0 <= x <= 1 for x in p)
    for i, a in enumerate(values):
        for j, b in enumerate(values):
            if a > b:
                assert p[i] >= p[j]


def test_mixed_reward():
    assert eq.mixed_reward(0.4, 0.9, wanting=0.0) == 0.4
    assert eq.mixed_reward(0.4, 0.9, wanting=1.0) == 0.9
    assert eq.mixed_reward(0.4, 0.9, wanting=0.25) == pytest.approx(0.525)


def test_needs_and_energy():
    assert eq.need_after_cycle(300.0, k=1.0, nb_act=3, consumed=0.0) == 303.0
    assert eq.need_after_cycle(400.0, k=2.0, nb_act=1, consumed=150.0) == 252.0
    assert eq.energy_after_cycle(4600.0, e_u=1.0, e_nb=1.0, nb_act=2, consumed=150.0) == 4747.0


@given(st.integers(0, 4600), st.integers(0, 1500), st.integers(0, 1500), st.integers(0, 3), st.booleans(),
       st.booleans(), st.sampled_from([1.0, 2.0, 3.0]))
def test_energy_and_needs_together(energy, hunger, thirst, active, food, water, k):
    """Whatever is eaten, E + H + T changes by -e_u + (2k - e_nb) * nb_act."""
    eaten, drunk = 150.0 * food, 150.0 * water
    after = (eq.energy_after_cycle(energy, 1.0, 1.0, active, eaten + drunk)
             + eq.need_after_cycle(hunger, k, active, eaten) + eq.need_after_cycle(thirst, k, active, drunk))
    assert after - (energy + hunger + thirst) == pytest.approx(-1.0 + (2 * k - 1.0) * active)


def test_extrinsic_rewards():
    assert eq.period_term(1, 1, 12) == 0.0
    assert eq.period_term(12, 1, 12) == 1.0
    assert eq.period_term(4, 1, 12) == pytest.approx(3 / 11)
    assert eq.avoid_reward(1.0, 1.0, 0.0, 1.0) == 1.0
    assert eq.avoid_reward(3 / 11, 0.7, 0.4, 1.0) == pytest.approx(0.5 * (3 / 11 + 0.5))
    assert eq.need_reward(1.0, 300.0, 1500.0) == pytest.approx(0.9)
    assert eq.need_reward(0.0, 1500.0, 1500.0) == 0.0


def test_wanting():
    assert eq.wanting(3066.9, 3067.0, 4600.0) == 0.0
    assert eq.wanting(3067.0, 3067.0, 4600.0) == 0.0
    assert eq.wanting(4600.0, 3067.0, 4600.0) == 1.0
    assert eq.wanting(5000.0, 4000.0, 6000.0) == 0.5
    assert eq.wanting(4750.0, 3067.0, 4600.0) == 1.0  # a meal at the start: above E_max


def test_liking():
    assert eq.liking(0, 10) == 1.0
    assert eq.liking(10, 10) == 0.0
    assert eq.liking(3, 10) == pytest.approx(0.7)


def test_safety():
    assert eq.safety(1.0, 1.0, 1, 1, 12) == 1.0
    assert eq.safety(1.0, 1.0, 12, 1, 12) == 0.0
    assert eq.safety(0.5, 1.0, 4, 1, 12) == pytest.approx(0.5 * 8 / 11)


def test_percept_bins():
    assert [eq.percept_bin(s, 0.0, 1500.0, 6) for s in (0, 249.9, 250, 1499.9, 1500, 2000)] == [0, 0, 1, 5, 5, 5]
    assert eq.percept_bin(-1.0, 0.0, 1.0, 6) == 0
    assert eq.percept_bin(300.0, 300.0, 1500.0, 6) == 0
