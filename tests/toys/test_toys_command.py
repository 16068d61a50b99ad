"""The table of toys, the verdicts on it, and the command."""

import csv
import io
import json

import pytest

from attnlab.claims.findings import Finding
from attnlab.measures.toys import ToyRuns
from attnlab.results.conditions import Runs
from attnlab.testing import make
from attnlab.toys.__main__ import main
from attnlab.toys.table import as_csv, claims, judged, read, tasks

NOISE = (-0.03, -0.02, -0.01, 0.0, 0.01, 0.02, 0.03, 0.0)


def planted(side):
    """A table in which every comparison that counts comes out as claimed (side 1), or the other way round (-1)."""
    told = {}
    for of in claims().values():
        for claim in of.claims.values():
            for part in claim.parts:
                name = part.node["quantity"]
                way = -side if part.direction == "lower" else side
                for role, level in zip(part.roles, (way, 0), strict=False):
                    where = of.roles[role].where
                    key = (where["variant"], where.get("learner", "fixed"))
                    base = 0.05 + way if part.test == "level" else 50.0 + level * 40
                    for seed, noise in enumerate(NOISE):
                        told.setdefault(key, {}).setdefault(seed, {}).setdefault(name, base + noise)
    return told


@pytest.mark.parametrize(("side", "finding"), [(1, None), (-1, Finding.CONTRADICTED)])
def test_a_planted_truth_is_found(side, finding):
    for verdicts in judged(planted(side)).values():
        for verdict in verdicts:
            assert verdict.verdict is finding if finding else verdict.holds, (verdict.id, verdict.reason)


def test_who_did_not_play_is_untestable():
    told = planted(1)
    del told["cliff", "tempo_rl"]
    found = {verdict.id: verdict for verdict in judged(told)["temporl"]}
    assert found["cliff_sooner"].verdict is Finding.UNTESTABLE and "no complete run" in found["cliff_sooner"].reason
    assert found["bridge_sooner"].holds
    told = {key: {seed: of for seed, of in seeds.items() if seed < 5} for key, seeds in planted(1).items()}
    assert {verdict.verdict for found in judged(told).values() for verdict in found} == {Finding.UNTESTABLE}


def test_every_role_is_played_and_every_play_is_judged():
    played = {(task.toy, task.way) for task in tasks()}
    asked = {(role.where["variant"], role.where.get("learner")) for of in claims().values()
             for role in of.roles.values()}
    assert {(toy, way if (toy, way) in asked else None) for toy, way in played} == asked


def test_robots_play_no_toys():
    measure = make("measure", "toy", quantity="decisions")
    with pytest.raises(Exception, match=r"needs the table of python -m attnlab\.toys"):
        measure.of(Runs(None, {}, {}))
    assert measure.unit == "decisions"
    runs = ToyRuns({"variant": "cliff", "learner": "tempo_rl"}, {3: {"decisions": 4.0}, 4: {"area": 1.0}})
    assert measure.of(runs) == {3: 4.0} and runs.config(3)["variant"] == "cliff"
    with pytest.raises(Exception, match="cliff tempo_rl has no error"):
        make("measure", "toy", quantity="error").of(runs)


def test_the_command_writes_the_same_whoever_plays(tmp_path, capsys):
    for name, jobs in (("one", "1"), ("two", "2")):
        assert main(["--seeds", "2", "--short", "1000", "--jobs", jobs, "--out", str(tmp_path / name)]) == 0
    assert (tmp_path / "one" / "toys.csv").read_bytes() == (tmp_path / "two" / "toys.csv").read_bytes()
    told = read(tmp_path / "one" / "toys.csv")
    assert as_csv(told) == (tmp_path / "one" / "toys.csv").read_bytes()
    assert main(["--table", str(tmp_path / "one" / "toys.csv"), "--out", str(tmp_path / "again")]) == 0
    for name in ("toys.csv", "verdicts.csv"):
        assert (tmp_path / "again" / name).read_bytes() == (tmp_path / "one" / name).read_bytes()
    rows = list(csv.DictReader(io.StringIO((tmp_path / "one" / "verdicts.csv").read_text())))
    asked = sum(len(claim.parts) for of in claims().values() for claim in of.claims.values())
    assert len(rows) == asked and {row["seeds"] for row in rows} == {"2"}
    page = (tmp_path / "one" / "README.md").read_text()
    assert page.count("\n## ") == 4 and "Of 8 claims:" in page
    made = json.loads((tmp_path / "one" / "made.json").read_text())
    assert made["command"] == "python -m attnlab.toys --seeds 2 --short 1000"
    assert "Claims (TempoRL on its grids)" in capsys.readouterr().out


@pytest.mark.parametrize(("typed", "said"), [
    (["--seeds", "0"], "--seeds: must be at least 1, got 0"), (["--short", "-1"], "--short: must be at least 1"),
    (["--jobs", "0"], "--jobs: must be at least 1"), (["--table", "{}/none.csv"], "is no table of toys"),
    (["--table", "{}/other.csv"], "is no table of toys"), (["--table", "{}/half.csv"], "is no table of toys"),
    (["--table", "{}/nan.csv"], "has a value that is no number"), (["--out", "/proc/x"], "/proc/x cannot be written")])
def test_bad_input_is_one_line_and_nothing_is_written(typed, said, tmp_path, capsys):
    from attnlab.console import guarded
    (tmp_path / "other.csv").write_text("toy,learner,seed,quantity,value\ncliff,tempo_rl,0,beauty,1\n")
    (tmp_path / "nan.csv").write_text("toy,learner,seed,quantity,value\ncliff,tempo_rl,0,area,nan\n")
    (tmp_path / "half.csv").write_text("toy,learner,seed,quantity,value\ncliff,tempo_rl\n")
    assert guarded(main, ["--out", str(tmp_path / "out"), *(word.format(tmp_path) for word in typed)]) == 2
    error = capsys.readouterr().err
    assert said in error and error.count("\n") == 1 and not (tmp_path / "out").exists()
