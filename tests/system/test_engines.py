"""The two engines: the same bytes, and a word of why wherever it is Python."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import yaml

from attnlab.attention import Log
from attnlab.errors import ConfigError
from attnlab.results import load
from attnlab.robot.engines import LOOKS_CYCLES, PAYS_CYCLES, choose
from attnlab.robot.episode import run_episode
from attnlab.robot.episodes import play_run
from attnlab.robot.folder import run_to_folder
from attnlab.robot.plan import RunPlan
from attnlab.testing import config
from attnlab.testing.digest import digest
from tests.system import short_runs

ROOT = Path(__file__).resolve().parents[2]
GOLDEN = json.loads(short_runs.GOLDEN.read_text())


def test_the_paper_compiled_is_the_paper():
    tables, _ = play_run(RunPlan(short_runs.RUNS["paper"]), engine="compiled")
    assert digest(tables) == GOLDEN["paper"]


@pytest.mark.long
@pytest.mark.parametrize("name", GOLDEN)
def test_every_part_that_compiles_gives_the_same(name):
    plan = RunPlan({**short_runs.RUNS[name], "engine": "compiled"})
    try:
        choose(plan)
    except ConfigError as cause:
        pytest.skip(f"runs interpreted: {cause}")
    assert digest(play_run(plan, engine="compiled")[0]) == GOLDEN[name]


@pytest.mark.parametrize(("how", "why"), [
    ({"engine": "python"}, "engine=python"),
    ({"engine": "auto", "train_episodes": 1000, "max_cycles": 1000, "simulator": "scripted", "behaviours": ("give",),
      "needs": "energy_only"},
     "simulator=scripted runs as Python: its hand is looked up in a table of points"),
    ({"train_episodes": 1000, "max_cycles": 1000, "validation": {"simulator": "planar"}},
     "validation has a simulator of its own")])
def test_what_runs_as_python_says_why(how, why):
    assert choose(RunPlan(config(**how))) == ("python", why)


def test_a_short_study_is_not_worth_compiling(monkeypatch):
    monkeypatch.setattr("attnlab.robot.engines.build", lambda plan, only_kept=False: not only_kept)
    monkeypatch.setattr("attnlab.robot.engines.differs", lambda plan: "")
    assert choose(RunPlan(config())) == ("python", "it is short: 360 cycles at most")
    engine, why = choose(RunPlan(config()), PAYS_CYCLES - 1)
    assert engine == "python" and f"{PAYS_CYCLES:,}" in why
    told = []
    assert choose(RunPlan(config()), PAYS_CYCLES, lambda: told.append(1)) == ("compiled", "engine=auto") and told


def test_nothing_is_compiled_for_a_smoke_test():
    asked = yaml.safe_load((ROOT / "conf/experiment/smoke.yaml").read_text())
    runs = len(asked["hydra"]["sweeper"]["params"]["curiosity"].split(","))
    assert runs * asked["max_cycles"] * (asked["train_episodes"] + asked["validation_episodes"]) < LOOKS_CYCLES


def test_compiled_or_nothing(complain):
    code, err, written = complain("engine=compiled", "simulator=scripted", "behaviours=[give]", "needs=energy_only")
    assert code == 2 and written == [] and len(err.strip().splitlines()) == 1
    assert "engine=compiled: cannot be: simulator=scripted runs as Python" in err


@pytest.mark.long
def test_run_json_says_which_and_why(attnlab, tmp_path):
    short = ("train_episodes=2", "validation_episodes=1", "max_cycles=100", "simulator=planar", "report=false",
             "picture=false")
    for engine in ("python", "compiled"):
        assert attnlab(*short, f"engine={engine}", f"study={engine}").returncode == 0
    found = {engine: load(tmp_path / "outputs" / engine).runs.iloc[0] for engine in ("python", "compiled")}
    about = {engine: json.loads(next((tmp_path / "outputs" / engine).glob("*/run.json")).read_text())
             for engine in found}
    assert (about["python"]["engine"], about["python"]["engine_why"]) == ("python", "engine=python")
    assert (about["compiled"]["engine"], about["compiled"]["engine_why"]) == ("compiled", "engine=compiled")
    for same in ("tables", "key"):
        assert about["python"][same] == about["compiled"][same]


SLIPS = """
from attnlab.exploration.base import Exploration
from attnlab.registry import register


@register("exploration", "slips")
class Slips(Exploration):
    \"\"\"The best; {what}.\"\"\"

    def __init__(self, params, context=None):
        super().__init__(params, context)
        self.seen = 0

    def choose(self, values, visits, draw):
        {body}
"""
LONG_STUDY = """
from attnlab.robot.engines import PAYS_CYCLES, choose
from attnlab.robot.plan import RunPlan
from attnlab.testing import config
print(*choose(RunPlan(config(exploration="slips")), PAYS_CYCLES), sep="\\n")
"""
FAULTS = {  # what the body of choose does, and what is said of it
    "what numba has not": ("return max(range(len(values)), key=lambda i: values[i])", "slips.py:"),
    "another number": ("self.seen = self.seen + 0.4\n        return 0 if self.seen < 3 else 1", "gives another"),
}


@pytest.mark.long
@pytest.mark.parametrize("fault", FAULTS)
def test_a_part_that_does_not_compile_or_not_to_the_same(attnlab, tmp_path, fault):
    body, said = FAULTS[fault]
    (tmp_path / "plugins").mkdir()
    (tmp_path / "plugins" / "slips.py").write_text(SLIPS.format(what=fault, body=body))
    short = ("exploration=slips", "simulator=planar", "train_episodes=2", "validation_episodes=1", "max_cycles=100",
             "report=false", "picture=false")
    refused = attnlab(*short, "engine=compiled")
    assert refused.returncode == 2 and said in refused.stderr and len(refused.stderr.strip().splitlines()) <= 2
    assert attnlab(*short).returncode == 0
    done = subprocess.run([sys.executable, "-c", LONG_STUDY], cwd=tmp_path, capture_output=True, text=True, check=True,
                          env={**os.environ, "PYTHONPATH": str(ROOT)})
    engine, why = done.stdout.splitlines()
    assert engine == "python" and said in why


def test_what_raises_compiled_is_played_again(tmp_path, monkeypatch):
    def breaks(engine, agent, explorations):
        def play(*_):
            raise ZeroDivisionError("division by zero")
        return (play if engine == "compiled" else run_episode), None, lambda: None
    monkeypatch.setattr("attnlab.robot.episodes.player", breaks)
    info = {"run": "a", "key": "k", "overrides": [], "swept": {}, "engine": ("compiled", "so")}
    assert run_to_folder(config(max_cycles=60), tmp_path / "a", info)
    about = json.loads((tmp_path / "a/run.json").read_text())
    assert about["engine"] == "python" and "division by zero" in about["engine_why"]


def test_a_table_of_looks_is_the_list(monkeypatch):
    plan = RunPlan(config(curiosity="none"))
    agent = plan.agent(plan.simulator())
    run_episode(agent, plan.exploration("train"), plan.start_pose("train", 0), True)
    for attention in agent.attentions:
        log = Log()
        log.table = np.array(attention.log, float)
        log.rows = len(log.table)
        assert log.looks() == attention.log.looks() == tuple(attention.log)
        for one, other in zip(log.columns(), attention.log.columns(), strict=True):
            assert np.array_equal(one, other, equal_nan=True) and one.dtype == other.dtype
