"""AVOID by hand. By default it is free from 1.0 m on, stops at 0.35 m, turns for echoes within 0.65 m and is blocked
by one of the four foremost within 0.55 m; 0.4 m/s and 1.5 rad/s are the most it does."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from attnlab.testing import make
from tests.behaviours.senses import Told, echoes

EXACT = {"active_margin_m": 0.15, "blocked_margin_m": 0.025}  # 0.5 m and 0.375 m
DISTANCES = st.lists(st.floats(0.0, 5.0), min_size=8, max_size=8)


def command(heard, avoid=None):
    avoid = avoid or make("behaviours", "avoid")
    return avoid.command(Told(heard), avoid.percept(Told(heard)))


@pytest.mark.parametrize(("nearest", "speed"), [
    (0.0, 0.0), (0.34, 0.0), (0.35, 0.0), (0.48, 0.08), (0.675, 0.2), (0.87, 0.32), (1.0, 0.4), (3.0, 0.4)])
def test_speed_falls_from_all_at_sigma_max_to_none_where_it_stops(nearest, speed):
    """0.4 (d - 0.35) / 0.65: at 0.48 m a fifth of it, at 0.675 a half, at 0.87 four fifths."""
    assert command(echoes(s0=nearest))[0] == pytest.approx(speed)
    assert command(echoes(s5=nearest))[0] == pytest.approx(speed)


def test_speed_with_its_own_limits():
    avoid = make("behaviours", "avoid", how={"stop_distance_m": 0.5, "avoid_sigma_max_m": 2.5, "v_max_m_s": 0.8})
    assert command(echoes(s7=1.0), avoid)[0] == pytest.approx(0.8 * 0.5 / 2.0)


def test_each_sonar_turns_away_by_its_weight():
    """0.8 rad/s times 0.2, 0.5, 0.8, 1.0 from the side to the front; an echo on the left turns it to the right."""
    turns = [command(echoes(**{f"s{i}": 0.6}))[1] for i in range(8)]
    assert turns == pytest.approx([-0.16, -0.4, -0.64, -0.8, 0.8, 0.64, 0.4, 0.16])


def test_turns_of_all_active_sonars_add_up():
    assert command(echoes(s0=0.6, s1=0.64, s7=0.3))[1] == pytest.approx(-0.16 - 0.4 + 0.16)
    assert command(echoes(s2=0.6, s3=0.6, s6=0.7))[1] == pytest.approx(-0.64 - 0.8)
    assert command(echoes())[1] == 0.0
    strong = make("behaviours", "avoid", gain_rad_s=2.0, weights=[0.1, 0.2, 0.3, 0.4])
    assert command(echoes(s0=0.6, s4=0.6), strong)[1] == pytest.approx(2.0 * (0.4 - 0.1))


def test_where_a_sonar_gets_active_and_the_way_blocked():
    """Danger begins at 0.35 m: active below 0.5 m, blocked below 0.375 m, neither of them at it, and wherever it stops
    and however fast it goes."""
    for how in ({}, {"stop_distance_m": 0.1}, {"speed_law": "proportional"}):
        where_it_turns(how)


def where_it_turns(how):
    def turn(**at):
        return command(echoes(**at), make("behaviours", "avoid", how=how, **EXACT))[1]
    assert turn(s6=0.5) == 0.0 and turn(s6=0.499) == pytest.approx(0.4)
    assert turn(s5=0.375) == pytest.approx(0.64) and turn(s5=0.374) == 1.5


@pytest.mark.parametrize("sonar", range(8))
def test_only_the_four_foremost_block_the_way(sonar):
    turn = command(echoes(**{f"s{sonar}": 0.5}))[1]
    if 2 <= sonar <= 5:
        assert turn == (-1.5 if sonar < 4 else 1.5)
    else:
        assert abs(turn) < 0.5


def test_blocked_it_keeps_to_its_side_until_the_way_is_free():
    avoid = make("behaviours", "avoid")
    left, right, free = echoes(s3=0.5), echoes(s4=0.5), echoes(s0=0.6)
    assert [command(heard, avoid)[1] for heard in (left, right, left)] == [-1.5] * 3  # the other side, but it goes on
    assert command(free, avoid)[1] == pytest.approx(-0.16)
    assert command(left, avoid)[1] == -1.5
    command(free, avoid)
    assert [command(heard, avoid)[1] for heard in (right, left)] == [1.5] * 2
    for first, turn in ((left, -1.5), (right, 1.5), (left, -1.5)):
        avoid.start()  # a new episode
        assert command(first, avoid)[1] == turn


def test_in_a_corner_it_turns_left():
    """Both sides cancel exactly: 0.8 - 0.8."""
    assert command(echoes(s3=0.5, s4=0.5)) == (pytest.approx(0.4 * 0.15 / 0.65), 1.5)


def test_percept_is_the_nearest_echo_within_its_domain():
    avoid, cut = make("behaviours", "avoid"), make("behaviours", "avoid", how={"percept_domain": "min_to_max"})
    assert (avoid.sigma_low, avoid.sigma_high, cut.sigma_low, cut.sigma_high) == (0.0, 1.0, 0.4, 1.0)
    for nearest, sigma, within in ((0.2, 0.2, 0.4), (0.7, 0.7, 0.7), (1.5, 1.0, 1.0)):
        assert avoid.percept(Told(echoes(s6=nearest))) == sigma
        assert cut.percept(Told(echoes(s1=nearest, s2=2.0))) == within


@pytest.mark.parametrize("domain", ["zero_to_max", "min_to_max"])
def test_reward_is_eq_7_whatever_the_percepts_domain(domain):
    """sigma_min is Table 4's 0.4 m: 0.7 m is half of the way to 1 m, and nearer than 0.4 m the term is 0."""
    avoid = make("behaviours", "avoid", how={"percept_domain": domain})
    assert avoid.reward(0.7, 3 / 11) == pytest.approx(0.5 * (3 / 11 + 0.5))
    assert [avoid.reward(sigma, 0.0) for sigma in (0.4, 0.3, 0.0)] == pytest.approx([0.0, 0.0, 0.0], abs=1e-12)
    assert avoid.reward(1.0, 1.0) == 1.0
    to_the_wall = make("behaviours", "avoid", how={"percept_domain": domain, "reward_sigma_min_m": 0.0})
    assert to_the_wall.reward(0.3, 3 / 11) == pytest.approx(0.5 * (3 / 11 + 0.3))


def test_a_robot_is_paid_for_what_it_perceives():
    """Through the behaviour: an echo at 0.55 m, a quarter of the way from 0.4 to 1 m."""
    avoid = make("behaviours", "avoid")
    assert avoid.reward(avoid.percept(Told(echoes(s3=0.55))), 0.0) == pytest.approx(0.125)


def test_the_papers_speed_law():
    """v = v_max sigma / sigma_max: half of it at 0.5 m, none only at the wall."""
    avoid = make("behaviours", "avoid", how={"speed_law": "proportional"})
    speeds = [command(echoes(s0=d), avoid)[0] for d in (0.0, 0.3, 0.5, 1.0, 4.0)]
    assert speeds == pytest.approx([0.0, 0.12, 0.2, 0.4, 0.4])


def test_the_turn_rule_of_the_paper_forgets_its_side():
    """Blocked on the left it turns right; blocked on both sides alike, ours goes on to the right, the sum is 0."""
    for rule, then in (("keeps_side", -1.5), ("sum", 0.0)):
        avoid = make("behaviours", "avoid", how={"turn_rule": rule})
        assert command(echoes(s3=0.5), avoid)[1] < 0
        assert command(echoes(s3=0.5, s4=0.5), avoid)[1] == pytest.approx(then)


@given(DISTANCES, st.integers(0, 7), st.floats(0.0, 1.0))
@settings(max_examples=100, deadline=None)
def test_nearer_is_never_faster(heard, sonar, share):
    nearer = [d * share if i == sonar else d for i, d in enumerate(heard)]
    slow, fast = command(nearer)[0], command(heard)[0]
    assert 0.0 <= slow <= fast <= 0.4


@given(st.lists(st.floats(0.55, 0.8), min_size=8, max_size=8))
@settings(max_examples=100, deadline=None)
def test_a_mirrored_world_mirrors_the_turn(heard):
    """As long as the way is free: blocked in the middle, it has to prefer a side."""
    (v, w), (mirrored_v, mirrored_w) = command(heard), command(heard[::-1])
    assert mirrored_v == v and mirrored_w == pytest.approx(-w, abs=1e-12)
