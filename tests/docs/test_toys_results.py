"""docs/results/toys: its page and verdicts are what its table says today."""

import importlib
import json
from pathlib import Path

import pytest

from attnlab.report import verdicts as tables
from attnlab.toys.page import page
from attnlab.toys.table import as_csv, claims, judged, read, tasks

RESULTS = Path(__file__).resolve().parents[2] / "docs" / "results"
FOLDER = RESULTS / "toys"


def test_the_page_says_what_the_table_says():
    told, files = read(FOLDER / "toys.csv"), claims()
    found, made = judged(told), json.loads((FOLDER / "made.json").read_text())
    assert (FOLDER / "README.md").read_text() == page(found, files, made["command"])
    assert (FOLDER / "verdicts.csv").read_bytes() == tables.as_csv(found)
    assert as_csv(told) == (FOLDER / "toys.csv").read_bytes()
    assert made["claims_sha256"] == {name: of.sha256 for name, of in files.items()}, "the rules are others than then"
    assert set(told) == {(task.toy, task.way) for task in tasks()}
    assert {len(seeds) for seeds in told.values()} == {20}


def test_make_plays_toys_when_it_is_asked_to(monkeypatch, tmp_path):
    monkeypatch.syspath_prepend(str(RESULTS))
    toys, typed = importlib.import_module("toys"), []
    monkeypatch.setattr(toys.subprocess, "run", lambda command, **_: typed.append(command[1:]))
    toys.make(tmp_path, short=False)
    toys.write_page(tmp_path)
    assert typed == [["-m", "attnlab.toys", "--out", str(tmp_path / "toys")]]
    toys.write_page(RESULTS)
    assert typed[1][:3] == ["-m", "attnlab.toys", "--table"]


def replayed(wanted):
    """What today's code makes of seed 0, of the tasks that are wanted, and what the table has."""
    told = read(FOLDER / "toys.csv")
    for task in filter(wanted, tasks()):
        today = {name: f"{value:.9g}" for name, value in task.play(0, task.length).items()}
        assert today == {name: f"{value:.9g}" for name, value in told[task.toy, task.way][0].items()}, task[:2]


def test_today_s_code_gives_the_table():
    replayed(lambda task: task.toy in ("chain", "even_odd", "chain for clocks"))


@pytest.mark.long
def test_today_s_code_gives_the_whole_table():
    replayed(lambda task: True)
