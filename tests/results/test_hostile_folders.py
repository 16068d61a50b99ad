"""Run folders that nobody of ours wrote: each is named, and the rest goes on."""

from __future__ import annotations

import itertools
import json
import shutil

import pytest

from attnlab.results import load
from attnlab.results.standing import look, said
from attnlab.results.summary import summary_frame

VALUES = (None, True, 1e308, "[/b]<script>", [1], {"a": []})
FIELDS = ("status", "key", "seed", "schema", "run", "error", "tables", "numbers", "swept", "overrides", "plugins",
          "claim")
WHOLE = ("", "null", "[]", "5", '"complete"', "{", '{"status": ', "\x00", "NaN", '{"status": NaN}', "[" * 20000)


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    from attnlab.cli.main import main as command
    folder = tmp_path_factory.mktemp("hostile")
    assert command(["cluster=serial", "seed=0-1", "simulator=planar", "train_episodes=2", "validation_episodes=1",
                    "max_cycles=60", "picture=false", "report=false", f"outputs={folder}", "study=s"]) == 0
    return folder / "s"


@pytest.fixture
def copy(study, tmp_path):
    shutil.copytree(study, tmp_path / "s")
    return tmp_path / "s"


def checked(folder, bad):
    """All readers go through, and the other run is told as ever."""
    result = load(folder)
    for table in ("episodes", "behaviours"):
        frame = getattr(result, table)
        assert frame.empty or bad.name not in set(frame["run"]) or bad.name in result.complete
        assert len(set(frame["run"]) - {bad.name}) == 1
    assert len(result.runs) >= 2
    assert len(summary_frame(result, result.named())) == 1
    assert "2 runs asked for" in "\n".join(said(folder, look(folder)))
    return result


def test_run_json_of_any_shape(copy):
    bad = sorted(copy.glob("*/run.json"))[0]
    about = json.loads(bad.read_text())
    for field, value in itertools.product(FIELDS, VALUES):
        bad.write_text(json.dumps({**about, field: value}))
        checked(copy, bad.parent)
    for text in WHOLE:
        bad.write_text(text)
        checked(copy, bad.parent)


def foreign(file):
    import pyarrow as pa
    import pyarrow.parquet as pq
    pq.write_table(pa.table({"x": [1, 2]}), file)


def impossible(value):
    def write(file):
        import pyarrow as pa
        import pyarrow.parquet as pq
        table = pq.read_table(file, partitioning=None)
        place = table.column_names.index("survival")
        pq.write_table(table.set_column(place, "survival", pa.array([value] * len(table), pa.float64())), file)
    return write


def others(file):
    """The table of the other run."""
    other = next(f for f in file.parent.parent.glob(f"*/{file.name}") if f != file)
    shutil.copyfile(other, file)


@pytest.mark.parametrize("marked", [True, False], ids=["with its sha256", "of an older version"])
@pytest.mark.parametrize("write", [foreign, impossible(5.0), impossible(float("nan")), impossible(None), others,
                                   lambda file: file.write_bytes(b"PAR1 nothing PAR1")],
                         ids=["foreign", "5", "nan", "none", "of another run", "no table"])
def test_tables_that_are_none(copy, write, marked):
    bad = sorted(copy.glob("*/run.json"))[0].parent
    if not marked:
        about = json.loads((bad / "run.json").read_text())
        (bad / "run.json").write_text(json.dumps({**about, "tables": None}))
    write(bad / "episodes.parquet")
    result = load(copy)
    assert len(set(result.episodes["run"])) == 1
    row = result.runs.set_index("run").loc[bad.name]
    assert row["status"] == "damaged" and "episodes.parquet" in row["why"]


def test_a_copy_is_named_and_counts_nothing(copy):
    run = sorted(copy.glob("*/run.json"))[0].parent
    shutil.copytree(run, copy / f"a_copy-{run.name}")
    result = load(copy)
    assert result.runs.set_index("run").loc[f"a_copy-{run.name}", "why"] == f"a copy of {run.name}"
    assert len(result.complete) == 2 and len(result.episodes) == 6
