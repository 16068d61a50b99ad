"""Sound readings first: what pilots decide, that it is decided once, and what cannot be."""

from __future__ import annotations

import csv
import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import pytest
import yaml

from attnlab.errors import ConfigError
from attnlab.launch import pilots
from attnlab.launch.multiverse import confounded, design_levels, load_factors
from attnlab.launch.pilots import judged, take
from attnlab.launch.variants import Pilot, read_design, read_variants
from attnlab.tables.readings import Decided, Tried, read_decided, write_decided

ROOT = Path(__file__).resolve().parents[2]
CONDITIONS = {"CR": {"curiosity": "litman", "reading.non_curious": "plain"},
              "plain": {"curiosity": "none", "reading.non_curious": "plain"}}
FACTORS = """
period: {x: {reading.reward_period: elapsed}, y: {reading.reward_period: chosen}}
k: {x: {reading.need_k: 1}, y: {reading.need_k: 2}}
window: {a: {reading.novelty_window: 5}, b: {reading.novelty_window: 6}, c: {reading.novelty_window: 7}}
"""


@pytest.mark.parametrize(("survival", "meals", "drinks", "reason"), [
    ([[1.0, 0.9], [0.9, 0.9]], [[0, 1], [0, 0]], [[1, 0], [0, 0]], ""),  # 92.5 %
    ([[0.9, 0.9], [0.9, 0.9]], [[0, 1], [0, 0]], [[1, 0], [0, 0]], "survives 90.00 %"),  # above 90, not at it
    ([[1.0, 1.0], [1.0, 1.0]], [[0, 0], [0, 0]], [[1, 0], [0, 0]], "nobody eats"),
    ([[0.2, 0.4], [0.2, 0.4]], [[0, 3], [0, 0]], [[0, 0], [0, 0]], "survives 30.00 %; nobody drinks")])
def test_a_reading_by_planted_pilots(tmp_path, survival, meals, drinks, reason):
    import pyarrow as pa
    import pyarrow.parquet as pq
    folders = []
    for i, columns in enumerate(zip(survival, meals, drinks, strict=True)):
        folders.append(tmp_path / str(i))
        folders[-1].mkdir()
        pq.write_table(pa.table(dict(zip(("survival", "meals", "drinks"), columns, strict=True))),
                       folders[-1] / "episodes.parquet")
    found = judged("r0", {"k": "x"}, folders, Pilot())
    assert found.reason == reason
    assert found.survival == pytest.approx(100 * sum(map(sum, survival)) / 4)
    assert (found.meals, found.drinks) == (sum(map(sum, meals)), sum(map(sum, drinks)))


def planted(reasons, levels):
    return Decided("mark", "a rule", 9, [Tried(f"r{i}", of, 95.0, 1, 1, reason)
                                         for i, (reason, of) in enumerate(zip(reasons, levels, strict=True))])


def test_the_first_sound_ones_are_taken_and_their_balance_is_told(tmp_path):
    levels = [{"a": "x", "b": "u"}, {"a": "y", "b": "v"}, {"a": "x", "b": "u"}, {"a": "y", "b": "v"},
              {"a": "x", "b": "v"}]
    decided = planted(["", "nobody eats", "", "", ""], levels)
    take(decided, 3)
    assert decided.taken == ["r0", "r2", "r3"] and decided.sound == 4
    assert decided.counts == {"a": {"x": 2, "y": 1}, "b": {"u": 2, "v": 1}}
    assert decided.confounded == ("a", "b", pytest.approx(1.0))  # x is always with u, y with v
    assert decided.uneven == pytest.approx(2 - 3 / 4)
    write_decided(tmp_path, decided)
    assert read_decided(tmp_path) == decided
    rows = list(csv.DictReader((tmp_path / "readings.csv").read_text().splitlines()))
    assert [row["taken"] for row in rows] == ["yes", "no", "yes", "yes", "no"]
    assert [row["reason"] for row in rows] == ["", "nobody eats", "", "", "sound, and not needed"]
    assert rows[1]["a"] == "y"
    take(nobody := planted(["nobody eats"] * 5, levels), 3)
    assert nobody.taken == [] and nobody.counts == {}


def test_confounded_is_cramers_v():
    import numpy as np
    table = np.array([[0, 0, 0], [0, 1, 0], [1, 0, 1], [1, 1, 1]])
    assert confounded(table) == (0, 2, pytest.approx(1.0))
    assert confounded(table[:, :2]) == (0, 0, 0.0)
    assert confounded(table[:2]) == (0, 0, 0.0)  # columns of one level tell nothing


def node(tmp_path, **changed):
    (tmp_path / "points.yaml").write_text(FACTORS)
    return {"design": "multiverse", "size": 2, "factors": [str(tmp_path / "points.yaml")], "conditions": CONDITIONS,
            "pilot": {"seeds": "1000", "episodes": 2, "survival": 0, "candidates": 4}, **changed}


def test_candidates_are_named_once_for_all(tmp_path):
    found = read_design(node(tmp_path))
    assert list(found.settings) == ["r000", "r001", "r002", "r003"] and found.size == 2
    assert list(found.variants(["r003"])) == ["r003 CR", "r003 plain"]
    assert found.variants(["r001"], ["plain"]) == {"r001 plain": {**found.settings["r001"], **CONDITIONS["plain"]}}


def test_more_candidates_leave_the_first_as_they_are(tmp_path):
    few, many = (read_design(node(tmp_path, factors="places", pilot={"candidates": count})) for count in (5, 17))
    assert list(few.levels.items()) == list(many.levels.items())[:5]
    assert len(many.levels) == 6 == len({tuple(of.values()) for of in many.levels.values()})  # all there are, once
    with pytest.raises(ConfigError, match="variants.size: is 7, and the factors make 6 different readings"):
        read_design(node(tmp_path, factors="places", size=7, pilot={"candidates": 28}))


def test_candidates_come_in_balanced_blocks(tmp_path):
    many = list(read_design({"design": "multiverse", "size": 3, "conditions": CONDITIONS,
                             "pilot": {"candidates": 24}}).levels.values())
    for block in (many[:12], many[12:]):  # of four times the readings that are asked for
        assert [of["crash"] for of in block].count("contact") == 6
        assert [of["need_k"] for of in block].count("3") == 4


@pytest.mark.parametrize(("changed", "says"), [
    ({"pilot": {"condition": "plane"}}, "variants.pilot.condition: no condition is called 'plane'. Did you mean"),
    ({"pilot": {"candidates": 2}, "size": 3}, "variants.pilot.candidates: is 2, fewer than the 3"),
    ({"pilot": {"sedes": "1"}}, "variants.pilot.sedes: no such setting. Did you mean 'seeds'"),
    ({"pilot": {"seeds": "9-1"}}, "variants.pilot.seeds: 9-1 runs backwards"),
    ({"pilot": {"survival": 101}}, "variants.pilot.survival: is 101.0 %, must be at most 100 %"),
    ({"pilot": 3}, "variants.pilot: expected settings by name")])
def test_bad_pilots(tmp_path, changed, says):
    with pytest.raises(ConfigError) as caught:
        read_variants(node(tmp_path, **changed))
    assert str(caught.value).startswith(says)


def test_levels_that_contradict_each_other_are_named_both(tmp_path):
    path = tmp_path / "points.yaml"
    path.write_text("well: {low: {reading.energy_well: 10}, high: {reading.energy_well: 4599}}\n"
                    "max: {low: {reading.energy_max: 4000}, high: {reading.energy_max: 5000}}")
    with pytest.raises(ConfigError, match="well=high and max=low contradict each other: reading.energy_well: is 4599"):
        design_levels(load_factors(path), 8, 0)


def test_a_factor_of_two_files(tmp_path):
    for name, setting in (("a", "reading.need_k"), ("b", "reading.need_start")):
        (tmp_path / f"{name}.yaml").write_text(f"k: {{x: {{{setting}: 1}}, y: {{{setting}: 2}}}}")
    with pytest.raises(ConfigError, match="'k' is a factor of two of these files"):
        load_factors([tmp_path / "a.yaml", tmp_path / "b.yaml"])


class Jobs:
    """Stands in for the expansion of a sweep: a job a variant and seed, whose key is what it is of."""

    def __init__(self, home, seeds=(0, 1), swept=("seed",), fresh=False):
        self.home, self.seeds, self.swept, self.fresh = home, list(seeds), list(swept), fresh

    def jobs(self, variants, also=None, seeds=None):
        study = (also or {}).get("study", "mine")
        return [SimpleNamespace(key=f"{name} {seed}", folder=self.home / study / f"{name} {seed}",
                                settings=SimpleNamespace(seed=seed, fresh=self.fresh, study=study))
                for name in variants for seed in seeds or self.seeds]


@pytest.fixture
def decide(tmp_path, monkeypatch):
    """Decide on planted pilots, of which those of the named readings are sound; (readings taken, pilots run)."""
    def call(sound=(), candidates=4, survival=0, size=2, failed=(), **asked):
        ran = []

        def complete(jobs, typed):
            ran.extend(job.key for job in jobs)
            return list(failed)
        monkeypatch.setattr(pilots, "complete", complete)
        monkeypatch.setattr(pilots, "judged", lambda name, levels, folders, pilot: Tried(
            name, levels, 95.0, 1, 1, "" if name in sound else "nobody eats"))
        design = read_design(node(tmp_path, size=size, pilot={
            "seeds": "1000", "episodes": 2, "survival": survival, "candidates": candidates}))
        return pilots.sound(design, Jobs(tmp_path, **asked), []), ran
    monkeypatch.setattr(pilots, "check_once", lambda jobs: None)
    monkeypatch.setattr(pilots, "check_place", lambda jobs: None)
    return call


def test_decided_once(decide, tmp_path, capsys):
    taken, ran = decide(sound=["r001", "r003"])
    assert taken == ["r001", "r003"] and ran == [f"r00{i} plain 1000" for i in range(4)]
    said = capsys.readouterr().out
    assert "mine_pilots: r002 to r003; 1 of 2 before them are sound" in said
    assert "2 of 4 readings are sound (plain survives more than 0 % of 2 training episodes, mean of seeds 1000" in said
    # whoever comes again takes the same, whatever a pilot would say now; more seeds are no other study
    assert decide(sound=["r000"], seeds=(0, 1, 2)) == (["r001", "r003"], [])
    assert "2 readings, as decided by pilots (readings.json)" in capsys.readouterr().out
    assert decide(sound=["r001", "r003"], candidates=6) == (["r001", "r003"], [])  # no more are needed
    with pytest.raises(ConfigError, match=r"readings.json was decided by other pilots, or another rule"):
        decide(survival=50)
    assert decide(sound=["r000", "r002"], fresh=True)[0] == ["r000", "r002"]


def test_no_more_are_tried_than_needed(decide, tmp_path):
    taken, ran = decide(sound=["r000", "r001"])
    assert taken == ["r000", "r001"] and ran == ["r000 plain 1000", "r001 plain 1000"]
    assert len(read_decided(tmp_path / "mine").tried) == 2


def test_who_ran_out_of_candidates_may_have_more(decide, tmp_path):
    taken, _ = decide(sound=["r000", "r003"], size=3)
    assert taken == ["r000", "r003"]
    taken, ran = decide(sound=["r000", "r003", "r006"], size=3, candidates=12)
    assert taken == ["r000", "r003", "r006"]  # those that were there stay
    assert ran == ["r004 plain 1000", "r005 plain 1000", "r006 plain 1000"]
    assert decide(size=3, candidates=12) == (taken, [])
    with pytest.raises(ConfigError, match="decided by other pilots"):
        decide(size=3, candidates=4)  # fewer than were tried


@pytest.mark.parametrize(("asked", "says"), [
    ({"seeds": (0,)}, "seed: is one, and one seed cannot tell an effect from chance"),
    ({"seeds": (999, 1000)}, "variants.pilot.seeds: 1000 takes part in the study, too"),
    ({"swept": ("seed", "max_cycles")}, "max_cycles: cannot be swept beside variants.pilot"),
    ({}, "variants.pilot: none of 4 readings is sound (plain survives more than 0 % of"),
    ({"sound": ["r002"]}, "variants.pilot: 1 of 4 readings is sound")])
def test_a_multiverse_that_cannot_be(decide, tmp_path, asked, says):
    with pytest.raises(ConfigError) as caught:
        decide(**asked)
    assert str(caught.value).startswith(says)
    assert not (tmp_path / "mine").exists()


def test_a_study_that_began_without_pilots(decide, tmp_path):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "study.json").write_text("{}")
    with pytest.raises(ConfigError, match="was begun without pilots"):
        decide(sound=["r000", "r001"])


def test_pilots_that_failed_decide_nothing(decide, tmp_path):
    with pytest.raises(pilots.UndecidedError, match="2 pilots failed"):
        decide(sound=["r000", "r001"], failed=[1, 2])
    assert not (tmp_path / "mine").exists()


def test_what_is_declared_is_what_the_docs_say():
    text = (ROOT / "docs" / "claims.md").read_text()
    told = next(found for block in re.findall(r"```yaml\n(.*?)```", text, re.S)
                if "pilot" in (found := yaml.safe_load(block).get("variants") or {}))
    declared = yaml.safe_load((ROOT / "conf" / "experiment" / "multiverse.yaml").read_text())["variants"]
    assert {name: told[name] for name in ("size", "factors", "pilot")} == \
        {name: declared[name] for name in ("size", "factors", "pilot")}


SHORT = ("-m", "simulator=planar", "picture=false", "report=false", "study=mine", "seed=0-1")


def variants(tmp_path, episodes, size, candidates):
    """What is typed for a multiverse of two factors, all of whose readings are sound in which somebody eats."""
    path = tmp_path / "points.yaml"
    path.write_text(FACTORS)
    conditions = ",".join(f"{name}:{{curiosity:{of['curiosity']},reading.non_curious:plain}}"
                          for name, of in CONDITIONS.items())
    return (f"variants={{design:multiverse,size:{size},factors:['{path}'],conditions:{{{conditions}}},"
            f"pilot:{{seeds:1000,episodes:{episodes},survival:0,candidates:{candidates}}}}}")


def test_from_pilots_to_the_study(here, tmp_path, monkeypatch):
    monkeypatch.setattr(pilots, "judged", lambda name, levels, folders, pilot: Tried(
        name, levels, 95.0, 1, 1, "" if name != "r000" and folders[0].is_dir() else "nobody eats"))
    done = here(*SHORT, variants(tmp_path, 1, 2, 4), "train_episodes=1", "validation_episodes=0", "max_cycles=30",
                "engine=python")
    assert done.returncode == 0, done.stderr
    study = json.loads((tmp_path / "outputs" / "mine" / "study.json").read_text())
    assert [c["name"] for c in study["conditions"]] == ["r001 CR", "r001 plain", "r002 CR", "r002 plain"]
    assert len(study["runs"]) == 8 and {run["seed"] for run in study["runs"]} == {0, 1}
    runs = json.loads((tmp_path / "outputs" / "mine_pilots" / "study.json").read_text())["runs"]
    assert {run["seed"] for run in runs} == {1000} and len(runs) == 4
    assert [run["condition"] for run in runs] == [f"r00{i} plain" for i in range(4)]


@pytest.mark.long
def test_killed_and_gone_on_with_is_the_same(tmp_path):
    """SIGKILL among the pilots and again among the runs; tables, readings and the study are those of one go."""
    typed = [*SHORT, variants(tmp_path, 30, 3, 8), "train_episodes=20", "validation_episodes=5"]

    def begin(outputs):
        return subprocess.Popen([sys.executable, "-m", "attnlab", *typed, f"outputs={outputs}"], cwd=tmp_path,
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True,
                                env={**os.environ, "PYTHONPATH": str(ROOT)})

    def kill_at(study, count):
        process = begin(tmp_path / "killed")
        while process.poll() is None and len(list((tmp_path / "killed" / study).glob("*/coverage.parquet"))) < count:
            time.sleep(0.02)
        os.killpg(process.pid, signal.SIGKILL)
        return process.wait()
    assert kill_at("mine_pilots", 2) == -signal.SIGKILL
    assert not (tmp_path / "killed" / "mine").exists()
    assert kill_at("mine", 4) == -signal.SIGKILL
    assert begin(tmp_path / "killed").wait() == 0 and begin(tmp_path / "whole").wait() == 0
    whole = {str(file.relative_to(tmp_path / "whole")): file.read_bytes() for pattern in
             ("*/*/*.parquet", "mine/readings.*") for file in (tmp_path / "whole").glob(pattern)}
    assert len(whole) >= 5 * (3 + 12) + 2
    for name, data in whole.items():
        assert (tmp_path / "killed" / name).read_bytes() == data, name
    pages = [page(tmp_path / outputs / "mine") for outputs in ("killed", "whole")]
    assert pages[0] == pages[1]


def page(study):
    """The study's page but for its provenance and where it is, and every table beside it."""
    from attnlab.report import build_report
    from attnlab.report.page import PROVENANCE
    text = build_report(study, quiet=True).read_text().replace(str(study.parent), "outputs")
    head, _, rest = text.partition(PROVENANCE[0])
    tables = {file.name: file.read_bytes() for file in sorted((study / "report").glob("*.csv"))}
    assert {"verdicts.csv", "seeds.csv", "combinations.csv"} <= set(tables)
    return head + rest.partition(PROVENANCE[1])[2], tables
