"""What is said of an episode, by hand."""

from __future__ import annotations

import math
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest

from attnlab.attention import Activation, Log
from attnlab.robot.episode import run_episode
from attnlab.robot.plan import RunPlan
from attnlab.robot.summaries import bouts, distances, guard_of, safety, safety_held, turning
from attnlab.testing import config, run
from attnlab.worlds.base import Layout, outer_walls


def guard(*looks, periods=(1, 4, 8, 12)):
    """AVOID's clock that looked at (cycle, sigma, period granted)."""
    behaviour = SimpleNamespace(charges=("crash",), sigma_high=1.0)
    log = Log(Activation(cycle, sigma, 0, 0, period, 0.0, 0.0, True, None, None) for cycle, sigma, period in looks)
    return SimpleNamespace(behaviour=behaviour, log=log, periods=list(periods))


def test_safety_is_from_where_the_robot_is():
    """Periods 1, 4, 12: the robot is safe in the first cycles as far as it is away, and not at all at 12. What it saw
    (0.5 m) is another series."""
    clock = guard((0, 0.5, 1), (1, 0.5, 4), (5, 0.5, 12))
    at = np.array([0.2, 0.4, 0.6, 0.8, 3.0, 0.9, 0.9])
    looks = clock.log.columns()
    assert safety(clock, looks, at) == pytest.approx([0.2, 0.4 * 8 / 11, 0.6 * 8 / 11, 0.8 * 8 / 11, 8 / 11, 0.0, 0.0])
    assert safety_held(clock, looks, 7) == pytest.approx([0.5, *[0.5 * 8 / 11] * 4, 0.0, 0.0])


def test_who_guards():
    eats = SimpleNamespace(behaviour=SimpleNamespace(charges=("hunger",)), periods=[1, 4])
    assert guard_of([eats]) is None and guard_of([eats, guard(periods=(4,))]) is None
    found = guard()
    assert guard_of([eats, found]) is found


def test_distance_to_the_nearest_surface():
    """A 2 m by 2 m room with walls alone: 0.5 m from the west wall, and in the middle 1 m from all."""
    layout = Layout(2.0, 2.0, tuple(outer_walls(2.0, 2.0)), (0.5, 1.5, 0.5, 1.5), 0.3)
    assert distances(np.array([[0.5, 1.0, 0.0], [1.0, 1.0, 3.0]]), layout) == pytest.approx([0.5, 1.0])


def test_turning_goes_the_short_way():
    path = np.array([[0, 0, 3.0], [0, 0, -3.0], [0, 0, -2.5], [0, 0, -3.0]])
    assert turning(path) == pytest.approx(2 * math.pi - 6 + 0.5 + 0.5)


def test_bouts():
    """Meals at 10, 60, 100 are one bout (less than 60 apart), 160 begins another; drinks at 80 and 400."""
    found = bouts({"hunger": [10, 60, 100, 160], "thirst": [80, 400]})
    assert found["bouts"] == 4 and found["bout_switches"] == 3  # 10 food, 80 water, 160 food, 400 water
    assert found["bout_interval_mean"] == pytest.approx(130) and found["bout_interval_sd"] == pytest.approx(
        np.std([70, 80, 240], ddof=1))
    assert bouts({"hunger": [5], "thirst": []}) == {"bouts": 1, "bout_switches": 0, "bout_interval_mean": None,
                                                    "bout_interval_sd": None}


def test_rewards_are_told_without_penalties():
    """A robot that dies of hunger pays; the sums of eqs 7-9 are positive all the same."""
    tables = run(max_cycles=400, how={"need_start": 1300.0}, learner="fixed_1", train_episodes=1)
    rows = tables["behaviours"]
    assert "hunger" in tables["episodes"]["death"] and min(rows["penalty"]) == -1500.0
    assert min(rows["reward_extrinsic"]) >= 0.0


def lived(need_start=300.0, **how):
    """The activations of an episode of random clocks, by behaviour."""
    settings = {"max_cycles": 600, "curiosity": "none", "learner": "random", "seed": 3}
    plan = RunPlan(config(how={"need_start": need_start, **how}, **settings))
    agent = plan.agent(plan.simulator())
    run_episode(agent, plan.exploration("train"), plan.start_pose("train", 0), False)
    return {attention.behaviour.name: list(attention.log) for attention in agent.attentions}


@pytest.mark.parametrize("sigma_min", [0.4, 0.0])
def test_a_robot_that_drives_is_paid_by_eq_7_with_table_4s_sigma_min(sigma_min):
    """Some of what AVOID perceives is nearer than 0.4 m: those looks earn their period's term alone."""
    looks = lived(reward_sigma_min_m=sigma_min)["avoid"]
    near = 0
    for before, now in pairwise(looks):
        place = max(0.0, (now.sigma - sigma_min) / (1.0 - sigma_min))
        assert now.extrinsic == pytest.approx(0.5 * ((before.period - 1) / 11 + place))
        near += now.sigma < 0.4
    assert near > 5 and any(a.sigma > 0.5 for a in looks)


@pytest.mark.parametrize("need", ["eat", "drink"])
def test_eqs_8_and_9_have_no_sigma_min(need):
    """need_min changes no reward of theirs: it is the lowest percept with percept_domain=min_to_max, or nothing."""
    looks = lived(need_start=100.0)[need]
    assert looks == lived(need_start=100.0, need_min=700.0)[need] and looks[0].sigma < 300
    for before, now in pairwise(looks):
        assert now.extrinsic == pytest.approx(0.5 * ((before.period - 1) / 11 + 1 - now.sigma / 1500))
    cut = lived(need_start=100.0, percept_domain="min_to_max")[need]
    assert min(a.sigma for a in cut) == 300.0


def test_energy_and_needs_may_be_cut():
    """Cut as eqs 5, 6 and 10 do not: no energy above its largest, no need below 0, whatever is eaten."""
    for cut in (False, True):
        how = {"need_start": 20.0, "releaser_threshold": 0.0, "energy_clipped": cut, "needs_floored": cut,
               "meal_interval_cycles": 1}
        rows = run(seed=1, max_cycles=1150, how=how, record="all", train_episodes=4)["cycles"]
        assert (min(rows["hunger"] + rows["thirst"]) >= 0.0) == cut, cut
        assert (max(rows["energy"]) <= 4600.0) == cut, cut


def test_released_ones_may_be_the_active_ones():
    """With needs far from their release, EAT and DRINK look and cost nothing."""
    cost = {}
    for who in ("fired", "released"):
        rows = run(max_cycles=100, how={"active": who, "need_start": 0.0}, learner="fixed_4", train_episodes=1,
                   record="all")["cycles"]
        cost[who] = rows["hunger"][99]
    assert cost == {"fired": 75.0, "released": 25.0}  # 25 looks of each: at 0, 4, ..., 96
