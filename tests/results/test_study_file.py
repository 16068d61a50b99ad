"""A study's file: what was asked for, conditions and their names, growth by several commands."""

from __future__ import annotations

import json
import shutil
from concurrent.futures import ThreadPoolExecutor

import pytest
from hypothesis import given
from hypothesis import strategies as st

from attnlab.errors import ConfigError
from attnlab.results import load
from attnlab.tables.naming import name_all
from attnlab.tables.study import FILE, Condition, grow, read_study
from tests.report.small_study import write_study

SHORT = ("simulator=planar", "train_episodes=2", "validation_episodes=1", "max_cycles=60", "picture=false",
         "report=false")
CODE = {"version": "0", "commit": "", "dirty": False, "hash": "0"}


def condition(**settings):
    config = {"curiosity": {"name": "litman"}, "learner": {"name": "q_learning", "alpha": 0.8}}
    for name, value in settings.items():
        group, _, key = name.partition("__")
        config[group] = {**config[group], key or "name": value}
    return Condition(json.dumps(config, sort_keys=True), config, {})


def names(*conditions, labels=None):
    return name_all([(c.settings, c.config) for c in conditions], labels or {}).names


def test_names_say_what_sets_conditions_apart():
    assert names(condition()) == ["litman"]
    assert names(condition(), condition(curiosity="none"), labels={"litman": "CR", "none": "NCR"}) == ["CR", "NCR"]
    assert names(condition(), condition(learner__alpha=0.1)) == ["alpha=0.8", "alpha=0.1"]
    assert names(condition(), condition(learner="sarsa"), condition(learner="sarsa", curiosity="none")) == [
        "litman q_learning", "litman sarsa", "none sarsa"]


@given(st.lists(st.tuples(st.sampled_from(["litman", "none"]), st.sampled_from([0.1, 0.5]),
                          st.sampled_from(["q_learning", "sarsa"])), min_size=1, max_size=8, unique=True))
def test_names_are_unique(rows):
    found = names(*(condition(curiosity=c, learner__alpha=a, learner=name) for c, a, name in rows))
    assert len(set(found)) == len(rows)


def test_growing_keeps_what_was_there_and_renames_all(tmp_path):
    grow(tmp_path, ["one"], [(condition(), [("a", "k0", 0)])], {}, CODE, None)
    study = grow(tmp_path, ["two"], [(condition(), [("a", "k0", 0), ("b", "k1", 1)]),
                                     (condition(curiosity="none"), [("c", "k2", 0)])], {"none": "NCR"}, CODE, None)
    assert [c.name for c in study.conditions] == ["litman", "NCR"]
    assert [(r.name, r.condition, r.seed) for r in study.runs] == [("a", "litman", 0), ("b", "litman", 1),
                                                                   ("c", "NCR", 0)]
    assert [c["typed"] for c in study.commands] == [["one"], ["two"]]
    assert read_study(tmp_path) == study


def test_a_label_names_one_value_the_one_it_was_given_last(tmp_path):
    grow(tmp_path, [], [(condition(), [("a", "k0", 0)])], {"litman": "CR"}, CODE, None)
    study = grow(tmp_path, [], [(condition(curiosity="none"), [("b", "k1", 0)])], {"none": "CR"}, CODE, None)
    assert study.labels == {"none": "CR"} and [c.name for c in study.conditions] == ["litman", "CR"]


def test_many_commands_grow_a_study_at_once(tmp_path):
    def one(i):
        grow(tmp_path, [f"seed={i}"], [(condition(), [(f"r{i}", f"k{i}", i)])], {}, CODE, None)
    with ThreadPoolExecutor(8) as pool:
        list(pool.map(one, range(40)))
    study = read_study(tmp_path)
    assert sorted(run.seed for run in study.runs) == list(range(40))
    assert len(study.commands) == 40 and len(study.conditions) == 1


def test_two_processes_grow_a_study_at_once(tmp_path, attnlab):
    with ThreadPoolExecutor(2) as pool:
        done = list(pool.map(lambda seeds: attnlab("curiosity=litman,none", f"seed={seeds}", *SHORT), ("0", "1-2")))
    assert [d.returncode for d in done] == [0, 0], done
    study = load(tmp_path / "outputs" / "main")
    assert len(study.complete) == 6 and len(study.file.commands) == 2


def test_what_was_asked_for_and_never_started_is_missing(tmp_path):
    study = write_study(tmp_path / "half", seeds=2)
    file = load(study).file
    kept = [(c, [(r.name, r.key, r.seed) for r in file.runs if r.condition == c.name]) for c in file.conditions]
    kept[0][1].append(("litman-seed2-new", "new", 2))
    grow(study, ["seed=0-2"], kept, {}, CODE, None)
    runs = load(study).runs.set_index("run")
    assert runs.loc["litman-seed2-new", ["status", "seed", "condition"]].tolist() == ["missing", 2, "litman"]
    assert (runs["status"] == "complete").sum() == 4


def test_a_copied_run_counts_once(tmp_path):
    study = write_study(tmp_path / "twice", seeds=2)
    shutil.copytree(study / "none-seed0", study / "zz-copy")
    found = load(study)
    assert len(found.complete) == 4 and len(found.episodes) == 4 * 24
    assert found.runs.set_index("run").loc["zz-copy", "status"] == "not asked for"


def test_frames_say_study_and_condition(tmp_path):
    for name in ("one", "two"):
        write_study(tmp_path / name, seeds=1, labels={"litman": "CR"})
    both = load(tmp_path / "one", tmp_path / "two")
    for table in ("episodes", "behaviours", "policy", "cycles", "coverage", "runs"):
        frame = getattr(both, table)
        assert set(frame["study"]) == {"one", "two"} and set(frame["condition"]) == {"CR", "none"}, table
    assert len(both.episodes) == 2 * len(load(tmp_path / "one").episodes)
    with pytest.raises(AttributeError, match="several studies have episodes"):
        both.complete  # noqa: B018


def test_a_folder_of_studies_is_none(tmp_path):
    write_study(tmp_path / "outputs" / "one", seeds=1)
    with pytest.raises(ConfigError, match="is no study but holds some. Name one: one"):
        load(tmp_path / "outputs")
    with pytest.raises(ConfigError, match="is one run of a study"):
        load(tmp_path / "outputs" / "one" / "none-seed0")


def test_variants_that_grow_are_three_conditions(here, tmp_path):
    two = "a:{reading.need_k:1},b:{reading.need_k:2}"
    assert here(f"variants={{{two}}}", *SHORT).returncode == 0
    done = here(f"variants={{{two},c:{{reading.need_k:3}}}}", *SHORT)
    assert done.returncode == 0 and "2 of 3 runs are complete already" in done.stdout, done.stdout + done.stderr
    study = load(tmp_path / "outputs" / "main")
    assert [c.name for c in study.file.conditions] == ["a", "b", "c"]
    assert list(dict.fromkeys(study.episodes["condition"])) == ["a", "b", "c"]
    rows = [line.split()[0] for line in done.stdout.splitlines() if line.startswith((" a ", " b ", " c "))]
    assert rows[:3] == ["a", "b", "c"]  # columns that do not fit beside them are below


@pytest.mark.parametrize(("typed", "says"), [
    ("variants={a:{reading.need_k:1},b:{reading.need_k:1}}", "variants.b: is the same as a"),
    ("learner.alpha=0.1,0.1", "asks twice for the run")])
def test_the_same_run_twice_is_refused(complain, typed, says):
    code, err, written = complain(typed, *SHORT)
    assert code == 2 and says in err and written == []


def test_a_resume_under_other_code_is_marked(here, tmp_path):
    assert here("seed=0-1", *SHORT).returncode == 0
    file = sorted(tmp_path.glob("outputs/main/*/run.json"))[0]
    about = json.loads(file.read_text())
    assert about["code"] == json.loads((tmp_path / "outputs/main" / FILE).read_text())["code"]
    about["code"]["hash"] = "elsewhere"
    file.write_text(json.dumps(about))
    again = here("seed=0-1", *SHORT)
    assert "nothing to run" in again.stdout
    assert "mind: 1 of the complete runs were made by other code" in again.stderr and "fresh=true" in again.stderr
    page = here("main", module="attnlab.report")
    assert "the runs were made by 2 versions of the code" in page.stdout


def test_the_page_says_what_was_typed(here, tmp_path):
    assert here("+experiment=cr_vs_ncr", "seed=0-1", *SHORT).returncode == 0
    assert here("main", "--quiet", module="attnlab.report").returncode == 2
    assert here("cr_vs_ncr", "--quiet", module="attnlab.report").returncode == 0
    page = (tmp_path / "outputs/cr_vs_ncr/report/index.html").read_text()
    assert f"python -m attnlab +experiment=cr_vs_ncr seed=0-1 {' '.join(SHORT)}" in page


def test_a_study_without_a_file_is_read_and_grows(here, tmp_path):
    assert here("curiosity=litman,none", *SHORT).returncode == 0
    folder = tmp_path / "outputs" / "main"
    before = load(folder).episodes
    (folder / FILE).unlink()
    assert load(folder).episodes.equals(before)
    done = here("curiosity=litman,none", "seed=0-1", *SHORT)
    assert "2 of 4 runs are complete already" in done.stdout
    assert [c.name for c in read_study(folder).conditions] == ["litman", "none"]
    assert len(load(folder).complete) == 4


@pytest.mark.parametrize("text", ["", "[]", '{"schema": 1}', '{"schema": 99}', '{"schema": 1, "runs": 5}'])
def test_a_broken_file_is_no_file(tmp_path, text):
    study = write_study(tmp_path / "broken", seeds=1)
    (study / FILE).write_text(text)
    assert len(load(study).complete) == 2
