"""Differential Evolution over monitoring functions: better than where it began, resumable, parallel."""

import json

import pytest
import yaml

from attnlab.learners.base import Outcome
from attnlab.learners.evolution import Evolution, candidate, cost, evolve
from attnlab.paths import conf_dir
from attnlab.robot.episodes import play_run
from attnlab.robot.plan import RunPlan
from attnlab.robot.rehearsal import Rehearsal
from attnlab.testing import config

JOURNAL = "evolution.jsonl"
SETTINGS = {"name": "evolution", "generations": 3, "population": 6, "episodes": 2}


def plan(**learner):
    return RunPlan(config(learner={**SETTINGS, **learner}, max_cycles=200, curiosity="none"))


def params(**learner):
    return Evolution.Params(**{k: v for k, v in {**SETTINGS, **learner}.items() if k != "name"})


def evolved(plan, folder, **learner):
    with Rehearsal(plan, folder) as play:
        return evolve(params(**learner), play)


def costs_of(lines):
    return [cost([Outcome(*o) for o in json.loads(line)["outcomes"]], params().look_cost, 3) for line in lines]


def test_every_active_behaviour_is_charged():
    """Three who look in the same cycle pay three times, and two clocks out of step no more than two in step."""
    assert cost([Outcome(100, 25, 100)], 0.2, 1) == pytest.approx(0.05 - 1.0)
    assert cost([Outcome(100, 75, 100), Outcome(50, 150, 100)], 0.1, 3) == pytest.approx((0.025 - 1.0 + 0.1 - 0.5) / 2)
    with Rehearsal(plan(), None) as play:
        played = {period: play([{"name": "fixed", "period": period}], 2, "evolution")[0] for period in (4, 8)}
    assert [o.active for o in played[4]] == [3 * -(-o.cycles // 4) for o in played[4]]
    assert [o.active for o in played[8]] == [3 * -(-o.cycles // 8) for o in played[8]]


def test_what_is_active_is_what_the_body_is_charged():
    """With reading.active=released, a look that releases nothing costs nothing."""
    how = {"active": "released", "need_start": 0.0}
    with Rehearsal(RunPlan(config(max_cycles=100, curiosity="none", how=how)), None) as play:
        assert play([{"name": "fixed", "period": 4}], 1, "evolution")[0][0].active == 25  # AVOID's; 75 looks in all


def test_the_default_budget_and_the_learners():
    default, file = Evolution.Params(), conf_dir() / "generation" / "evolved_500.yaml"
    small = yaml.safe_load(file.read_text())["learner"]
    assert default.episodes == 20
    assert (small["generations"] + 1) * small["population"] * default.episodes == 500


@pytest.fixture
def straight(tmp_path):
    folder = tmp_path / "straight"
    folder.mkdir()
    return evolved(plan(), folder), (folder / JOURNAL).read_text()


def test_it_ends_no_worse_than_the_hand_set_start(straight):
    costs = costs_of(straight[1].splitlines())
    assert len(costs) == (SETTINGS["generations"] + 1) * SETTINGS["population"]
    with Rehearsal(plan(), None) as play:
        best = [[f["lowest_mc"], f["highest_mc"]] for f in straight[0].values()]
        genome = [g for f in straight[0].values() for g in (f["lowest_mc"], f["highest_mc"], log2(f["bend"]))]
        again = play([candidate(genome, play.behaviours)], SETTINGS["episodes"], "evolution")
        assert cost(again[0], params().look_cost, 3) == pytest.approx(min(costs), abs=1e-9)
    assert min(costs) < costs[0]  # the first candidate is the hand-set one
    assert all(1.0 <= period <= 12.0 for pair in best for period in pair)


def log2(x):
    from math import log2
    return log2(x)


def test_an_interrupted_evolution_ends_the_same(straight, tmp_path):
    lines = straight[1].splitlines()
    (tmp_path / JOURNAL).write_text("\n".join(lines[:9]) + "\n" + lines[9][:17])  # killed while writing
    assert evolved(plan(), tmp_path) == straight[0]
    rows = (tmp_path / JOURNAL).read_text().splitlines()
    assert rows[:9] == lines[:9] and costs_of(rows[10:]) == costs_of(lines[10:])


def test_the_journal_of_another_study_is_not_used(straight, tmp_path):
    (tmp_path / JOURNAL).write_text(straight[1].replace('"outcomes": [[', '"outcomes": [[9'))
    other = RunPlan(config(learner=SETTINGS, max_cycles=150, curiosity="none"))
    before = len(straight[1].splitlines())
    evolved(other, tmp_path)
    assert len((tmp_path / JOURNAL).read_text().splitlines()) == 2 * before


def test_a_run_uses_what_was_found(tmp_path):
    tables, _ = play_run(plan(), folder=tmp_path)
    found = yaml.safe_load((tmp_path / "evolved.yaml").read_text())["learner"]
    again, _ = play_run(RunPlan(config(learner=found, max_cycles=200, curiosity="none")))
    assert tables["episodes"]["active_cycles"] == again["episodes"]["active_cycles"]
    by_hand, _ = play_run(RunPlan(config(learner="monitor", max_cycles=200, curiosity="none")))
    assert tables["episodes"]["active_cycles"] != by_hand["episodes"]["active_cycles"]


@pytest.mark.long
def test_several_processes_find_the_same(straight):
    assert evolved(plan(), None, workers=2) == straight[0]
