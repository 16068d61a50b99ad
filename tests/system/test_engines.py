"""The two engines: the same bytes, and a word of why wherever it is Python."""

from __future__ import annotations

import json

import pytest

from attnlab.errors import ConfigError
from attnlab.results import load
from attnlab.robot.engines import PAYS_CYCLES, choose
from attnlab.robot.episodes import play_run
from attnlab.robot.plan import RunPlan
from attnlab.testing import config
from attnlab.testing.digest import digest
from tests.system import short_runs

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
    ({"simulator": "scripted", "behaviours": ("give",), "needs": "energy_only"},
     "simulator=scripted runs as Python: its hand is looked up in a table of points"),
    ({"validation": {"simulator": "planar"}}, "validation has a simulator of its own")])
def test_what_runs_as_python_says_why(how, why):
    assert choose(RunPlan(config(**how))) == ("python", why)


def test_a_short_study_is_not_worth_compiling(monkeypatch):
    monkeypatch.setattr("attnlab.robot.engines.build", lambda plan, only_kept=False: not only_kept)
    monkeypatch.setattr("attnlab.robot.engines.differs", lambda plan: "")
    engine, why = choose(RunPlan(config()))
    assert engine == "python" and f"{PAYS_CYCLES:,}" in why and "360" in why
    told = []
    assert choose(RunPlan(config()), PAYS_CYCLES, lambda: told.append(1)) == ("compiled", "engine=auto") and told


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
