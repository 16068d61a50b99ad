"""Small parts by hand: how held commands become one, where AVOID stops, which readings make no sense."""

from __future__ import annotations

import pytest

from attnlab.errors import ConfigError
from attnlab.testing import make
from attnlab.testing.build import reading


@pytest.mark.parametrize(("held", "fused"), [
    ([], (0.0, 0.0)), ([(0.3, 0.5)], (0.3, 0.5)), ([(0.3, 0.5), (0.1, -0.75)], (0.1, -0.25)),
    ([(0.1, 1.0), (0.3, 1.0)], (0.1, 1.5)), ([(0.2, -1.0), (0.2, -1.0)], (0.2, -1.5)),
    ([(9.0, 0.0)], (0.4, 0.0)), ([(0.2, 0.0), (-0.1, 0.0)], (0.0, 0.0))])
def test_the_slowest_speed_and_the_sum_of_turns(held, fused):
    assert make("fusion", "min_speed_sum_turn").fuse(held) == fused


@pytest.mark.parametrize(("held", "fused"), [
    ([], (0.0, 0.0)), ([(0.3, 0.5)], (0.3, 0.5)), ([(0.3, 0.5), (0.1, -1.0), (0.2, 1.25)], (0.2, 0.25)),
    ([(9.0, 5.0)], (0.4, 1.5)), ([(-1.0, -5.0)], (0.0, -1.5))])
def test_the_mean_of_speeds_and_turns(held, fused):
    assert make("fusion", "mean").fuse(held) == pytest.approx(fused)


def test_limits_are_the_robots():
    slow = {"v_max_m_s": 0.25, "w_max_rad_s": 0.5}
    for name in ("mean", "min_speed_sum_turn"):
        assert make("fusion", name, how=slow).fuse([(0.4, 0.75)]) == (0.25, 0.5)
        assert make("fusion", name, how=slow).fuse([(0.4, -0.75)]) == (0.25, -0.5)


def test_where_avoid_stops():
    """0.35 m; 0.2 m more than the safety distance if that kills; its own distance if it has one, even 0."""
    assert reading().stop_m == reading(stop_distance_m=0.1).danger_m == 0.35
    assert reading(crash="safety_distance").stop_m == pytest.approx(0.6)
    assert reading(crash="safety_distance", safety_distance_m=0.5).stop_m == pytest.approx(0.7)
    for crash in ("contact", "safety_distance"):
        assert [reading(crash=crash, stop_distance_m=d).stop_m for d in (0.0, 0.55)] == [0.0, 0.55]


@pytest.mark.parametrize(("most", "fine", "named"), [
    ({"energy_well": 4600.0}, {"energy_well": 4599.0}, "energy_well"),
    ({"need_start": 1500.0}, {"need_start": 1499.0}, "need_start"),
    ({"avoid_sigma_min_m": 1.0}, {"avoid_sigma_min_m": 0.99}, "avoid_sigma_min_m"),
    ({"stop_distance_m": 1.0}, {"stop_distance_m": 0.99}, "stop_distance_m"),
    ({"need_min": 1500.0}, {"need_min": 1499.0}, "need_min")])
def test_a_domain_without_width_is_refused(most, fine, named):
    with pytest.raises(ConfigError, match=named):
        reading(**most)
    reading(**fine)
    with pytest.raises(ConfigError, match=named):
        reading(**{name: value + 1.0 for name, value in most.items()})


def test_a_robot_that_cannot_starve_may_start_as_hungry_as_it_likes():
    assert reading(need_start=1500.0, need_death=False).need_start == 1500.0
