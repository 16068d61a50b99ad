"""How a study stands, told from its files; and the summary from the numbers that run.json keeps."""

from __future__ import annotations

import math
import os

import pytest

from attnlab.console import guarded
from attnlab.results import load
from attnlab.results.one import no_run
from attnlab.results.standing import look, said
from attnlab.results.summary import _from_tables, summary_frame
from attnlab.tables.claim import PATIENCE_S, take
from attnlab.tables.files import write_json
from attnlab.tables.study import read_study
from attnlab.watch import main


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """Four runs asked for, two of them done by one process."""
    from attnlab.cli.main import main as command
    folder = tmp_path_factory.mktemp("watched")
    typed = ["cluster=serial", "curiosity=litman,none", "simulator=planar", "train_episodes=3", "validation_episodes=2",
             "max_cycles=120", "picture=false", "report=false", f"outputs={folder}", "study=s"]
    assert command([*typed, "seed=0"]) == 0
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("attnlab.launch.drive._run", lambda todo, folder: [])
        assert command([*typed, "seed=0-1"]) == 0
    return folder / "s"


def test_what_is_told(study):
    missing = next(run for run in read_study(study).runs if run.seed == 1 and run.condition == "litman")
    assert look(study).states == {"complete": 2, "missing": 2}
    claim = take(study, missing.key)
    claim.beat(2, 180)
    (study / missing.name).mkdir()
    write_json(study / missing.name / "run.json", {"status": "running", "key": missing.key})
    found = look(study)
    assert found.states == {"complete": 2, "missing": 1, "running": 1} and not found.over
    assert (found.episodes, found.episodes_done) == (20, 12)
    assert found.conditions["litman"].living == [180 / 2 / 120]
    text = "\n".join(said(study, found))
    assert f"running: {missing.name}: 2/5 episodes" in text and "75.0%" in text and "silent" not in text
    at = (claim.path / "beat").stat().st_mtime
    os.utime(claim.path / "beat", (at - 50, at - 50))
    assert "silent for 50 s" in "\n".join(said(study, look(study)))
    os.utime(claim.path / "beat", (at - PATIENCE_S - 5,) * 2)
    gone = "\n".join(said(study, look(study)))
    assert "1 interrupted" in gone and f"left behind: {missing.name}: nothing was heard" in gone
    claim.release()
    write_json(study / missing.name / "run.json", {"status": "failed", "error": "Traceback\n[/b] why\n", "key": "k"})
    assert f"failed: {missing.name}: [/b] why" in "\n".join(said(study, look(study)))
    (study / missing.name / "run.json").unlink()
    (study / missing.name).rmdir()


def test_its_table_fits_a_narrow_terminal(study, monkeypatch):
    monkeypatch.setenv("COLUMNS", "60")
    found = look(study)
    for name in ("x" * 16, "y" * 17, "z" * 60):
        found.conditions[name] = found.conditions["none"]
    lines = list(said(study, found))[2:]
    assert max(len(line) for line in lines if "zzz" not in line) <= 60
    assert any(line.startswith(f"  {'x' * 16}     1/2") for line in lines) and f"  {'z' * 60}" in lines


def test_of_a_study_a_run_is_named(study):
    error = no_run(study, "")
    assert error.problem == "is a study, not a run of one" and "-seed0-" in error.hint
    assert "there is no such folder" in no_run(study / "nowhere", "").problem


def test_the_command_looks_once(study, capsys):
    before = {path: path.stat().st_mtime_ns for path in study.rglob("*") if path.is_file()}
    assert guarded(main, [str(study), "--once"]) == 0
    assert "4 runs asked for: 2 complete, 2 missing" in capsys.readouterr().out
    assert {path: path.stat().st_mtime_ns for path in study.rglob("*") if path.is_file()} == before
    assert guarded(main, ["nowhere", "--once"]) == 2 and guarded(main, [str(study), "--every", "0"]) == 2


def test_numbers_are_what_the_tables_say(study):
    result = load(study)
    kept, made = summary_frame(result, result.named()), _from_tables(result, result.named())
    assert list(kept.columns) == list(made.columns)
    for row, other in zip(kept.to_dict("records"), made.to_dict("records"), strict=True):
        for key, value in row.items():
            assert value == other[key] or math.isclose(value, other[key], rel_tol=1e-12), key


def test_damage_inside_a_table_is_named(study):
    table = next(study.glob("*/behaviours.parquet"))
    whole = table.read_bytes()
    table.write_bytes(whole[:600] + bytes([whole[600] ^ 1]) + whole[601:])
    try:
        result = load(study)
        assert table.parent.name not in set(result.behaviours["run"])
        row = result.runs.set_index("run").loc[table.parent.name]
        assert row["status"] == "damaged" and "is not what the run wrote" in row["why"]
    finally:
        table.write_bytes(whole)


def test_made_once_more(study, capsys):
    from attnlab.rerun import main as rerun
    run = next(study.glob("*/run.json")).parent
    before = {path: path.read_bytes() for path in run.iterdir()}
    assert guarded(rerun, [str(run)]) == 0 and capsys.readouterr().out == "the same bytes\n"
    import pyarrow as pa
    import pyarrow.parquet as pq
    table = pq.read_table(run / "episodes.parquet", partitioning=None)
    cycles = table["cycles"].to_pylist()
    changed = [*cycles[:3], cycles[3] + 1, *cycles[4:]]
    place = table.column_names.index("cycles")
    pq.write_table(table.set_column(place, "cycles", pa.array(changed, pa.int32())), run / "episodes.parquet")
    try:
        assert guarded(rerun, [str(run)]) == 1
        said_ = capsys.readouterr().out
        assert said_.startswith(f"episodes: row 3, cycles: {changed[3]} is stored, {cycles[3]} is made now")
    finally:
        for path, data in before.items():
            path.write_bytes(data)
    assert guarded(rerun, [str(study)]) == 2


def test_csv_that_no_spreadsheet_runs(study, tmp_path):
    import pandas as pd

    from attnlab.export.__main__ import main as export
    from attnlab.tables.csvs import harmless
    assert guarded(export, [str(study), "--csv", "--out", str(tmp_path)]) == 0
    result = load(study)
    for name in ("runs", "episodes", "behaviours", "policy", "cycles", "coverage"):
        frame, found = getattr(result, name), pd.read_csv(tmp_path / f"{name}.csv")
        assert list(found.columns) == list(frame.columns) and len(found) == len(frame)
    assert pd.read_csv(tmp_path / "episodes.csv")["survival"].tolist() == result.episodes["survival"].tolist()
    assert [harmless(text) for text in ("=1+1", "@x", "-2", "-2+3", "plain", -3)] == ["'=1+1", "'@x", "-2", "'-2+3",
                                                                                      "plain", -3]
    assert guarded(export, [str(study)]) == 2
