"""Worlds: what can be, what cannot, and where a robot starts."""

from __future__ import annotations

from math import pi

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from attnlab import registry
from attnlab.errors import ConfigError
from attnlab.streams import stream
from attnlab.testing.build import node
from attnlab.worlds.geometry import Solid, clearance, distance, overlap
from attnlab.worlds.random import ARRIVAL_M, PASSAGE_M, solvable


def build(name: str, seed: int = 0, **changes):
    return registry.make("world", node("world", name, **changes), None).build(seed)


def test_the_papers_world():
    layout = build("paper")
    assert layout.width_m * layout.depth_m == 16.0
    kinds = [solid.kind for solid in layout.solids]
    assert kinds == ["wall"] * 4 + ["obstacle", "obstacle", "food", "water"]
    assert all(s.length_m == s.width_m == s.height_m == 0.5 for s in layout.solids[4:])


@pytest.mark.parametrize("name", ["paper", "open", "cluttered", "random"])
def test_shipped_worlds_are_solvable_and_start_free(name):
    layout = build(name)
    assert solvable(layout)
    draw = stream(0, "test")
    for _ in range(200):
        x, y, heading = layout.random_start(draw)
        assert clearance(x, y, layout.solids) >= layout.start_clearance_m
        assert -pi <= heading <= pi
    x, y, _ = layout.steady_start
    assert clearance(x, y, layout.solids) >= layout.start_clearance_m


@pytest.mark.parametrize("layout", ["paper", "apart", "random"])
@pytest.mark.parametrize("of_each", [1, 2])
def test_places(layout, of_each):
    found = build("places", seed=3, layout=layout, of_each=of_each)
    kinds = [solid.kind for solid in found.solids]
    assert found.width_m * found.depth_m == 16.0 and kinds.count("obstacle") == 2
    assert kinds.count("food") == kinds.count("water") == of_each
    assert solvable(found)
    if layout == "random":
        assert found == build("random", seed=3, food=of_each, water=of_each)
        assert found != build("places", seed=4, layout=layout, of_each=of_each)
    else:
        assert found == build("places", seed=4, layout=layout, of_each=of_each)
        boxes = found.solids[4:]
        one, other = ((b.x_m, b.y_m) for b in boxes if b.kind == "obstacle")
        assert (4.0 - one[0], 4.0 - one[1]) == pytest.approx(other)
        foods, waters = ([(b.x_m, b.y_m) for b in boxes if b.kind == kind] for kind in ("food", "water"))
        assert [(4.0 - x, 4.0 - y) for x, y in foods] == [pytest.approx(at) for at in waters]  # point-symmetric


def test_the_first_place_is_the_papers_world():
    assert build("places") == build("paper")


@given(st.integers(0, 10_000))
@settings(max_examples=25, deadline=None)
def test_random_layouts_are_always_solvable(seed):
    layout = build("random", seed)
    assert solvable(layout)
    boxes = layout.solids[4:]
    assert not any(overlap(a, b) for i, a in enumerate(boxes) for b in boxes[:i])
    assert build("random", seed) == layout
    assert build("random", seed + 1) != layout


def test_a_walled_off_source_is_not_solvable():
    box = {"kind": "food", "x_m": 0.25, "y_m": 0.25}
    wall = {"x1_m": 0.0, "y1_m": 1.0, "x2_m": 1.0, "y2_m": 1.0}
    other = {"x1_m": 1.0, "y1_m": 0.0, "x2_m": 1.0, "y2_m": 1.0}
    assert solvable(build("open", boxes=[box]))
    assert not solvable(build("open", boxes=[box], walls=[wall, other]))
    assert PASSAGE_M < ARRIVAL_M


@pytest.mark.parametrize(("changes", "says"), [
    ({"boxes": [{"kind": "food", "x_m": 3.9, "y_m": 1.0}]}, "outside"),
    ({"boxes": [{"kind": "food", "x_m": 0.25, "y_m": 0.25, "yaw_rad": 0.7}]}, "outside"),
    ({"boxes": [{"x_m": 1.0, "y_m": 1.0}, {"x_m": 1.4, "y_m": 1.4}]}, "overlaps"),
    ({"boxes": [{"x_m": 2.0, "y_m": 2.0}], "start": {"x_min_m": 2, "x_max_m": 2, "y_min_m": 2, "y_max_m": 2}},
     "no free start"),
    ({"start": {"x_max_m": 9.0}}, "not within"),
    ({"start": {"fixed": [0.1, 0.1, 0.0]}}, "nearer than"),
    ({"start": {"fixed": [0.1]}}, "expected"),
    ({"width_m": 0.6}, "outside|no free start|not within"),
    ({"boxes": [{"colour": "red"}]}, "no such setting"),
])
def test_worlds_that_cannot_be(changes, says):
    with pytest.raises(ConfigError, match=says):
        build("paper", **changes)


def test_touching_boxes_do_not_overlap():
    assert not overlap(Solid("a", 1.0, 1.0, 0.5, 0.5), Solid("b", 1.5, 1.0, 0.5, 0.5))
    assert overlap(Solid("a", 1.0, 1.0, 0.5, 0.5), Solid("b", 1.49, 1.0, 0.5, 0.5))
    assert overlap(Solid("a", 1.0, 1.0, 0.5, 0.5), Solid("b", 1.55, 1.0, 0.5, 0.5, yaw_rad=pi / 4))


def test_distances_by_hand():
    box = Solid("a", 1.0, 1.0, 0.5, 0.5)
    assert distance(1.0, 1.0, box) == 0.0
    assert distance(2.0, 1.0, box) == pytest.approx(0.75)
    assert distance(1.25 + 0.3, 1.25 + 0.4, box) == pytest.approx(0.5)
    turned = Solid("a", 0.0, 0.0, 2.0, 0.5, yaw_rad=pi / 2)
    assert distance(0.0, 1.5, turned) == pytest.approx(0.5)
    assert distance(1.0, 0.0, turned) == pytest.approx(0.75)
