"""The robot by hand: where its sonars are, how it drives an arc, what its camera makes of a cube."""

from __future__ import annotations

from math import cos, hypot, pi, radians, sin, sqrt

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from attnlab.simulators import robot
from attnlab.simulators.robot import BEAMS, SONARS, Camera, arc, centre_distances

# The left half of the front and of the back as published for the Pioneer 3: x mm, y mm, degrees.
FRONT_LEFT = [(69, 136, 90), (114, 119, 50), (148, 78, 30), (166, 27, 10)]
BACK_LEFT = [(-255, 27, 170), (-237, 78, 150), (-203, 119, 130), (-157, 136, 90)]


def mirrored(half):
    return [(x, -y, -angle) for x, y, angle in reversed(half)]


def test_the_ring_of_sonars():
    """Left to right along the front, then right to left along the back; the right half mirrors the left one."""
    published = FRONT_LEFT + mirrored(FRONT_LEFT) + mirrored(BACK_LEFT) + BACK_LEFT
    assert len(SONARS) == 16 and list(robot.FRONT) == [0, 1, 2, 3, 4, 5, 6, 7]
    for sonar, (x, y, angle) in zip(SONARS, published, strict=True):
        assert sonar == pytest.approx((x / 1000, y / 1000, radians(angle)))


def test_the_body_as_published():
    """Wheels of 195 mm, 330 mm apart; a sonar hears from 0.1 m on; the camera looks at half the height of a cube."""
    assert (robot.WHEEL_RADIUS_M, robot.WHEEL_BASE_M) == (0.195 / 2, 0.33)
    assert (robot.SONAR_MIN_M, robot.CAMERA_HEIGHT_M) == (0.1, 0.5 / 2)
    assert 0.0 < robot.SONAR_HEIGHT_M < 0.5  # so that it hears a cube
    assert robot.RADIUS_M < hypot(0.255, 0.027) < robot.RADIUS_M + 0.0065  # the rear sonars stand out by 6 mm


@pytest.mark.parametrize("heard", [0.1, 0.73, 5.0])
def test_echoes_seen_from_the_centre(heard):
    """The echo is ``heard`` along the sonar's axis; the sonar on the left side is 0.136 m out and 0.069 m ahead."""
    distances = centre_distances([heard] * 16)
    assert distances[0] == pytest.approx(hypot(heard + 0.136, 0.069))
    for found, (x, y, angle) in zip(distances, SONARS, strict=True):
        assert found == pytest.approx(hypot(x + heard * cos(angle), y + heard * sin(angle)))
    assert centre_distances([heard] * 8) == distances[:8]


def test_beams_start_where_their_line_passes_nearest_to_the_centre():
    for (fx, fy, c, s, ahead), (x, y, angle) in zip(BEAMS, SONARS, strict=True):
        assert (c, s) == pytest.approx((cos(angle), sin(angle)))
        assert fx * c + fy * s == pytest.approx(0.0, abs=1e-12)
        assert (fx + ahead * c, fy + ahead * s) == pytest.approx((x, y))


@pytest.mark.parametrize(("motion", "end"), [
    ((0.4, 0.0, 2.0), (1.0, 2.8, pi / 2)),  # straight on, 0.8 m
    ((0.0, 1.5, 0.5), (1.0, 2.0, pi / 2 + 0.75)),  # on the spot
    ((pi / 4, pi / 4, 2.0), (0.0, 3.0, pi)),  # a quarter of a circle of 1 m to the left
    ((pi / 4, -pi / 4, 2.0), (2.0, 3.0, 0.0)),  # and to the right
    ((0.4, 1e-10, 0.5), (1.0, 2.2, pi / 2)), ((0.4, -1e-10, 0.5), (1.0, 2.2, pi / 2))])
def test_an_arc(motion, end):
    """From (1, 2), heading along y."""
    assert arc(1.0, 2.0, pi / 2, *motion) == pytest.approx(end)


def test_even_the_smallest_turn_adds_up():
    assert [arc(0.0, 0.0, 0.0, 0.4, w, 1.0)[2] for w in (1e-10, -1e-10)] == [1e-10, -1e-10]


def test_a_straight_line_at_45_degrees():
    assert arc(0.0, 0.0, pi / 4, 0.4, 0.0, 5.0) == pytest.approx((sqrt(2), sqrt(2), pi / 4))


@given(st.floats(-3, 3), st.floats(0.01, 0.4), st.floats(-1.5, 1.5), st.floats(0.01, 1.0), st.floats(0.0, 1.0))
@settings(max_examples=60, deadline=None)
def test_two_parts_of_an_arc_are_the_whole(heading, v, w, dt, share):
    halfway = arc(0.5, -0.5, heading, v, w, dt * share)
    assert arc(*halfway, v, w, dt * (1.0 - share)) == pytest.approx(arc(0.5, -0.5, heading, v, w, dt), abs=1e-6)


def test_a_camera_of_90_degrees():
    """80 columns: 40 px from the middle to the edge, so the focal length is 40 px; the left edge is at 45 degrees."""
    camera = Camera(80, 60, pi / 2)
    assert camera.focal_px == pytest.approx(40.0)
    for column, bearing in ((40.0, 0.0), (0.0, pi / 4), (80.0, -pi / 4)):
        assert camera.bearing(column) == pytest.approx(bearing)
        assert camera.column(bearing) == pytest.approx(column)
    assert Camera(100, 60, 2 * radians(60)).focal_px == pytest.approx(50 / sqrt(3))


def test_a_cube_of_half_a_metre_by_its_height():
    """20 px at a focal length of 40: 1 m ahead, 2 m away at 60 degrees; twice as high, twice as far."""
    camera = Camera(80, 60, pi / 2)
    assert camera.distance(20.0, 0.0) == pytest.approx(1.0)
    assert camera.distance(5.0, 0.0) == pytest.approx(4.0)
    assert camera.distance(20.0, pi / 3) == pytest.approx(2.0)
    assert camera.distance(20.0, 0.0, 1.0) == pytest.approx(2.0)


@pytest.mark.parametrize(("rows", "half", "within"), [
    (60, 0.0, 0), (60, 0.49, 0), (60, 0.5, 2), (60, 1.49, 2), (60, 1.5, 4), (60, 29.4, 58), (60, 30.0, 60),
    (60, 31.0, 60), (61, 0.0, 1), (61, 0.99, 1), (61, 1.0, 3), (61, 2.5, 5), (61, 29.9, 59), (61, 30.5, 61),
    (61, 40.0, 61), (62, 1.0, 2), (63, 1.0, 3)])
def test_pixel_centres_near_the_middle_line(rows, half, within):
    """Of an even number of rows the nearest centres are half a pixel off the middle, of an odd number one is on it."""
    assert Camera(80, rows, pi / 2).rows_within(half) == within
    assert sum(abs(row + 0.5 - rows / 2) <= half for row in range(rows)) == within
