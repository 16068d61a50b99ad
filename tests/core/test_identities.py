"""What must hold in every cycle of any run; and that the checks would notice if it did not."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from attnlab.robot.episodes import play_run
from attnlab.robot.identities import IdentityError, check_balance, check_clock, check_safety
from attnlab.robot.plan import RunPlan
from attnlab.testing import config
from attnlab.testing.build import node


@pytest.fixture(scope="module", params=["inferred", "table4"])
def recorded(request):
    """A run with all its cycles stored: (tables as frames, experiment)."""
    reading = node("reading", request.param)
    experiment = RunPlan(config(how=reading, record="all", train_episodes=12, validation_episodes=3,
                                max_cycles=reading["max_cycles"]))
    tables, _ = play_run(experiment)
    return {name: pd.DataFrame(table) for name, table in tables.items()}, experiment


def each_episode(cycles):
    return cycles.groupby(["phase", "episode"])


def test_energy_and_needs_balance_in_every_cycle(recorded):
    tables, experiment = recorded
    k = experiment.reading.need_k
    meals = 0
    for _, cycle in each_episode(tables["cycles"]):
        total = (cycle["energy"] + cycle["hunger"] + cycle["thirst"]).to_numpy()
        active = cycle[["avoid_active", "eat_active", "drink_active"]].sum(axis=1).to_numpy()
        start = experiment.reading.energy_start + 2 * experiment.reading.need_start
        assert np.allclose(np.diff(total, prepend=start), -1.0 + (2 * k - 1.0) * active, atol=1e-9)
        meals += int((np.diff(cycle["hunger"]) < 0).sum())
    assert meals > 0  # it was put to the test


def test_periods_sum_to_the_cycles(recorded):
    tables, _ = recorded
    for _, cycle in each_episode(tables["cycles"]):
        for behaviour in ("avoid", "eat", "drink"):
            at = np.flatnonzero(cycle[f"{behaviour}_active"])
            granted = cycle[f"{behaviour}_period"].to_numpy()[at]
            assert at[0] == 0
            assert np.array_equal(np.diff(at), granted[:-1])
            assert at[-1] + granted[-1] >= len(cycle)


def test_the_summed_period_term_is_n_minus_a_over_22(recorded):
    tables, _ = recorded
    for _, cycle in each_episode(tables["cycles"]):
        at = np.flatnonzero(cycle["eat_active"])
        elapsed = np.diff(at)
        assert (elapsed - 1).sum() / 22 == pytest.approx((at[-1] - (len(at) - 1)) / 22)


def test_safety_keeps_below_its_bound(recorded):
    tables, _ = recorded
    episodes = tables["episodes"].merge(tables["behaviours"].query("behaviour == 'avoid'"), on=["phase", "episode"])
    bound = (12 - episodes["cycles"] / episodes["activations"]) / 11
    assert (episodes["safety_mean"] <= bound + 1e-9).all()


def test_survival_and_death(recorded):
    tables, experiment = recorded
    e = tables["episodes"]
    assert ((e["survival"] < 1) <= (e["death"] != "none")).all()
    assert (e["cycles"] == (e["survival"] * experiment.reading.max_cycles).round()).all()
    assert (e["active_cycles"] <= e["cycles"]).all()
    per = tables["cycles"].groupby(["phase", "episode"]).size()
    assert per.sum() == e["cycles"].sum()


def test_episode_means_are_those_of_the_cycles(recorded):
    tables, _ = recorded
    e = tables["episodes"].set_index(["phase", "episode"])
    c = each_episode(tables["cycles"])
    for column in ("energy", "hunger", "thirst", "safety", "wanting"):
        assert np.allclose(e[f"{column}_mean"], c[column].mean().reindex(e.index)), column
    assert np.allclose(e["energy_min"], c["energy"].min().reindex(e.index))


def test_the_checks_notice():
    one = {"e_u": 1.0, "e_nb": 1.0, "growth": 2.0, "active": np.array([3]), "cycles": np.array([1])}
    check_balance(np.array([100.0, 102.0]), **one)
    with pytest.raises(IdentityError):
        check_balance(np.array([100.0, 103.0]), **one)
    check_clock([0, 4, 5], [4, 1, 12], 10)
    with pytest.raises(IdentityError):
        check_clock([0, 4, 6], [4, 1, 12], 10)
    with pytest.raises(IdentityError):
        check_clock([0, 4, 5], [4, 1, 4], 10)
    check_safety(0.5, 100, 20, 12, 1)
    with pytest.raises(IdentityError):
        check_safety(0.7, 100, 20, 12, 1)
