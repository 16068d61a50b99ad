"""The plane's geometry: values computed by hand, then against the same rules written naively."""

from __future__ import annotations

from math import cos, inf, isclose, pi, radians, sin, sqrt, tan

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from attnlab.simulators.base import SimulatorContext
from attnlab.simulators.planar import Planar
from attnlab.simulators.robot import RADIUS_M, SONARS, arc, centre_distances
from attnlab.worlds.base import Layout, outer_walls
from attnlab.worlds.geometry import Solid, clearance

FOCAL = 16 / tan(radians(30))


def planar(*solids: Solid, walls: bool = True, safety: float | None = None, cycles: int = 50, **params) -> Planar:
    layout = Layout(4.0, 4.0, (*(outer_walls(4.0, 4.0) if walls else ()), *solids), (0.0, 4.0, 0.0, 4.0), 0.3)
    return Planar(Planar.Params(**params), SimulatorContext(layout, 0.1565, cycles, safety))


def cube(x: float, y: float, kind: str = "food", yaw: float = 0.0) -> Solid:
    return Solid(kind, x, y, 0.5, 0.5, yaw)


def test_ranges_in_an_empty_room():
    room = planar()
    room.place(2.0, 2.0, 0.0)
    ranges = room.sonar()
    assert ranges[0] == pytest.approx(4 - 2.136)  # straight left
    assert ranges[3] == pytest.approx((4 - 2.166) / cos(radians(10)))
    assert ranges[1] == pytest.approx((4 - 2.119) / sin(radians(50)))
    assert ranges[11] == pytest.approx((2 - 0.255) / cos(radians(10)))  # to the rear, right
    assert room.sonar(8) == ranges[:8]


def test_ranges_of_a_turned_cube():
    room = planar(cube(3.0, 2.0, yaw=pi / 4))  # a corner points at the robot, 0.25 * sqrt(2) before its centre
    room.place(1.0, 2.027, 0.0)
    # Sonar 4 is at (1.166, 2), turned 10 degrees to the right, and meets the face x - y = 1 - 0.25 sqrt(2).
    t = (3.0 - 0.25 * sqrt(2) - 1.166) / (cos(radians(10)) - sin(radians(10)))
    assert room.sonar()[4] == pytest.approx(t)


def test_a_sonar_reads_its_least_range_at_a_wall_and_its_reach_in_the_void():
    room = planar()
    room.place(0.251, 2.0, 0.0)
    assert min(room.sonar()[8:]) == 0.1
    void = planar(walls=False, sonar_range_m=3.0)
    void.place(2.0, 2.0, 0.7)
    assert void.sonar() == [3.0] * 16


def test_blob_of_a_cube_ahead():
    room = planar(cube(2.25, 2.0))
    room.place(1.0, 2.0, 0.0)  # its face is 1 m ahead: 0.25 m is FOCAL / 4 = 6.93 px, so 7 pixel centres on each side
    (blob,) = room.blobs()
    assert (blob.kind, blob.height_px, blob.area_px, blob.solid) == ("food", 14, 14 * 14, 4)
    assert blob.bearing_rad == pytest.approx(0.0, abs=1e-12)
    assert blob.distance_m == pytest.approx(FOCAL * 0.5 / 14)


def test_blob_to_the_left_has_a_positive_bearing():
    room = planar(cube(2.25, 2.4))
    room.place(1.0, 2.0, 0.0)
    (blob,) = room.blobs()
    # The face is 1 m ahead, 0.15 to 0.65 m to the left, that is 4.16 to 18.01 px: the columns of 4.5 to 15.5 px. The
    # side that goes on from its edge fills the column of 3.5 px, at a depth of 0.15 FOCAL / 3.5 = 1.19 m: 12 rows.
    assert blob.area_px == 14 * 12 + 12
    assert tan(blob.bearing_rad) == pytest.approx((14 * 12 * 10.0 + 12 * 3.5) / blob.area_px / FOCAL)


def test_what_is_in_front_hides():
    behind, before = cube(3.25, 2.0, "food"), cube(2.25, 2.0, "obstacle")
    room = planar(behind, before)
    room.place(1.0, 2.0, 0.0)
    assert [blob.solid for blob in room.blobs()] == [5]
    wall = Solid("wall", 1.9, 2.0, 1.0, 0.05, pi / 2)
    assert planar_blobs(planar(wall, behind), 1.0, 2.0, 0.0) == []
    assert [b.solid for b in planar_blobs(planar(wall, behind), 1.0, 2.9, -0.4)] == [5]


def planar_blobs(simulator: Planar, *pose: float) -> list:
    simulator.place(*pose)
    return simulator.blobs()


@pytest.mark.parametrize(("x", "y", "touches"), [
    (0.25, 2.0, True), (0.2501, 2.0, False), (1.75, 3.0, True), (1.7499, 3.0, False),
    (2.0 - RADIUS_M / sqrt(2) + 1e-9, 2.75 - RADIUS_M / sqrt(2) + 1e-9, True),
    (2.0 - RADIUS_M / sqrt(2) - 1e-4, 2.75 - RADIUS_M / sqrt(2) - 1e-4, False),
])
def test_contact_of_the_disc(x, y, touches):
    room = planar(cube(2.25, 3.0))
    room.place(x, y, 1.0)
    assert room.advance(0.0, 0.0, 1) == (1, touches)


def test_contact_ends_the_motion_in_its_cycle():
    room = planar()
    room.place(3.0, 2.0, 0.0)
    needed = int((4.0 - RADIUS_M - 3.0) / (0.4 * 0.1565)) + 1
    assert room.advance(0.4, 0.0, 40) == (needed, True)
    assert room.cycle == needed and room.pose()[0] == pytest.approx(3.0 + needed * 0.4 * 0.1565)


def test_safety_distance_ends_the_motion():
    room, free = planar(safety=0.5), planar()
    for simulator in (room, free):
        simulator.place(3.0, 2.0, 0.0)
    moved, crashed = room.advance(0.4, 0.0, 40)
    assert crashed
    free.advance(0.4, 0.0, moved)
    assert min(centre_distances(free.sonar(8))) < 0.5
    free.place(3.0, 2.0, 0.0)
    free.advance(0.4, 0.0, moved - 1)
    assert min(centre_distances(free.sonar(8))) >= 0.5


poses = st.tuples(st.floats(-1, 5), st.floats(-1, 5), st.floats(-pi, pi))
solids = st.lists(st.builds(
    Solid, st.sampled_from(["food", "water", "obstacle", "wall"]), st.floats(0, 4), st.floats(0, 4),
    st.floats(0.05, 1.5), st.floats(0.05, 1.5), st.floats(-pi, pi)), max_size=6)


def crossings(x: float, y: float, dx: float, dy: float, solid: Solid) -> list[float]:
    """Where a line meets the four sides of a box, by solving two equations for each."""
    found, corners = [], solid.corners()
    for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1], strict=True):
        ex, ey = bx - ax, by - ay
        across = dx * ey - dy * ex
        if abs(across) > 1e-12:
            along = ((ax - x) * ey - (ay - y) * ex) / across
            part = ((ax - x) * dy - (ay - y) * dx) / across
            if -1e-12 <= part <= 1 + 1e-12:
                found.append(along)
    return found


@settings(max_examples=150, deadline=None)
@given(poses, solids)
def test_ranges_as_by_intersecting_every_side(pose, boxes):
    world = planar(*boxes)
    world.place(*pose)
    x, y, heading = pose
    for measured, (sx, sy, angle) in zip(world.sonar(), SONARS, strict=True):
        dx, dy = cos(heading + angle), sin(heading + angle)
        offset = sx * cos(angle) + sy * sin(angle)
        ox = x + cos(heading) * sx - sin(heading) * sy - offset * dx
        oy = y + sin(heading) * sx + cos(heading) * sy - offset * dy
        edges = [abs((cx - ox) * dy - (cy - oy) * dx) for solid in world.layout.solids for cx, cy in solid.corners()]
        ahead = [t for solid in world.layout.solids for t in crossings(ox, oy, dx, dy, solid)]
        if min(edges) < 1e-6 or min(map(abs, ahead), default=1) < 1e-9:
            continue  # a matter of rounding
        hit = min((t for t in ahead if t >= 0), default=inf)
        assert measured == pytest.approx(max(0.1, min(5.0, hit - offset)), abs=1e-9)


@settings(max_examples=150, deadline=None)
@given(poses, solids)
def test_pixels_as_by_looking_through_every_one(pose, boxes):
    world = planar(*boxes, camera_columns=17, camera_rows=11)
    world.place(*pose)
    cam, (x, y, heading) = world.camera, pose
    area: dict[int, int] = {}
    doubtful = False
    for column in range(cam.columns):
        left = (cam.columns / 2 - column - 0.5) / cam.focal_px
        dx, dy = cos(heading) - sin(heading) * left, sin(heading) + cos(heading) * left
        met = []
        for index, solid in enumerate(world.layout.solids):
            depths = crossings(x, y, dx, dy, solid)
            if depths:
                nearest = min(depths)
                doubtful |= len(depths) == 1 or abs(nearest) < 1e-6 or max(depths) - nearest < 1e-6
                if nearest >= 0:
                    met.append((nearest, index))
        met.sort()
        doubtful |= len(met) > 1 and met[1][0] - met[0][0] < 1e-9
        if met and world.layout.solids[met[0][1]].kind != "wall":
            for row in range(cam.rows):
                up = (cam.rows / 2 - row - 0.5) / cam.focal_px * met[0][0]
                doubtful |= isclose(abs(up), 0.25, abs_tol=1e-9)
                area[met[0][1]] = area.get(met[0][1], 0) + (-0.25 <= up <= 0.25)
    if not doubtful:
        assert {blob.solid: blob.area_px for blob in world.blobs()} == {i: n for i, n in area.items() if n}


@settings(max_examples=200, deadline=None)
@given(poses, st.floats(0, 2), st.floats(-10, 10), st.integers(1, 12))
def test_motion_is_the_robots_arc_bit_by_bit(pose, v, w, cycles):
    void = planar(walls=False)
    void.place(*pose)
    assert void.advance(v, w, cycles) == (cycles, False)
    for _ in range(cycles):
        x, y, heading = arc(*pose, v, w, 0.1565)
        pose = x, y, (heading + pi) % (2 * pi) - pi
    assert void.pose() == pose


@settings(max_examples=200, deadline=None)
@given(poses, solids)
def test_contact_as_by_clearance(pose, boxes):
    world = planar(*boxes)
    world.place(*pose)
    gap = clearance(*pose[:2], world.layout.solids) - RADIUS_M
    if abs(gap) > 1e-9:
        assert world.advance(0.0, 0.0, 1)[1] == (gap < 0)
