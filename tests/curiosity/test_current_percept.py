"""Eq 12 with the current percept among the NV_tot observations (``novelty_counts_current``), and without it."""

from __future__ import annotations

from types import SimpleNamespace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from attnlab.testing import make


def likings(percepts, window, current, name="litman"):
    model = make("curiosity", name, how={"novelty_window": window, "novelty_counts_current": current})
    memory, found = model.memory(), []
    for percept in percepts:
        found.append(model.liking(memory, percept))
        model.observe(memory, percept)
    return found


def test_counted_by_hand():
    """Three observations. The first view is one of them: 1 - 1/3. The fourth 1 pushes a 1 out: still three, not four.
    The 2 pushes out a 1, so that one 2 is left; then 1 comes back as the second of (1, 2, 1)."""
    assert likings([1, 1, 1, 1, 2, 1], 3, True) == pytest.approx([2 / 3, 1 / 3, 0.0, 0.0, 2 / 3, 1 / 3])


def test_not_counted_by_hand():
    assert likings([1, 1, 1, 1, 2, 1], 3, False) == pytest.approx([1.0, 2 / 3, 1 / 3, 0.0, 1.0, 1 / 3])


def test_what_is_pushed_out_matters_only_if_it_is_the_same():
    """After 2, 1, 1 the window becomes 1, 1, 1: three of three. After 1, 2, 2 it becomes 2, 2, 1: one of three."""
    assert likings([2, 1, 1, 1], 3, True)[-1] == 0.0
    assert likings([1, 2, 2, 1], 3, True)[-1] == pytest.approx(2 / 3)


def test_a_window_of_one_is_the_current_percept_alone():
    assert likings([0, 0, 1, 0], 1, True) == [0.0, 0.0, 0.0, 0.0]
    assert likings([0, 0, 1, 0], 1, False) == [1.0, 0.0, 1.0, 1.0]


@given(st.lists(st.integers(0, 2), max_size=30), st.integers(1, 8), st.sampled_from(["litman", "none"]))
@settings(max_examples=80, deadline=None)
def test_it_is_the_share_in_the_last_observations(percepts, window, name):
    """Literally: the share of the others among the last NV_tot, this one the last of them or the next to come."""
    for current in (True, False):
        found = likings(percepts, window, current, name)
        for i, percept in enumerate(percepts):
            end = i + 1 if current else i
            seen = percepts[max(0, end - window):end].count(percept)
            assert found[i] == pytest.approx(1.0 - seen / window)
            assert 0.0 <= found[i] <= 1.0


@pytest.mark.parametrize(("name", "how", "expected"), [
    ("litman", {}, [1.0, 0.75, 0.5, 0.25]),
    ("litman", {"novelty_over": "state"}, [1.0, 1.0, 0.75, 0.75]),  # the percept with w > 0 and with w = 0 are two
    ("none", {"novelty_over": "state", "non_curious": "same_states"}, [1.0, 1.0, 0.75, 0.75]),
    ("none", {"novelty_over": "state"}, [1.0, 0.75, 0.5, 0.25])])  # who knows no curiosity has w = 0
def test_states_counted_by_hand(name, how, expected):
    """One percept four times, with energy above E_well (3067) and below in turn, in a window of four."""
    model = make("curiosity", name, how={"novelty_window": 4, **how})
    memory, found = model.memory(), []
    for energy in (4000.0, 3000.0, 4000.0, 3000.0):
        model.attach(SimpleNamespace(body=SimpleNamespace(energy=energy)))
        found.append(model.liking(memory, 5))
        model.observe(memory, 5)
    assert found == expected


def test_where_a_state_is_counted():
    """With w > 0 a percept is counted after all those with w = 0, and energy at E_well is no wanting. There is a place
    for each and for no more."""
    model = make("curiosity", "litman", how={"novelty_over": "state"})
    memory, bins = model.memory(), model.bins
    well = model.reading.energy_well
    for energy, place in ((well + 500.0, 5 + bins), (well, 5), (well - 500.0, 5)):
        model.attach(SimpleNamespace(body=SimpleNamespace(energy=energy)))
        assert model.place(memory, 5) == place
    assert len(memory.visits) == 2 * bins and len(make("curiosity", "litman").memory().visits) == bins
