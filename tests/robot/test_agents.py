"""A robot that has learned is kept with its run, and goes on in others."""

from __future__ import annotations

import json
import shutil

import pytest

from attnlab.config import run_key
from attnlab.errors import ConfigError
from attnlab.robot.agents import pinned, saved
from attnlab.robot.episodes import play_run
from attnlab.robot.plan import RunPlan
from attnlab.tables.files import mark_of, read_json
from attnlab.tables.study import condition_key
from attnlab.testing import config
from tests.robot.stored import store


@pytest.fixture(scope="module")
def home(tmp_path_factory):
    return store(tmp_path_factory.mktemp("agents") / "run")


def learned(plan):
    agent = plan.parts_alone()
    return {a.behaviour.name: (a.learner.q, a.learner.visits) for a in agent.attentions}


def test_a_robot_has_what_the_policy_table_says_and_the_streams(home):
    tables, _ = play_run(RunPlan(config()))
    again = RunPlan(config(start_from=str(home)))
    q = [value for q, _ in learned(again).values() for row in q for value in row]
    visits = [value for _, visits in learned(again).values() for row in visits for value in row]
    assert q == tables["policy"]["q"] and visits == tables["policy"]["visits"] and sum(visits) > 0
    fresh, other = RunPlan(config()), RunPlan(config(start_from=str(home), seed=1))
    draws = [plan.parts_alone().attentions[0].draw.random() for plan in (fresh, again, other, RunPlan(config(seed=1)))]
    assert draws[0] != draws[1] and draws[2] == draws[3]  # of another seed the streams are its own
    assert learned(other) == learned(again)


def test_its_file_is_marked_and_the_same_wherever_it_is_made(home, tmp_path):
    about = read_json(home / "run.json")
    data = (home / "agent.json").read_bytes()
    assert about["agent"] == mark_of(data)
    assert (store(tmp_path / "elsewhere") / "agent.json").read_bytes() == data


def test_without_learning_it_lives_as_in_its_own_validation(tmp_path):
    """AVOID draws nothing, and in validation nothing is learned: these are the same episodes."""
    how = {"behaviours": ("avoid",), "curiosity": "none", "validation_episodes": 3, "train_episodes": 4}
    folder = store(tmp_path / "run", **how)
    tables, _ = play_run(RunPlan(config(**{**how, "train_episodes": 0}, start_from=str(folder))))
    first = play_run(RunPlan(config(**how)))[0]["episodes"]
    assert set(tables["episodes"]["phase"]) == {"validation"}
    for name in set(first) - {"run"}:
        assert tables["episodes"][name] == first[name][4:], name


@pytest.mark.parametrize("how", [
    {"learner": {"name": "evolution", "generations": 1, "population": 5, "episodes": 1}, "curiosity": "none"},
    {"learner": "timing"}, {"learner": "expected_sarsa"}, {"learner": "bandwidth"}, {"curiosity": "habituation"},
    {"exploration": "annealed"}], ids=str)
def test_what_others_have_learned_goes_on_too(tmp_path, how):
    """Also what was found offline: it is not looked for again."""
    folder = store(tmp_path / "run", **how)
    plan = RunPlan(config(**how, train_episodes=0, start_from=str(folder)))
    tables, _ = play_run(plan)
    stored, _ = play_run(RunPlan(config(**how)), folder=tmp_path)
    assert tables["policy"]["q"] == stored["policy"]["q"]
    before = [tuple(getattr(a.learner, "_actions", ())) for a in plan.parts_alone().attentions]
    assert "evolution" not in str(how) or before != [tuple(a.learner._actions) for a in plan.newborn().attentions]


def test_settings_that_differ_are_those_of_the_new_run(home):
    learner = RunPlan(config(learner={"name": "q_learning", "gamma": 0.5}, start_from=str(home))
                      ).parts_alone().attentions[0].learner
    assert learner.params.gamma == 0.5 and set(learner._discount) == {0.5}


def test_another_curiosity_of_the_same_levels_begins_with_its_own_memory(home):
    plan = RunPlan(config(curiosity="count", start_from=str(home)))
    assert learned(plan)["avoid"][0] == learned(RunPlan(config(start_from=str(home))))["avoid"][0]
    assert plan.parts_alone().attentions[0].memory == [0] * plan.reading.percept_bins


@pytest.mark.parametrize(("how", "says"), [
    ({"behaviours": ("avoid", "eat")}, "has the behaviours avoid, eat, drink, this run avoid, eat"),
    ({"periods": [1, 4, 8]}, "has the periods 1, 4, 8, 12, this run 1, 4, 8"),
    ({"curiosity": "none"}, "has the levels low, LH, HH, this run none"),
    ({"how": {"percept_bins": 7}}, "has the bins 6, this run 7"),
    ({"learner": "sarsa"}, "has the learner q_learning, this run sarsa")])
def test_a_run_of_another_robot_is_refused(home, how, says):
    with pytest.raises(ConfigError, match=says) as refused:
        RunPlan(config(**how, start_from=str(home)))
    assert str(refused.value).startswith("start_from: ") and len(str(refused.value).splitlines()) == 1


def test_what_is_no_robot_is_refused(home, tmp_path):
    def refused(text, says):
        with pytest.raises(ConfigError, match=says):
            saved(text)
    refused(str(tmp_path), "is no complete run")
    refused(f"{home}#0123456789abcdef", "is not the one that was named")
    copy = shutil.copytree(home, tmp_path / "copy")
    whole = (copy / "agent.json").read_text()
    (copy / "agent.json").write_text(whole.replace('"seed":0', '"seed":1'))
    refused(str(copy), "is not what its run wrote")
    (copy / "agent.json").unlink()
    refused(str(copy), "was made before robots were kept")
    content = json.loads(whole)
    for wrong in ({"state": {"avoid/learner": {"is": "os:_exit", "has": {}}}},
                  {"state": {"avoid/learner": {**content["state"]["avoid/learner"], "has": {"q": {"same": "x.y"}}}}},
                  {"state": {"avoid/choices": {"random": "AAAA", "gauss": None}}}):
        data = json.dumps({**content, **wrong}).encode()
        (copy / "agent.json").write_bytes(data)
        about = read_json(copy / "run.json")
        (copy / "run.json").write_text(json.dumps({**about, "agent": mark_of(data)}))
        with pytest.raises(ConfigError, match="the robot of .* is another: "):
            RunPlan(config(start_from=str(copy)))


def test_it_is_in_the_key_by_what_it_is(home, tmp_path):
    plain, copy = config(), shutil.copytree(home, tmp_path / "copy")
    one, two = (pinned({**plain, "start_from": str(folder)}) for folder in (home, copy))
    assert one["start_from"].endswith(f"#{saved(str(home)).mark}") and pinned(one) == one
    for key in (run_key, condition_key):
        assert key(one) == key(two) != key(plain) == key({**plain, "start_from": None})


def test_on_the_command_line(here, home, tmp_path):
    short = ("simulator=planar", "train_episodes=0", "validation_episodes=2", "max_cycles=120", "picture=false",
             "report=false", "record=all")
    done = here(f"start_from={home}", "world=open,cluttered", *short)
    assert done.returncode == 0, done.stderr
    runs = sorted((tmp_path / "outputs" / "main").glob("*/run.json"))
    assert [read_json(file)["status"] for file in runs] == ["complete"] * 2
    again = here(str(runs[0].parent), module="attnlab.rerun")
    assert again.stdout == "the same bytes\n", again
    replayed = here(str(runs[0].parent), "--episode", "1", module="attnlab.replay")
    assert replayed.returncode == 0 and "no longer lives" not in (runs[0].parent / "replay.html").read_text()
    code = here("train_episodes=0", *short[2:])
    assert code.returncode == 2 and "train_episodes: is 0, must be at least 1" in code.stderr
