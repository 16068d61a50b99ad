"""Equations where a domain does not begin at 0 or end at 1, by hand."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from attnlab import equations as eq


def test_safety_is_relative_to_sigma_max():
    """Half of 2 m at 4 of 1 to 12 cycles: 0.5 * 8 / 11; periods from 2 to 6: 0.5 * 3 / 4."""
    assert eq.safety(1.0, 2.0, 4, 1, 12) == pytest.approx(0.5 * 8 / 11)
    assert eq.safety(1.0, 2.0, 3, 2, 6) == pytest.approx(0.375)


def test_rewards_are_relative_to_their_domains():
    assert eq.avoid_reward(0.0, 1.0, 0.5, 2.5) == pytest.approx(0.5 * 0.25)
    assert eq.need_reward(0.0, 3.0, 4.0) == pytest.approx(0.5 * 0.25)
    assert eq.period_term(4, 2, 10) == 0.25


def test_percepts_of_a_domain_that_begins_later():
    """[300, 1500] in six: 200 each."""
    assert [eq.percept_bin(s, 300.0, 1500.0, 6) for s in (0, 300, 499.9, 500, 899, 901, 1300, 1499, 1500, 9999)] \
        == [0, 0, 0, 1, 2, 3, 5, 5, 5, 5]


@given(st.floats(-2.0, 2.0), st.floats(0.5, 4.0), st.integers(1, 12), st.floats(0.0, 1.0), st.floats(0.0, 1.0))
@settings(max_examples=100, deadline=None)
def test_percepts_are_equal_parts_in_order(low, width, bins, one, two):
    first, second = sorted((one, two))
    lower, upper = (eq.percept_bin(low + x * width, low, low + width, bins) for x in (first, second))
    assert 0 <= lower <= upper <= bins - 1
    assert abs(lower + 0.5 - first * bins) <= 0.5 + 1e-6


def test_wanting_between_well_and_most():
    assert eq.wanting(4500.0, 4000.0, 6000.0) == 0.25
    assert eq.wanting(3999.0, 4000.0, 6000.0) == 0.0
