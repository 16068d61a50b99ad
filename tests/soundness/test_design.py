"""The design test: before anything is learned, attention must matter in the way the model says it does.

AVOID at a fixed period, the others' periods random. The short form runs on planar; the long one, with the numbers of
the issue and learning, is marked.
"""

from __future__ import annotations

import pandas as pd
import pytest

from attnlab.robot.episodes import play_run
from attnlab.robot.plan import RunPlan
from attnlab.testing import config
from attnlab.testing.build import node


def episodes(**changes) -> pd.DataFrame:
    settings = {"check_identities": False, "record": "none", "max_cycles": 1150, **changes}
    tables, _ = play_run(RunPlan(config(**settings)))
    return pd.DataFrame(tables["episodes"])


def fixed_avoid(period: int, count: int, **changes) -> pd.DataFrame:
    learner = node("learner", "fixed", period=-1, periods={"avoid": period})
    return episodes(learner=learner, curiosity="none", train_episodes=count, validation_episodes=0, **changes)


def crashed(frame: pd.DataFrame) -> float:
    return float((frame["death"] == "crash").mean())


def check_design(count: int, **changes) -> None:
    runs = {period: fixed_avoid(period, count, **changes) for period in (1, 4, 8, 12)}
    survival = {period: frame["survival"].mean() for period, frame in runs.items()}
    starved = float(runs[1]["death"].isin(["hunger", "thirst"]).mean())
    assert survival[4] > 0.97 and survival[8] > 0.9, survival
    assert survival[12] < survival[4] - 0.1, survival
    assert survival[1] < survival[4], survival
    assert crashed(runs[1]) < 0.01 and crashed(runs[4]) < 0.02
    assert crashed(runs[12]) > 0.2
    assert starved > 0.3  # every activation costs: always looking drives it towards starving


def test_design_short():
    check_design(60)


@pytest.mark.long
@pytest.mark.parametrize("simulator", ["planar", "pybullet"])
def test_design(simulator):
    check_design(600 if simulator == "planar" else 200, simulator=simulator)


@pytest.mark.long
def test_design_table4():
    check_design(300, how=node("reading", "table4"), max_cycles=1500)


@pytest.mark.long
@pytest.mark.parametrize("world", ["open", "cluttered", "random"])
def test_other_worlds_can_be_survived(world):
    frame = fixed_avoid(4, 300, world=node("world", world))
    assert frame["survival"].mean() > 0.9
    assert crashed(frame) < 0.03


@pytest.mark.long
def test_learning():
    """Means over 4 seeds: NCR survives from the start, and both conditions after training."""
    for curiosity in ("none", "litman"):
        frames = [episodes(seed=seed, curiosity=curiosity, train_episodes=500, validation_episodes=100)
                  for seed in range(4)]
        frame = pd.concat(frames)
        train, valid = frame[frame["phase"] == "train"], frame[frame["phase"] == "validation"]
        if curiosity == "none":
            assert train.loc[train["episode"] < 250, "survival"].mean() >= 0.90
        assert valid["survival"].mean() >= 0.95
