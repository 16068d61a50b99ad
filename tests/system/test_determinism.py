"""Same config, same bytes: twice in a process, in other processes, alone or beside others."""

from __future__ import annotations

import hashlib
import random

import numpy as np
import pytest

from attnlab.robot.episodes import play_run
from attnlab.robot.folder import run_to_folder
from attnlab.robot.plan import RunPlan
from attnlab.tables.schema import TABLES
from attnlab.testing import config

INFO = {"run": "a", "key": "k", "overrides": [], "swept": {}}


def digest(folder) -> dict[str, str]:
    return {t: hashlib.sha256((folder / f"{t}.parquet").read_bytes()).hexdigest() for t in TABLES}


@pytest.mark.parametrize("simulator", ["planar", "pybullet"])
@pytest.mark.parametrize("curiosity", ["litman", "none"])
def test_twice_in_one_process(tmp_path, simulator, curiosity):
    settings = config(simulator=simulator, curiosity=curiosity, max_cycles=300, claims_file="dinocera2014")
    assert run_to_folder(settings, tmp_path / "one", INFO)
    random.seed(3)
    np.random.seed(3)
    assert run_to_folder(settings, tmp_path / "two", INFO)
    assert digest(tmp_path / "one") == digest(tmp_path / "two")


def test_serial_and_parallel_and_another_order(attnlab, here, tmp_path):
    common = ("+experiment=cr_vs_ncr", "train_episodes=3", "validation_episodes=1", "max_cycles=200", "report=false",
              "picture=false", "simulator=pybullet")
    assert here(*common, "seed=0-1", "outputs=serial").returncode == 0
    assert attnlab(*common, "seed=1,0", "cluster.jobs=2", "outputs=parallel").returncode == 0
    runs = sorted(p.name for p in (tmp_path / "serial" / "cr_vs_ncr").iterdir() if p.is_dir() and p.name != ".claims")
    assert len(runs) == 4
    for run in runs:
        assert digest(tmp_path / "serial/cr_vs_ncr" / run) == digest(tmp_path / "parallel/cr_vs_ncr" / run)


def test_the_seed_changes_everything_drawn():
    one, two = (play_run(RunPlan(config(seed=seed, max_cycles=200)))[0] for seed in (0, 1))
    assert one["cycles"]["x_m"] != two["cycles"]["x_m"]


def test_nobody_outside_is_disturbed():
    random.seed(5)
    np.random.seed(5)
    before = random.getstate(), np.random.get_state()[1].tolist()
    play_run(RunPlan(config(max_cycles=100, train_episodes=1)))
    assert (random.getstate(), np.random.get_state()[1].tolist()) == before


def test_adding_a_behaviour_shifts_nobodys_randomness():
    """REST that is never released leaves the poses and the first choices of the others as they were."""
    plain = RunPlan(config()).start_pose("train", 1)
    more = RunPlan(config(behaviours=("avoid", "eat", "drink", "rest"))).start_pose("train", 1)
    assert plain == more
