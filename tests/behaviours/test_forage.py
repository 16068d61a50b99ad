"""EAT and DRINK by hand. By default a meal of 150 UoE is had within 0.75 m, every 25 cycles; they slow down from 1.0 m
to rest at 0.6 m, turn by twice the bearing, and search for 40 cycles in a direction at 0.6 rad/s at most."""

from __future__ import annotations

from math import pi
from types import SimpleNamespace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from attnlab.testing import make
from tests.behaviours.senses import Draws, Told


def blob(distance, bearing=0.0, height=50, solid=6):
    return SimpleNamespace(distance_m=distance, bearing_rad=bearing, height_px=height, solid=solid)


def command(*seen, cycle=1, **params):
    return make("behaviours", "eat", **params).command(Told(seen=seen, cycle=cycle), 0.0)


@pytest.mark.parametrize(("distance", "speed"), [
    (0.3, 0.0), (0.6, 0.0), (0.7, 0.1), (0.8, 0.2), (0.9, 0.3), (1.0, 0.4), (3.0, 0.4)])
def test_it_slows_down_to_rest_within_reach(distance, speed):
    assert command(blob(distance))[0] == pytest.approx(speed)


def test_its_own_distances_and_gain():
    v, w = command(blob(1.5, -0.2), slow_m=2.5, rest_m=0.5, turn_gain=3.0, how={"v_max_m_s": 0.8})
    assert (v, w) == (pytest.approx(0.4), pytest.approx(-0.6))


def test_it_heads_for_the_tallest_blob():
    assert command(blob(2.0, 0.1, 20), blob(1.0, -0.3, 40), blob(3.0, 0.2, 10)) == (0.4, pytest.approx(-0.6))
    assert command(blob(2.0, 0.1, 20), blob(2.0, -0.3, 20)) == (0.4, pytest.approx(0.2))  # the first of equals


def meals(forage, *visits):
    """What is eaten at each (cycle, distance of the source)."""
    eaten = []
    for cycle, distance in visits:
        now = Told(seen=[blob(distance)], cycle=cycle)
        forage.command(now, 0.0)
        eaten.append(len(now.ate) // 2)
    return eaten


@pytest.mark.parametrize(("name", "need"), [("eat", "hunger"), ("drink", "thirst")])
def test_a_meal(name, need):
    now = Told(seen=[blob(0.7, solid=9)], cycle=13)
    make("behaviours", name, power=120.0).command(now, 0.0)
    assert now.ate == [(need, 120.0), (9, 13)]


def test_a_meal_is_within_reach():
    eat = make("behaviours", "eat", how={"food_reach_m": 0.75})
    assert meals(eat, (0, 0.75), (1, 0.76), (2, 0.749)) == [0, 0, 1]


def test_a_meal_every_25_cycles():
    eat = make("behaviours", "eat")
    assert meals(eat, (0, 0.7), (1, 0.7), (24, 0.7), (25, 0.7), (49, 0.7), (50, 0.7), (80, 0.7)) \
        == [1, 0, 0, 1, 0, 1, 1]
    eat.start()
    assert meals(eat, (0, 0.7)) == [1]  # a new episode
    assert meals(make("behaviours", "eat", how={"meal_interval_cycles": 3}), (7, 0.7), (9, 0.7), (10, 0.7)) == [1, 0, 1]


def test_out_of_reach_no_meal_is_used_up():
    assert meals(make("behaviours", "eat"), (10, 2.0), (11, 0.7)) == [0, 1]


def search(directions, *moments, **params):
    """(commands at each (cycle, heading), the stream) when nothing is seen."""
    eat = make("behaviours", "eat", **params)
    eat.draw = Draws(*directions)
    return [eat.command(Told(cycle=cycle, heading=heading), 0.0) for cycle, heading in moments], eat.draw


@pytest.mark.parametrize(("direction", "heading", "turn"), [
    (0.5, 0.0, 0.5), (-0.5, 0.0, -0.5), (0.2, 0.3, -0.1), (2.0, 0.0, 0.6), (-2.0, 0.0, -0.6), (1.0, 1.0, 0.0),
    (-3.0, 3.0, 2 * pi - 6.0), (3.0, -3.0, 6.0 - 2 * pi)])  # the shorter way round
def test_searching_it_turns_towards_its_direction(direction, heading, turn):
    (found,), stream = search([direction], (0, heading))
    assert found == (0.4, pytest.approx(turn))
    assert stream.asked == [(-pi, pi)]


@given(st.floats(-pi, pi), st.floats(-50.0, 50.0))
@settings(max_examples=100, deadline=None)
def test_it_never_turns_the_longer_way_round(direction, heading):
    ((_, turn),), _ = search([direction], (0, heading), search_turn_rad_s=10.0)
    assert abs(turn) <= pi + 1e-9
    whole = (heading + turn - direction) / (2 * pi)
    assert whole == pytest.approx(round(whole), abs=1e-9)


def test_another_direction_after_40_cycles():
    found, _ = search([0.1, 0.2, 0.3], (3, 0.0), (42, 0.0), (43, 0.0), (82, 0.0), (83, 0.0))
    assert [w for _, w in found] == pytest.approx([0.1, 0.1, 0.2, 0.2, 0.3])


def test_a_source_that_was_lost_begins_another_search():
    eat = make("behaviours", "eat")
    eat.draw = Draws(0.1, 0.2, 0.3)
    assert eat.command(Told(cycle=0), 0.0)[1] == pytest.approx(0.1)
    eat.command(Told(cycle=1, seen=[blob(2.0)]), 0.0)
    assert eat.command(Told(cycle=2), 0.0)[1] == pytest.approx(0.2)
    eat.start()
    assert eat.command(Told(cycle=0), 0.0)[1] == pytest.approx(0.3)


def test_percept_and_release():
    eat, cut = make("behaviours", "eat"), make("behaviours", "eat", how={"percept_domain": "min_to_max"})
    assert (eat.sigma_low, eat.sigma_high, cut.sigma_low, cut.sigma_high) == (0.0, 1500.0, 300.0, 1500.0)
    for hunger, sigma, within, released in ((-20.0, 0.0, 300.0, False), (299.9, 299.9, 300.0, False),
                                            (300.0, 300.0, 300.0, True), (1600.0, 1500.0, 1500.0, True)):
        now = Told(hunger=hunger)
        assert (eat.percept(now), cut.percept(now), eat.released(now, 0.0)) == (sigma, within, released)


def test_reward_is_eqs_8_and_9():
    """Both halves of it: the longest period at no need, and a fifth of the need."""
    for name in ("eat", "drink"):
        assert make("behaviours", name).reward(0.0, 1.0) == 1.0
        assert make("behaviours", name).reward(300.0, 3 / 11) == pytest.approx(0.5 * (3 / 11 + 0.8))
