"""WANDER by hand: a direction for 60 cycles, 0.6 rad/s at most; sigma is the free way ahead, 2 m at most."""

from __future__ import annotations

from math import pi

import pytest

from attnlab.testing import make
from tests.behaviours.senses import Draws, Told, echoes


def wander(*directions, **params):
    behaviour = make("behaviours", "wander", **params)
    behaviour.draw = Draws(*directions)
    behaviour.start()
    return behaviour


@pytest.mark.parametrize(("direction", "heading", "turn"), [
    (0.5, 0.0, 0.5), (-0.5, 0.0, -0.5), (0.2, 0.3, -0.1), (2.0, 0.0, 0.6), (-2.0, 0.0, -0.6),
    (-3.0, 3.0, 2 * pi - 6.0), (3.0, -3.0, 6.0 - 2 * pi)])  # the shorter way round
def test_it_turns_towards_its_direction(direction, heading, turn):
    behaviour = wander(direction)
    assert behaviour.command(Told(heading=heading), 0.0) == (0.4, pytest.approx(turn))
    assert behaviour.draw.asked == [(-pi, pi)]


def test_another_direction_after_60_cycles():
    behaviour = wander(0.1, 0.2, 0.3)
    turns = [behaviour.command(Told(cycle=cycle), 0.0)[1] for cycle in (5, 64, 65, 124, 125)]
    assert turns == pytest.approx([0.1, 0.1, 0.2, 0.2, 0.3])


def test_an_episode_begins_with_another_direction():
    behaviour = wander(0.1, 0.2)
    assert behaviour.command(Told(), 0.0)[1] == pytest.approx(0.1)
    behaviour.start()
    assert behaviour.command(Told(), 0.0)[1] == pytest.approx(0.2)


@pytest.mark.parametrize("sonar", range(8))
def test_percept_is_the_free_way_ahead(sonar):
    """The four foremost, at 30 and 10 degrees on either side."""
    ahead = 2 <= sonar <= 5
    assert (wander().sigma_low, wander().sigma_high) == (0.0, 2.0)
    assert wander().percept(Told(echoes(**{f"s{sonar}": 0.7}))) == (0.7 if ahead else 2.0)


def test_reward_has_the_form_of_eq_7_over_two_metres():
    assert wander().reward(0.5, 3 / 11) == pytest.approx(0.5 * (3 / 11 + 0.25))
    assert wander().reward(2.0, 1.0) == 1.0 and wander().reward(0.0, 0.0) == 0.0
