"""Where a robot may start, by hand: the grid of 0.05 m, drawn poses, the steady one, the walls."""

from __future__ import annotations

from math import pi

import pytest

from attnlab.errors import ConfigError
from attnlab.worlds.base import Layout, Solid, check_start, outer_walls

CUBE = Solid("obstacle", 1.0, 1.0, 0.5, 0.5)


def world(start, *solids, clearance=0.25, fixed=None):
    return Layout(4.0, 3.0, solids, start, clearance, fixed)


def test_the_grid_over_a_start_region():
    """0.1 m by 0.05 m: three by two points, both ends among them."""
    points = list(world((1.0, 1.1, 2.0, 2.05)).free_points())
    assert points == [pytest.approx(p) for p in ((1.0, 2.0), (1.0, 2.05), (1.05, 2.0), (1.05, 2.05), (1.1, 2.0),
                                                 (1.1, 2.05))]


def test_a_region_of_no_area_is_its_ends():
    assert set(world((1.0, 1.0, 2.0, 2.0)).free_points()) == {(1.0, 2.0)}
    assert set(world((1.0, 1.02, 2.0, 2.0)).free_points()) == {(1.0, 2.0), (1.02, 2.0)}


def test_points_near_a_solid_are_not_free():
    """The cube ends at x = 1.25, so that x = 1.5 is exactly clear of it by 0.25 m."""
    free = set(world((1.25, 1.75, 1.0, 1.0), CUBE).free_points())
    assert min(free)[0] == pytest.approx(1.5) and (1.75, 1.0) in free
    assert (1.5, 1.0) in set(world((1.5, 1.5, 1.0, 1.0), CUBE).free_points())


class Dice:
    """Draws the numbers of a list in turn, and the last of them for ever; picks the last choice."""
    def __init__(self, *numbers): self.numbers, self.asked, self.choices = list(numbers), [], None

    def uniform(self, low, high):
        self.asked.append((low, high))
        return self.numbers.pop(0) if len(self.numbers) > 1 else self.numbers[0]

    def choice(self, choices):
        self.choices = choices
        return choices[-1]


def test_a_pose_is_drawn_until_it_is_free():
    """(1, 1) is in the cube, (1.5, 1) just clear of it."""
    dice = Dice(1.0, 1.0, 1.5, 1.0, -0.5)
    assert world((0.5, 3.5, 0.75, 2.5), CUBE).random_start(dice) == (1.5, 1.0, -0.5)
    assert dice.asked == [(0.5, 3.5), (0.75, 2.5)] * 2 + [(-pi, pi)]


def test_after_a_thousand_misses_a_point_of_the_grid():
    dice = Dice(1.0)
    assert world((1.5, 1.55, 1.0, 1.0), CUBE).random_start(dice) == (pytest.approx(1.55), 1.0, 1.0)
    assert len(dice.asked) == 2 * 1000 + 1
    assert {round(x, 9) for x, _ in dice.choices} == {1.5, 1.55}


def test_the_steady_start_is_nearest_to_the_middle_of_its_region():
    """Of 2 m by 1 m from (1, 1.5): (2, 2). A cube there leaves the nearest point beside it; of equals, the least."""
    region = (1.0, 3.0, 1.5, 2.5)
    assert world(region).steady_start == pytest.approx((2.0, 2.0, 0.0))
    assert world((0.0, 0.2, 0.0, 1.0)).steady_start == pytest.approx((0.1, 0.5, 0.0))
    wide = Solid("obstacle", 2.0, 1.9, 1.0, 0.1)  # ends at y = 1.95: free from 2.2 on
    assert world(region, wide).steady_start == pytest.approx((2.0, 2.2, 0.0))
    tall = Solid("obstacle", 1.9, 2.0, 0.1, 1.0)  # ends at x = 1.95: free from 2.2 on
    assert world(region, tall).steady_start == pytest.approx((2.2, 2.0, 0.0))
    both = Solid("obstacle", 2.0, 2.0, 0.5, 3.0)  # 1.5 and 2.5 are as near
    assert world(region, both).steady_start == pytest.approx((1.5, 2.0, 0.0))
    assert world(region, fixed=(1.0, 2.0, 0.5)).steady_start == (1.0, 2.0, 0.5)


def test_walls_stand_around_the_floor():
    """0.1 m thick: inner faces at 0 and 4, 0 and 3; the long ones close the corners."""
    below, above, left, right = [(w.x_m, w.y_m, w.length_m, w.width_m) for w in outer_walls(4.0, 3.0)]
    assert below == pytest.approx((2.0, -0.05, 4.2, 0.1)) and above == pytest.approx((2.0, 3.05, 4.2, 0.1))
    assert left == pytest.approx((-0.05, 1.5, 0.1, 3.0)) and right == pytest.approx((4.05, 1.5, 0.1, 3.0))
    assert {wall.kind for wall in outer_walls(4.0, 3.0)} == {"wall"}


def test_a_world_without_a_free_start_is_refused():
    with pytest.raises(ConfigError, match="no free start"):
        check_start(world((0.9, 1.1, 0.9, 1.1), CUBE))
    with pytest.raises(ConfigError, match="fixed_start"):
        check_start(world((2.0, 3.0, 2.0, 2.5), CUBE, fixed=(1.49, 1.0, 0.0)))
    clear = world((2.0, 3.0, 2.0, 2.5), CUBE, fixed=(1.5, 1.0, 0.0))
    assert check_start(clear) is clear


def test_a_drawn_start_is_free_in_its_region():
    from random import Random
    layout, draw = world((0.5, 1.5, 0.5, 1.5), CUBE), Random(1)
    for x, y, heading in (layout.random_start(draw) for _ in range(200)):
        assert 0.5 <= x <= 1.5 and 0.5 <= y <= 1.5 and -pi <= heading <= pi
        assert max(abs(x - 1.0), abs(y - 1.0)) >= 0.25
