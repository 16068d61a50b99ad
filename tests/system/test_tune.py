"""Optuna asks for runs, is told of them, and goes on where it was stopped."""

from __future__ import annotations

import csv
import shlex
import sys
from pathlib import Path

import pytest

from attnlab.errors import ConfigError
from attnlab.tune import values_of

SHORT = ("simulator=planar", "train_episodes=2", "validation_episodes=1", "max_cycles=120", "picture=false",
         "report=false", "cluster=serial")
SPACE = ("--goal", "{name: survival, phase: train}", "--search", "learner.alpha=0.1:0.9", "--search",
         "learner=q_learning|sarsa", "--seeds", "0,1")


def table(study):
    return list(csv.DictReader((study / "tune.csv").read_text().splitlines()))


def test_a_search_that_is_stopped_goes_on_as_it_would_have(here, tmp_path, monkeypatch):
    optuna = pytest.importorskip("optuna")
    assert optuna
    from attnlab.tune import Bench
    outputs = tmp_path / "outputs"
    whole = here(*SPACE, "--trials", "2", *SHORT, "study=whole", module="attnlab.tune")
    assert whole.returncode == 0, whole.stderr

    played, value = [], Bench.value

    def stopping(self, settings):
        if len(played) == 1:
            raise KeyboardInterrupt
        played.append(settings)
        return value(self, settings)
    with monkeypatch.context() as patch:
        patch.setattr(Bench, "value", stopping)
        assert here(*SPACE, "--trials", "2", *SHORT, "study=stopped", module="attnlab.tune").returncode == 130
    assert here(*SPACE, "--trials", "2", *SHORT, "study=stopped", module="attnlab.tune").returncode == 0
    rows = table(outputs / "whole")
    assert [{**row} for row in rows] == table(outputs / "stopped") and len(rows) == 2
    assert {row["learner"] for row in rows} <= {"q_learning", "sarsa"}
    assert all(0.1 <= float(row["learner.alpha"]) <= 0.9 and 0 < float(row["value"]) <= 100 for row in rows)
    assert [float(row["value"]) for row in rows] == sorted((float(row["value"]) for row in rows), reverse=True)
    assert len(list((outputs / "whole").glob("*/run.json"))) == 4
    again = here(*SPACE, "--trials", "2", *SHORT, "study=whole", module="attnlab.tune")
    assert again.returncode == 0 and "trial" not in again.stdout.split("best of")[0]


def test_the_command_of_the_page(here, tmp_path):
    pytest.importorskip("optuna")
    page = (Path(__file__).resolve().parents[2] / "docs" / "tune.md").read_text()
    command = next(line for line in page.splitlines() if line.startswith("    python -m attnlab.tune"))
    typed = shlex.split(command.replace("--trials 30", "--trials 1").replace("0-2", "0"))[3:]
    done = here(*typed, *(setting for setting in SHORT if setting not in typed), module="attnlab.tune")
    assert done.returncode == 0, done.stderr
    assert len(table(tmp_path / "outputs" / "tuned")) == 1


@pytest.mark.parametrize(("arguments", "says"), [
    (["--goal", "survivall", "--search", "learner.alpha=0.1:0.9"], "no measure is called 'survivall'"),
    (["--goal", "[1]", "--search", "learner.alpha=0.1:0.9"], "--goal: '[1]' is no measure"),
    (["--goal", "survival", "--search", "learner.alfa=0.1:0.9"], "learner.alfa: no such setting"),
    (["--goal", "survival", "--search", "learner.alpha=0.1:9"], "learner.alpha: is 9"),
    (["--goal", "survival", "--search", "learner=q_learning|sarsaa|sarsa"], "no learner is called 'sarsaa'"),
    (["--goal", "survival", "--search", "learner.alpha=0.1:0.9", "--trials", "0"], "--trials: is 0")])
def test_wrong_words_are_one_line(here, arguments, says, tmp_path):
    pytest.importorskip("optuna")
    done = here(*arguments, *SHORT, module="attnlab.tune")
    assert (done.returncode, len(done.stderr.splitlines())) == (2, 1) and says in done.stderr, done.stderr
    assert not list(tmp_path.iterdir())


def test_without_optuna_it_says_what_to_type(here, monkeypatch):
    monkeypatch.setitem(sys.modules, "optuna", None)
    done = here("--goal", "survival", "--search", "learner.alpha=0.1:0.9", module="attnlab.tune")
    assert done.returncode == 2 and done.stderr == \
        "attnlab: attnlab.tune: optuna is not installed. pip install 'attnlab[optuna]'\n"


@pytest.mark.parametrize("text", ["", "a", "a=", "=1:2", "a=1", "a=2:1", "a=x:1", "a=log:0:1", "a=1:2:3", "a=[1]|2",
                                  "a=log:1", "a=nan:1"])
def test_what_is_no_space_is_refused(text):
    with pytest.raises(ConfigError, match=r"^--search") as refused:
        values_of(text)
    assert len(str(refused.value).splitlines()) == 1


def test_spaces():
    assert values_of("learner.alpha=0.1:0.9") == ("learner.alpha", ("range", 0.1, 0.9, False))
    assert values_of("a.b=log:1:100") == ("a.b", ("range", 1, 100, True))
    assert values_of("learner=sarsa|fixed_4|3|true") == ("learner", ("choice", "sarsa", "fixed_4", 3, True))
