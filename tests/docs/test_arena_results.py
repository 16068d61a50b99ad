"""docs/results/arena: words follow tables, tables follow the leaderboard, and what was promised is there."""

from __future__ import annotations

import csv
import importlib
import json
from pathlib import Path

import pytest

from attnlab.arena.board import read_board
from attnlab.arena.summary import standings
from attnlab.arena.words import ranks_csv, standings_csv

RESULTS = Path(__file__).resolve().parents[2] / "docs" / "results"
HERE = RESULTS / "arena"
MADE = json.loads((HERE / "made.json").read_text())
WAYS = 12
LONGEST_S = 600  # on two cores


@pytest.fixture
def arena_page(monkeypatch):
    monkeypatch.syspath_prepend(str(RESULTS))
    return importlib.import_module("arena_page")


@pytest.fixture(scope="module")
def board():
    found = {}
    for row in read_board(HERE / "leaderboard.jsonl"):
        found.setdefault(row.place, []).append(row)
    return found


def rows_of(name):
    return list(csv.DictReader((HERE / name).read_text().splitlines()))


def test_the_page_is_what_its_tables_say(arena_page):
    """If not: python docs/results/make.py --page."""
    assert (HERE / "README.md").read_text() == arena_page.page(RESULTS)


def test_every_number_of_the_page_is_from_a_table(arena_page):
    """Those of its words: each is a cell, or a hundredfold one, to the digits that are shown."""
    cells = [abs(float(cell)) for row in rows_of("standings.csv") for cell in row.values() if cell.strip("-").strip(".")
             .replace(".", "").replace("e-", "").isdigit()]
    words = (HERE / "README.md").read_text().partition("\n## ")[0]
    numbers = arena_page.numbers(words)
    known = [value for cell in cells for value in (cell, 100 * cell)] + [MADE["wall_s"] / 60, float(arena_page.PRICE),
                                                                        0.05]
    assert len(numbers) > 40
    for number in numbers:
        half = 0.5 * 10.0 ** -len(number.partition(".")[2]) + 1e-9
        assert any(abs(abs(float(number)) - value) <= half for value in known), number


def test_the_standings_of_worlds_are_those_of_the_leaderboard(board):
    """Made anew from the rows, with verdicts and resamples, to the last digit."""
    worlds = {place: standings(rows) for place, rows in board.items() if place.startswith("world ")}
    anew = [line for line in standings_csv(worlds).decode().splitlines() if line.startswith("world ")]
    assert anew == [line for line in (HERE / "standings.csv").read_text().splitlines() if line.startswith("world ")]
    assert len(anew) > 4 * WAYS
    ranks = [line for line in ranks_csv(worlds).decode().splitlines() if line.startswith("world ")]
    assert ranks == [line for line in (HERE / "ranks.csv").read_text().splitlines() if line.startswith("world ")]


def test_what_was_promised_is_there(board):
    """Twelve ways in four worlds, all compiled, ten seeds; two logs in eight blocks; ten minutes of two cores."""
    worlds = [place for place in board if place.startswith("world ")]
    logs = [place for place in board if not place.startswith("world ")]
    assert {place.split()[1] for place in worlds} == {"paper", "open", "cluttered", "wandering"} and len(logs) == 2
    for places, units in ((worlds, 10), (logs, 8)):
        for place in places:
            ways: dict[str, list[str]] = {}
            for row in board[place]:
                ways.setdefault(row.way, []).append(row.unit)
            assert len([way for way in ways if not way.startswith("(")]) >= WAYS
            assert all(len(set(of)) == len(of) == units for of in ways.values())
    assert MADE["engines"] == ["compiled"] and MADE["runs"] == MADE["asked_for"]
    assert MADE["wall_s"] < LONGEST_S
    assert all(row.made["command"] and row.made["code"]["hash"] for rows in board.values() for row in rows)
    assert all(row.made["seeds"] == 10 for place in logs for row in board[place] if not row.way.startswith("("))


def test_who_needs_the_percepts_between_looks_is_marked_and_shown_without_them(board):
    for place, rows in board.items():
        marked = {row.way for row in rows if row.between}
        assert marked == (set() if place.startswith("world ") else {"tempo_rl(all)"})
        assert "tempo_rl" in {row.way for row in rows}


def test_no_two_ways_have_equal_results(board):
    """Over all places together: on a log, a way that learns one period for all percepts is that fixed clock."""
    did: dict[str, list[tuple[str, str, float, float]]] = {}
    for place, rows in sorted(board.items()):
        for row in sorted(rows, key=lambda row: row.unit):
            did.setdefault(row.way, []).append((place, row.unit, row.looks, row.harm))
    assert len({tuple(of) for of in did.values()}) == len(did)


def test_the_page_needs_no_network_and_knows_dark_and_small_screens():
    text = (HERE / "report.html").read_text()
    assert "prefers-color-scheme: dark" in text and "width=device-width" in text
    assert "src=" not in text and "https://" not in text
    assert text.count("<figure>") == 6  # what was looked at: two logs, four worlds
