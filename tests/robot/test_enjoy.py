"""A robot that has learned lives again, elsewhere and without learning."""

from __future__ import annotations

import math
import shutil
from pathlib import Path

import pandas as pd
import pytest
from scipy import stats

from attnlab.stats.intervals import difference_interval
from attnlab.tables.files import read_json
from tests.robot.stored import store

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def school(tmp_path_factory):
    return store(tmp_path_factory.mktemp("school") / "robot", train_episodes=4, validation_episodes=3, max_cycles=150)


@pytest.fixture
def run(here, school):
    """Calls the command on a run that is there: run("world=open") -> CompletedProcess."""
    return lambda *settings: here(str(school), *settings, module="attnlab.enjoy")


def test_it_lives_elsewhere_and_writes_nothing(run, tmp_path):
    done = run("world=cluttered", "episodes=4", "seed=7")
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert lines[0].endswith("4 episodes in world=cluttered, simulator=planar, seed=7, after 4 of training")
    assert [line.split("  ")[0] for line in lines[2:4]] == ["survival", "died"] and "looks in 100 cycles" in lines[-2]
    assert lines[-1].startswith("means over 4 and 3 episodes of this one robot")
    assert not list(tmp_path.iterdir())


def test_it_is_kept_as_a_study_that_can_be_watched(run, here, tmp_path):
    done = run("world=open", "simulator=pybullet", "episodes=2", "study=again")
    assert done.returncode == 0, done.stderr
    command = done.stdout.splitlines()[-1].split("python -m attnlab.replay ")[1]
    assert here(command, module="attnlab.replay").returncode == 0
    cycles = pd.read_parquet(tmp_path / command / "cycles.parquet")
    assert sorted(cycles["episode"].unique()) == [0, 1] and set(cycles["phase"]) == {"validation"}
    typed = read_json(tmp_path / "outputs" / "again" / "study.json")["commands"][0]["typed"]
    assert "world=open" in typed and "simulator=planar" not in typed and "train_episodes=0" in typed
    assert "nothing to run" in run("world=open", "simulator=pybullet", "episodes=2", "study=again").stdout


@pytest.mark.parametrize(("settings", "says"), [
    (["curiosity=none"], "curiosity: belongs to the robot, which lives as it has learned. Known: engine, episodes"),
    (["word=open"], "word: no such setting. Did you mean 'world'?"),
    (["world"], "world: is no setting"), (["world=nowhere"], "no world is called 'nowhere'"),
    (["episodes=0"], "episodes: is 0"), (["simulator.drive=wheels"], "simulator.drive: no such setting"),
    (["needs.what.else=1"], "needs.what.else: no such setting"), (["world=open,paper"], "world=open,paper"),
    (["reading.percept_bins=5"], "has the bins 6, this run 5"), (["study=a/b"], "study: 'a/b' cannot be")])
def test_wrong_words_are_one_line(run, settings, says, tmp_path):
    done = run(*settings)
    assert (done.returncode, len(done.stderr.splitlines())) == (2, 1) and says in done.stderr, done.stderr
    assert not list(tmp_path.iterdir())


def test_commands_of_the_page(here, school, tmp_path):
    shutil.copytree(school, tmp_path / "outputs" / "STUDY" / "RUN")
    page = (ROOT / "docs" / "agents.md").read_text()
    commands = [line.split()[2:] for line in page.splitlines() if line.startswith("    python -m ")]
    assert [module for module, *_ in commands] == ["attnlab.enjoy", "attnlab.enjoy", "attnlab"]
    for module, *arguments in commands:
        sooner = [] if module != "attnlab" else ["train_episodes=1", "validation_episodes=1", "max_cycles=150",
                                                 "picture=false", "report=false", "seed=0"]
        done = here(*(a for a in arguments if not (sooner and a.startswith("seed="))), *sooner, module=module)
        assert done.returncode == 0, done.stderr


def test_a_folder_that_is_no_run(here):
    done = here("nowhere", module="attnlab.enjoy")
    assert (done.returncode, len(done.stderr.splitlines())) == (2, 1) and "there is no such folder" in done.stderr


def test_the_interval_is_welchs():
    one, other = [1.0, 2.0, 4.0, math.nan, 3.5], [0.5, 0.7, 0.6]
    value, low, high = difference_interval(one, other)
    welch = stats.ttest_ind(one, other, equal_var=False, nan_policy="omit").confidence_interval()
    assert (value, low, high) == pytest.approx((2.625 - 0.6, welch.low, welch.high))
    assert difference_interval([1.0, 1.0], [0.0, 0.0]) == (1.0, 1.0, 1.0)
    assert math.isnan(difference_interval([1.0], [0.0, 2.0]).low)
    assert math.isnan(difference_interval([], [0.0]).value)
