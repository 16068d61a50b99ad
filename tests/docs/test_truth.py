"""What docs/results says of the search and of the certificate is what their tables say."""

import csv
import importlib
import itertools
from pathlib import Path

import pytest

from attnlab.audit.pairs import POSSIBLE, prove
from attnlab.claims import DEFAULT
from attnlab.claims.files import load_claims

RESULTS = Path(__file__).resolve().parents[2] / "docs" / "results"


@pytest.fixture
def truth(monkeypatch):
    monkeypatch.syspath_prepend(str(RESULTS))
    return importlib.import_module("truth")


def test_the_certificate_has_every_pair_with_its_reason(truth):
    rows = truth.table(RESULTS, "audit", "pairs")
    ids = list(load_claims(DEFAULT).claims)
    assert [(row["one"], row["other"]) for row in rows] == [*itertools.combinations(ids, 2), ("all", "")]
    assert len(rows) == 352 and all(row["reason"] for row in rows)
    assert (RESULTS / "audit" / "pairs.csv").stat().st_size < 100_000
    said = truth.section(RESULTS)[1]
    assert "Of 351 pairs of claims, " in said


def test_some_of_its_pairs_proved_anew(truth):
    claims, rows = load_claims(DEFAULT), truth.table(RESULTS, "audit", "pairs")
    for row in [row for row in rows if not row["reason"].startswith("hold in")][::60]:
        keys = [row["one"], row["other"]] if row["other"] else list(claims.claims)
        assert prove(claims, keys, {})[0] == row["outcome"]


def test_what_it_says_was_seen_was_seen(truth):
    from attnlab.audit.certificate import holding
    for row in truth.table(RESULTS, "audit", "pairs"):
        if row["reason"].startswith("hold in "):
            study = row["reason"].removeprefix("hold in ").split()[0]
            there = holding(RESULTS / study / "verdicts.csv")
            assert row["outcome"] == POSSIBLE
            assert {row["one"], row["other"]} <= set(there[row["reason"].removeprefix("hold in ")])


def test_the_answer_follows_its_tables(truth, tmp_path):
    (tmp_path / "search").mkdir()
    heads = ["reading", "code", "not_sound", "seeds", "hold", "reproduced", "contradicted", "C1", "C2", "cycles",
             "need_k"]
    lines = [["inferred", "", "", 20, 0, 0, 1, "contradicted", "not reproduced", "", ""],
             ["r1", "10", "", 20, 1, 0, 0, "direction only", "not reproduced", "1500", "1"]]
    with (tmp_path / "search" / "finalists.csv").open("w", newline="") as sink:
        csv.writer(sink).writerows([heads, *lines])
    (tmp_path / "search" / "rungs.csv").write_text(
        "rung,seeds,episodes,reading,score\n1,2,120,10,1.5\n1,2,120,00,\n2,3,500,10,1.25\n")
    title, tried, said, table = truth.section(tmp_path)
    assert title.endswith("in which the paper is true?")
    assert "2 different readings were tried. 2 readings (1 sound) with 2 seeds over 120 episodes, best score 1.5; " \
           "then 1 readings (1 sound) with 3 seeds" in tried
    assert "At most 1 of 2 claims hold together (C1), in reading r1" in said
    assert "Reading r1 differs from `inferred` in 1 of 2 open points: cycles 1500." in said
    assert table.splitlines()[-1] == "| r1 | yes | 1 | 0 | 0 | C1 |"
    assert truth.section(tmp_path / "nothing") == []
