"""A run that was interrupted goes on where it was, whatever it is made of, and gives the same bytes."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from random import Random

import numpy as np
import pytest

from attnlab import registry
from attnlab.api import register
from attnlab.exploration.greedy import Greedy
from attnlab.robot.episodes import play_run
from attnlab.robot.folder import run_to_folder
from attnlab.robot.keeping import CHECKPOINT, Keeping
from attnlab.robot.plan import RunPlan
from attnlab.robot.restore import restore
from attnlab.robot.state import UnkeptError, written
from attnlab.testing import config
from attnlab.testing.digest import digest


class Stop(BaseException):
    pass


def stopping_after(episode):
    def progress(episodes, cycles):
        if episodes == episode:
            raise Stop
    return progress


def killed_everywhere(plan, folder, engine="python"):
    """The tables of a run that is killed after each of its episodes; where it went on."""
    episodes, went_on = plan.settings.train_episodes + plan.settings.validation_episodes, []
    for episode in range(1, episodes + 1):
        keeping = Keeping(plan, folder, "key")
        with pytest.raises(Stop):
            play_run(plan, progress=stopping_after(episode), keeping=keeping, engine=engine)
        went_on.append(keeping.done)
    keeping = Keeping(plan, folder, "key")
    tables, cycles = play_run(plan, keeping=keeping, engine=engine)
    return tables, cycles, [*went_on, keeping.done]


@pytest.mark.parametrize("how", [
    {"learner": "double_q", "curiosity": "litman_itti", "exploration": "annealed"},
    {"learner": "expected_sarsa", "how": {"novelty_persists": True, "energy_carry_over": True}},
    {"learner": "bandwidth", "behaviours": ("avoid", "eat", "drink", "wander", "rest"), "probe": ("clearance",),
     "how": {"food_supply": "wandering"}},
    {"simulator": "pybullet", "validation": {"simulator": "planar"}, "behaviours": ("avoid", "eat"), "max_cycles": 60}],
    ids=["parts-in-parts", "carried-over", "shared", "two-simulators"])
def test_killed_after_every_episode(tmp_path, how):
    plan = RunPlan(config(train_episodes=3, validation_episodes=2, checkpoint_minutes=0, **how))
    whole = play_run(plan)
    tables, cycles, went_on = killed_everywhere(plan, tmp_path)
    assert went_on == [0, 1, 2, 3, 4, 5]
    assert (digest(tables), cycles) == (digest(whole[0]), whole[1])


@pytest.mark.long
def test_compiled_code_goes_on_too_and_engines_may_take_turns(tmp_path):
    plan = RunPlan(config(train_episodes=3, validation_episodes=2, checkpoint_minutes=0))
    whole = digest(play_run(plan)[0])
    tables, _, went_on = killed_everywhere(plan, tmp_path, "compiled")
    assert went_on == [0, 1, 2, 3, 4, 5] and digest(tables) == whole
    (tmp_path / CHECKPOINT).unlink()
    with pytest.raises(Stop):
        play_run(plan, progress=stopping_after(2), keeping=Keeping(plan, tmp_path, "key"), engine="compiled")
    assert digest(play_run(plan, keeping=Keeping(plan, tmp_path, "key"))[0]) == whole


def info(**more):
    return {"run": "r", "key": "key", "overrides": [], "swept": {}, **more}


def test_it_is_gone_when_the_run_is_complete(tmp_path):
    settings = config(checkpoint_minutes=0)
    folder, seen = tmp_path / "run", []
    assert run_to_folder(settings, folder, info(), lambda *_: seen.append((folder / CHECKPOINT).exists()))
    assert seen == [True] * 3 and not (folder / CHECKPOINT).exists()
    about = json.loads((folder / "run.json").read_text())
    assert "went_on_at" not in about and "checkpoints" not in about


@pytest.mark.parametrize("damage", ["", "{}\n{}\n", "cut", "digit", "key", "null"])
def test_a_damaged_or_foreign_checkpoint_counts_for_nothing(tmp_path, damage):
    plan = RunPlan(config(checkpoint_minutes=0))
    with pytest.raises(Stop):
        play_run(plan, progress=stopping_after(2), keeping=Keeping(plan, tmp_path, "key"))
    file = tmp_path / CHECKPOINT
    text = file.read_text()
    file.write_text({"cut": text[:-900], "digit": text[:-30] + "7" + text[-29:], "key": text.replace('"key"', '"yek"'),
                     "null": "null\n" + text.split("\n", 1)[1]}.get(damage, damage))
    keeping = Keeping(plan, tmp_path, "key")
    tables, _ = play_run(plan, keeping=keeping)
    assert keeping.done == 0 and digest(tables) == digest(play_run(plan)[0])


@pytest.fixture
def keeps_a_file():
    class KeepsAFile(Greedy):
        """Holds what no text can hold."""

        def __init__(self, params, context=None):
            super().__init__(params, context)
            self.file = sys.stdout
    register("exploration", "keeps_a_file")(KeepsAFile)
    yield "keeps_a_file"
    del registry.parts["exploration", "keeps_a_file"]


def test_what_cannot_be_kept_is_named_and_the_run_is_done(keeps_a_file, tmp_path):
    assert run_to_folder(config(exploration=keeps_a_file, checkpoint_minutes=0), tmp_path / "run", info())
    about = json.loads((tmp_path / "run" / "run.json").read_text())
    assert about["checkpoints"].startswith("none: train.file is a ") and about["checkpoints"].endswith("written down")
    assert about["agent"]["why_not"].startswith("exploration.file is a ")
    assert not (tmp_path / "run" / "agent.json").exists()


def test_those_who_watch_see_all_or_nothing(tmp_path):
    settings = config(checkpoint_minutes=0)
    settings["callback"] = {"jsonl": {"name": "jsonl"}}
    assert run_to_folder(settings, tmp_path / "run", info())
    assert "callback" in json.loads((tmp_path / "run" / "run.json").read_text())["checkpoints"]


class Thing:
    def __init__(self):
        self.rows = [[0.1, -0.0], [1e-320, float("inf")]]
        self.alias, self.self = self.rows[1], self
        self.by = {(1, 2): [3], "x": {4, 5}}
        self.grid, self.draw = np.arange(4.0).reshape(2, 2), Random(1)
        self.generator, self.one = np.random.default_rng(1), np.float32(0.1)
        self.text, self.nothing, self.pair = 'a"\n', None, (1, [2.5])


def test_all_kinds_come_back_with_their_bits_and_who_shares_what():
    one, two = Thing(), Thing()
    one.rows[1][0], one.rows[0] = 2 / 3, [True]
    one.grid[1, 1], one.by["y"], one.pair = np.nan, one.pair[1], (7, one.pair[1])
    one.draw.gauss(0, 1), one.generator.random()
    text = json.dumps(written({"it": one}), allow_nan=False)
    restore({"it": two}, json.loads(text))
    assert json.dumps(written({"it": two}), allow_nan=False) == text
    assert two.alias is two.rows[1] and two.self is two and two.by["y"] is two.pair[1]
    assert (one.draw.gauss(0, 1), one.generator.random()) == (two.draw.gauss(0, 1), two.generator.random())
    assert type(two.one) is np.float32 and str(two.rows[0]) == "[True]"


@pytest.mark.parametrize("held", [sys.stdout, Random, iter([]), memoryview(b"1"), type("L", (list,), {})([1]),
                                  np.array([object()]), object()])
def test_what_has_no_text_is_refused_or_left(held):
    thing = Thing()
    thing.rows = held
    if held is Random:  # code is as it was made
        assert written({"it": thing})["it"]["has"]["rows"] == {"made": "random:Random"}
        with pytest.raises(UnkeptError, match=r"it\.rows was random:Random"):
            restore({"it": Thing()}, written({"it": thing}))
        return
    with pytest.raises(UnkeptError, match=r"it\.rows is a "):
        written({"it": thing})


WAITS = """
import time
from pathlib import Path
from attnlab import registry
from attnlab.api import register
from attnlab.exploration.softmax import Softmax
@register("exploration", "waits")
class Waits(Softmax):
    "Softmax that stops at episode 4 until there is a file."
    def start(self, episode):
        while episode == 4 and not Path("go").exists():
            time.sleep(0.05)
"""


def test_a_killed_run_goes_on_from_its_checkpoint(attnlab, tmp_path):
    (tmp_path / "plugins").mkdir()
    (tmp_path / "plugins" / "waits.py").write_text(WAITS)
    command = ("exploration=waits", "simulator=planar", "train_episodes=6", "validation_episodes=2", "max_cycles=150",
               "picture=false", "report=false", "checkpoint_minutes=0", "engine=python")
    root = Path(__file__).resolve().parents[2]
    process = subprocess.Popen([sys.executable, "-m", "attnlab", *command, "study=killed"], cwd=tmp_path,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True,
                               env={**os.environ, "PYTHONPATH": str(root)})
    killed, until = tmp_path / "outputs" / "killed", time.monotonic() + 200
    while time.monotonic() < until and process.poll() is None and not _at(killed, 4):
        time.sleep(0.1)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    assert _at(killed, 4)
    (tmp_path / "go").touch()
    assert attnlab(*command, "study=killed").returncode == 0
    assert attnlab(*command, "study=straight").returncode == 0
    about = json.loads(next(killed.glob("*/run.json")).read_text())
    assert about["went_on_at"] == 4
    straight = next((tmp_path / "outputs" / "straight").glob("*/run.json")).parent
    assert {file.name for file in straight.iterdir()} == {file.name for file in next(killed.glob("*/")).iterdir()}
    for file in (*straight.glob("*.parquet"), straight / "agent.json"):
        assert file.read_bytes() == (killed / straight.name / file.name).read_bytes(), file.name


def _at(study, episode):
    """Is there a checkpoint of a run that has done so many episodes?"""
    file = next(study.glob(f"*/{CHECKPOINT}"), None)
    return file is not None and json.loads(file.read_text().split("\n")[0])["done"] == episode


