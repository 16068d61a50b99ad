"""Optuna asks for runs, is told of them, and goes on where it was stopped."""

from __future__ import annotations

import csv
import html
import shlex
import sys
from pathlib import Path

import pytest

from attnlab.errors import ConfigError
from attnlab.launch.space import Axis, axis
from attnlab.report.tuned import EDGE, WIDTH, Seen, Trial, Tuned, page
from attnlab.tables.study import read_study
from attnlab.tune import sweep_of

SHORT = ("simulator=planar", "train_episodes=2", "validation_episodes=1", "max_cycles=120", "picture=false",
         "report=false", "cluster=serial", "engine=python")
SPACE = ("tune.goal={name: survival, phase: train}", "learner.alpha=interval(0.1,0.9)", "learner=q_learning,sarsa",
         "seed=0,1", "tune.trials=2")


def table(study):
    return list(csv.DictReader((study / "tune.csv").read_text().splitlines()))


def test_a_search_that_is_stopped_goes_on_as_it_would_have(here, tmp_path, monkeypatch):
    pytest.importorskip("optuna")
    from attnlab.launch.trials import Tuning
    outputs = tmp_path / "outputs"
    whole = here(*SPACE, *SHORT, "study=whole")
    assert whole.returncode == 0, whole.stderr

    played, play = [], Tuning._play

    def stopping(self, point):
        if len(played) == 1:
            raise KeyboardInterrupt
        played.append(point)
        return play(self, point)
    with monkeypatch.context() as patch:
        patch.setattr(Tuning, "_play", stopping)
        assert here(*SPACE, *SHORT, "study=stopped").returncode == 130
    assert len(table(outputs / "stopped")) == 1 and "1 of 2 trials are done" in text_of(outputs / "stopped")
    assert here(*SPACE, *SHORT, "study=stopped").returncode == 0
    rows = table(outputs / "whole")
    assert rows == table(outputs / "stopped") and len(rows) == 2
    assert {row["learner"] for row in rows} <= {"q_learning", "sarsa"}
    for row in rows:
        assert 0.1 <= float(row["learner.alpha"]) <= 0.9 and len(row["learner.alpha"]) <= 6 and not row["failed"]
        assert float(row["value"]) == pytest.approx((float(row["seed 0"]) + float(row["seed 1"])) / 2)
    assert [float(row["value"]) for row in rows] == sorted((float(row["value"]) for row in rows), reverse=True)
    assert len(list((outputs / "whole").glob("*/run.json"))) == 4
    again = here(*SPACE, *SHORT, "study=whole")
    assert again.returncode == 0 and "trial 1" not in again.stdout.split("best of")[0]

    # what the page says to type is the best trial, on fresh seeds
    said = html.unescape(text_of(outputs / "whole").split("<pre>")[1].split("</pre>")[0])
    typed = shlex.split(said)[3:]
    assert f"learner.alpha={rows[0]['learner.alpha']}" in typed and f"learner={rows[0]['learner']}" in typed
    assert "seed=2-21" in typed
    assert here(*(o.replace("2-21", "0-1").replace("whole_best", "whole") for o in typed)).returncode == 0
    study = read_study(outputs / "whole")
    assert len({run.key for run in study.runs}) == len(study.runs) == 4, "its runs are those of the trial"


def text_of(study):
    return (study / "tune.html").read_text()


def test_the_experiment_and_the_command_are_one(here, tmp_path):
    pytest.importorskip("optuna")
    page = (Path(__file__).resolve().parents[2] / "docs" / "tune.md").read_text()
    commands = [shlex.split(line.replace("30", "1").replace("0-2", "0-1"))[2:] for line in page.splitlines()
                if line.startswith("    python -m attnlab")]
    assert [module for module, *_ in commands] == ["attnlab", "attnlab.tune"]
    found = []
    for i, (module, *typed) in enumerate(commands):
        outputs = f"outputs={tmp_path / str(i)}"
        done = here(*typed, *(o for o in SHORT if o not in typed), "record=none", outputs, module=module)
        assert done.returncode == 0, done.stderr
        study, = (tmp_path / str(i)).iterdir()
        found.append((table(study), sorted(f.parent.name for f in study.glob("*/run.json"))))
    assert found[0] == found[1] and len(found[0][0]) == 1


def test_a_trial_that_failed_is_named_and_tried_again(here, tmp_path, monkeypatch):
    pytest.importorskip("optuna")
    from attnlab.launch import trials
    complete = trials.complete
    with monkeypatch.context() as patch:
        patch.setattr(trials, "complete", lambda jobs, typed: [(jobs[0], "ValueError: <b>broken</b>")])
        done = here(*SPACE, *SHORT, "study=ill")
    assert done.returncode == 1 and "no trial has a value" in done.stderr
    text = text_of(tmp_path / "outputs" / "ill")
    assert "trial 1 failed" in text and "&lt;b&gt;broken&lt;/b&gt;" in text and "<b>broken" not in text
    asked = []
    with monkeypatch.context() as patch:
        patch.setattr(trials, "complete", lambda jobs, typed: asked.append(jobs[0].swept) or complete(jobs, typed))
        assert here(*SPACE, *SHORT, "study=ill").returncode == 0
    rows = table(tmp_path / "outputs" / "ill")
    assert sorted(row["trial"] for row in rows) == ["1", "2"] and len(asked) == 2
    assert "failed:" not in text_of(tmp_path / "outputs" / "ill")


GOAL, ALPHA = "tune.goal=survival", "learner.alpha=interval(0.1,0.9)"


@pytest.mark.parametrize(("arguments", "says"), [
    (["tune.goal=survivall", ALPHA], "no measure is called 'survivall'. Did you mean 'survival'"),
    (["tune.goal=[1]", ALPHA], "tune.goal: [1] is no measure"),
    (["tune.goal={name: survival, fase: train}", ALPHA], "tune.goal.fase: no such setting. Did you mean 'phase'"),
    (["tune.gaol=survival", ALPHA], "tune.gaol: no such setting. Did you mean 'goal'"),
    ([GOAL, "learner.alfa=interval(0.1,0.9)"], "learner.alfa: no such setting. Did you mean 'alpha'"),
    ([GOAL, "learner.alpha=interval(0.1,9)"], "learner.alpha: is 9"),
    ([GOAL, "learner.alpha=interval(0.9,0.1)"], "learner.alpha: interval(0.9,0.1) is no range"),
    ([GOAL, "learner.alpha=interval(0,inf)"], "learner.alpha: interval(0,inf) is no range"),
    ([GOAL, "learner.alpha=tag(log,interval(0,1))"], "factors need more than 0"),
    ([GOAL, "learner.alpha=tag(lag,interval(0.1,1))"], "has a tag that means nothing here"),
    ([GOAL, "learner=q_learning,sarsaa,sarsa"], "no learner is called 'sarsaa'"),
    ([GOAL, "learner=interval(1,2)"], "learner: interval(...) has numbers"),
    ([GOAL, "learner.alpha=0.5"], "tune: there is nothing to choose from"),
    ([GOAL, ALPHA, "tune.trials=0"], "tune.trials: is 0, must be at least 1"),
    ([GOAL, ALPHA, "tune.trials=many"], "tune.trials: expected a whole number"),
    ([GOAL, ALPHA, "tune.trials=1,2"], "tune.trials: cannot be swept"),
    ([GOAL, ALPHA, "seed=3"], "seed: a trial needs several"),
    ([GOAL, ALPHA, "variants={a: {learner: sarsa}}"], "variants: are compared"),
    ([GOAL, ALPHA, "study=a,b"], "study: cannot be swept"),
    ([GOAL, ALPHA, "train_episodes=1e9"], "train_episodes: "),
    ([ALPHA], "learner.alpha: interval(...) cannot be swept over all its values")])
def test_wrong_words_are_one_line(here, arguments, says, tmp_path):
    pytest.importorskip("optuna")
    seeds = ["seed=0,1"][:not any(o.startswith("seed=") for o in arguments)]
    asked = {o.partition("=")[0] for o in arguments}
    done = here(*arguments, *seeds, *(o for o in SHORT if o.partition("=")[0] not in asked))
    assert (done.returncode, len(done.stderr.splitlines())) == (2, 1) and says in done.stderr, done.stderr
    assert not list(tmp_path.iterdir())


def test_a_journal_that_is_none_is_named(here, tmp_path):
    pytest.importorskip("optuna")
    folder = tmp_path / "outputs" / "torn"
    folder.mkdir(parents=True)
    (folder / "tune.journal").write_text("no journal\nat all\n")
    done = here(*SPACE, *SHORT, "study=torn")
    assert done.returncode == 2 and "tune.journal: is no journal that can be read" in done.stderr


def test_without_optuna_it_says_what_to_type(here, monkeypatch):
    monkeypatch.setitem(sys.modules, "optuna", None)
    done = here(GOAL, ALPHA, "seed=0,1")
    assert done.returncode == 2 and done.stderr == \
        "attnlab: tune.goal: optuna is not installed. pip install 'attnlab[tune]'\n"


@pytest.mark.parametrize("text", ["", "a", "a=", "=1:2", "a=1", "a=1:2:3", "a=log:1", "a=x|", "a=:1"])
def test_what_is_no_space_is_refused(text):
    with pytest.raises(ConfigError, match=r"^--search") as refused:
        sweep_of(text)
    assert len(str(refused.value).splitlines()) == 1


def test_flags_become_sweeps():
    assert sweep_of("learner.alpha=0.1:0.9") == "learner.alpha=interval(0.1,0.9)"
    assert sweep_of("a.b=log:1:100") == "a.b=tag(log,interval(1,100))"
    assert sweep_of("learner=sarsa|fixed_4|3") == "learner=sarsa,fixed_4,3"


def parsed(text):
    from hydra.core.override_parser.overrides_parser import OverridesParser
    return OverridesParser.create().parse_override(text)


def test_spaces():
    alpha = axis(parsed("learner.alpha=interval(0.1,0.9)"), 0.5)
    assert alpha == Axis("learner.alpha", (), 0.1, 0.9) and alpha.edges == ("0.1", "0.9")
    assert alpha.text(0.123456) == "0.1235" and alpha.text(0.8999999) == "0.9"
    whole = axis(parsed("a=interval(1,12)"), 4)
    assert whole.whole and whole.text(3) == "3" and axis(parsed("a=interval(1,12)"), 4.0).whole is False
    assert axis(parsed("a=tag(log,interval(0.1,5))"), 1.0).log
    steps = axis(parsed("a=range(1,12,2)"), 1)
    assert (steps.low, steps.high, steps.step, steps.whole) == (1, 11, 2, True)
    assert axis(parsed("+generation=learned,fixed"), None) == Axis("generation", ("learned", "fixed"))


def test_the_page_in_a_browser(browser, tmp_path):
    """Nothing that was named becomes markup, nothing is wider than the page, every trial is a dot."""
    evil = "<img src=x onerror=alert(1)>"
    trials = [Trial(1, {"a": "0.1", "b": evil}, 2.0, {0: 1.0, 1: 3.0}), Trial(2, {"a": "10", "b": "y"}, None, {}, evil),
              Trial(3, {"a": "1", "b": "y"}, 4.0, {0: 4.0, 1: 4.0})]
    found = Tuned(evil, "survival", "%", False, "0-1", 3, [Seen("a", (), 0.1, 10, True), Seen("b", (evil, "y"))],
                  trials, {"a": 0.7, "b": 0.3}, f"python {evil}", {t.number: f"python {evil}" for t in trials})
    (tmp_path / "tune.html").write_text(page(found))
    dom, errors = browser("--enable-logging=stderr", "--window-size=500,900", "--dump-dom",
                          (tmp_path / "tune.html").as_uri())
    assert "Refused" not in errors and "<img" not in dom
    assert dom.count("<path class=\"seed\"") == 4 and dom.count("<path class=\"best\"") == 2
    assert "Trial 3 is the best of 2" in dom and "trial 2 failed" in dom
    middle = f"M{EDGE + 0.5 * (WIDTH - 2 * EDGE):.1f} "
    assert f'class="best" d="{middle}' in dom, "1 is half way from 0.1 to 10 by factors"
