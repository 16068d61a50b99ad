"""What is left in a source, by hand."""

import pytest

from attnlab.needs.base import Larder
from attnlab.testing.build import reading

KINDS = ("obstacle", "food", "water", "food", "food")


def larder(supply, **settings):
    return Larder(reading(food_supply=supply, **settings))


def left(of, cycle):
    """Which sources have something."""
    return [solid for solid in range(len(KINDS)) if of.has(solid, cycle)]


def test_an_endless_source_counts_nothing():
    of = larder("endless")
    for _ in range(9):
        of.take(7, 5)
    assert of.has(7, 5) and of.eaten == [0]


def test_a_source_fills_again_when_its_time_is_over():
    """Two portions each, ten cycles: empty from the second meal at cycle 6 until cycle 15, there again at 16."""
    of = larder("respawn", food_portions=2, food_respawn_cycles=10)
    of.take(3, 5)
    assert of.has(3, 5) and of.has(4, 5) and of.eaten == [0, 0, 0, 1]
    of.take(3, 6)
    assert [of.has(3, cycle) for cycle in (6, 15, 16)] == [False, False, True]
    of.take(3, 16)
    assert of.has(3, 16) and of.eaten[3] == 3
    of.start()
    assert of.eaten == [0, 0, 0, 0] and of.has(3, 0)


def test_sources_wander_from_place_to_place_of_their_kind():
    """Food is at solid 1 first, then at 3, then at 4, then at 1 again; a source alone of its kind stays."""
    of = larder("wandering", food_portions=1)
    of.wander(KINDS)
    last = of.reading.max_cycles
    assert of.following == [0, 3, 2, 4, 1] and left(of, 0) == left(of, last) == [0, 1, 2]
    for solid, there in ((1, 3), (3, 4), (4, 1)):
        of.take(solid, 10 * solid)
        assert left(of, 10 * solid) == left(of, last) == [0, *sorted((2, there))]
    of.take(2, 60)
    assert of.has(2, 60)
    of.start()
    assert left(of, 0) == [0, 1, 2]


@pytest.mark.parametrize("supply", ["endless", "respawn"])
def test_others_do_not_wander(supply):
    of = larder(supply)
    of.wander(KINDS)
    assert of.following == [] and left(of, 0) == [0, 1, 2, 3, 4]


def test_a_source_that_depletes_is_empty_for_the_episode():
    of = larder("depletion", food_portions=3)
    of.reserve(len(KINDS))
    for cycle in range(3):
        assert of.has(1, cycle)
        of.take(1, cycle)
    assert left(of, 2) == left(of, of.reading.max_cycles) == [0, 2, 3, 4]
    of.start()
    assert of.has(1, 0) and of.eaten == [0] * len(KINDS)
