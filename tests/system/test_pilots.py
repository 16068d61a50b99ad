"""Sound readings first: what pilots decide, that it is decided once, and what cannot be."""

from __future__ import annotations

import csv
import json

import pytest

from attnlab.errors import ConfigError
from attnlab.launch.multiverse import confounded, design_levels, load_factors
from attnlab.launch.pilots import judged, take
from attnlab.launch.variants import Pilot, read_design, read_variants
from attnlab.tables.readings import Decided, Tried, read_decided, write_decided

CONDITIONS = {"CR": {"curiosity": "litman", "reading.non_curious": "plain"},
              "plain": {"curiosity": "none", "reading.non_curious": "plain"}}
FACTORS = """
period: {x: {reading.reward_period: elapsed}, y: {reading.reward_period: chosen}}
k: {x: {reading.need_k: 1}, y: {reading.need_k: 2}}
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
    assert list(found.settings) == ["r0", "r1", "r2", "r3"] and found.size == 2
    assert list(found.variants(["r3"])) == ["r3 CR", "r3 plain"]
    assert found.variants(["r1"], ["plain"]) == {"r1 plain": {**found.settings["r1"], **CONDITIONS["plain"]}}


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


SHORT = ("-m", "simulator=planar", "train_episodes=1", "validation_episodes=1", "max_cycles=60", "picture=false",
         "report=false", "study=mine", "engine=python")


def command(tmp_path, seeds="0-1", **pilot):
    path = tmp_path / "points.yaml"
    path.write_text(FACTORS)
    said = {"seeds": 1000, "episodes": 1, "survival": 0, "candidates": 4, **pilot}
    text = ",".join(f"{name}:{value}" for name, value in said.items())
    conditions = ",".join(f"{name}:{{curiosity:{of['curiosity']},reading.non_curious:plain}}"
                          for name, of in CONDITIONS.items())
    return (*SHORT, f"seed={seeds}", f"variants={{design:multiverse,size:2,factors:['{path}'],"
            f"conditions:{{{conditions}}},pilot:{{{text}}}}}")


def test_from_pilots_to_the_study_and_on(here, tmp_path, monkeypatch):
    """Two of four readings are sound, say the planted pilots; whoever comes again takes the same two."""
    from attnlab.launch import pilots
    monkeypatch.setattr(pilots, "judged", lambda name, levels, folders, pilot: Tried(
        name, levels, 95.0, 1, 1, "" if name in ("r1", "r3") else "nobody eats"))
    done = here(*command(tmp_path))
    assert done.returncode == 0, done.stderr
    folder = tmp_path / "outputs" / "mine"
    assert "mine_pilots: r2 to r3; 1 of 2 before them are sound" in done.stdout
    assert "2 of 4 readings are sound (plain survives more than 0 % of 1 training episodes" in done.stdout
    study = json.loads((folder / "study.json").read_text())
    assert [c["name"] for c in study["conditions"]] == ["r1 CR", "r1 plain", "r3 CR", "r3 plain"]
    assert len(study["runs"]) == 8 and {run["seed"] for run in study["runs"]} == {0, 1}
    pilot_runs = json.loads((tmp_path / "outputs" / "mine_pilots" / "study.json").read_text())["runs"]
    assert [run["condition"] for run in pilot_runs] == [f"r{i} plain" for i in range(4)]
    assert {run["seed"] for run in pilot_runs} == {1000}

    monkeypatch.setattr(pilots, "judged", None)  # never asked again
    again = here(*command(tmp_path, seeds="0-2"))
    assert again.returncode == 0, again.stderr
    assert "2 readings, as decided by pilots (readings.json)" in again.stdout
    assert "8 of 12 runs are complete already" in again.stdout
    other = here(*command(tmp_path, survival=50))
    assert other.returncode == 2 and "was decided by other pilots, or another rule" in other.stderr


@pytest.mark.parametrize(("more", "says"), [
    ({"seeds": "0"}, "seed: is one, and one seed cannot tell an effect from chance"),
    ({"seeds": "999-1000"}, "variants.pilot.seeds: 1000 takes part in the study, too"),
    ({"survival": 100}, "variants.pilot: none of 4 readings is sound (plain survives more than 100 % of")])
def test_a_multiverse_that_cannot_be(here, tmp_path, more, says):
    done = here(*command(tmp_path, **({"seeds": "0-1", **more} if "seeds" in more else more)))
    assert done.returncode == 2 and done.stderr.splitlines()[-1].startswith(f"attnlab: {says}"), done.stderr
    assert not (tmp_path / "outputs" / "mine").exists()
