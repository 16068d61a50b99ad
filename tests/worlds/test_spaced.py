"""The paper's arena with its sources apart as asked, and its obstacles."""

from __future__ import annotations

from itertools import combinations, product
from math import hypot

import pytest

from attnlab import registry
from attnlab.errors import ConfigError
from attnlab.testing.build import node
from attnlab.worlds.geometry import overlap
from attnlab.worlds.random import solvable
from attnlab.worlds.spaced import water_m


def build(name="spaced", **changes):
    return registry.make("world", node("world", name, **changes), None).build(0)


def test_by_default_it_is_the_papers_world():
    assert build().solids == build("paper").solids
    assert build() == build("paper")


@pytest.mark.parametrize(("distance", "place"), [
    (1.0, (0.25, 2.0)), (2.75, (0.25, 3.75)),  # up the west wall, to its corner
    (3.25, (1.98, 3.75)),  # sqrt(3.25^2 - 2.75^2) = 1.732
    (3.5, (3.75, 1.0)), (4.03, (3.75, 3.0)),  # straight across; the paper's
    (4.45, (3.75, 3.75))])
def test_where_the_water_is(distance, place):
    assert water_m(distance) == pytest.approx(place, abs=1e-12)


@pytest.mark.parametrize(("distance", "obstacles"), [*product((0.7, 1.0, 1.75, 2.5, 3.25, 3.5, 4.03, 4.45),
                                                                 range(5))])
def test_every_world_is_sound(distance, obstacles):
    layout = build(source_distance_m=distance, obstacles=obstacles)
    boxes = layout.solids[4:]
    assert [solid.kind for solid in boxes] == ["obstacle"] * obstacles + ["food", "water"]
    assert not any(overlap(one, two) for one, two in combinations(boxes, 2))
    assert all(-1e-9 <= value <= 4.0 + 1e-9 for solid in boxes for corner in solid.corners() for value in corner)
    food, water = boxes[-2:]
    assert hypot(food.x_m - water.x_m, food.y_m - water.y_m) == pytest.approx(distance, abs=0.008)
    assert solvable(layout)


@pytest.mark.parametrize(("setting", "value", "said"), [
    ("obstacles", 5, "must be at most 4"), ("source_distance_m", 0.4, "must be at least 0.7 m"),
    ("source_distance_m", 4.6, "must be at most 4.45 m")])
def test_what_cannot_be(setting, value, said):
    with pytest.raises(ConfigError, match=said):
        build(**{setting: value})


def test_a_start_that_is_shut_off_is_refused(monkeypatch):
    monkeypatch.setattr("attnlab.worlds.spaced.OBSTACLES_M", ((0.95, 1.0), (0.25, 1.7), (0.25, 0.3)))
    with pytest.raises(ConfigError, match="shut off"):
        build(obstacles=3)
