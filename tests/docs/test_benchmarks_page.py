"""What docs/benchmarks.md, docs/simulators.md and docs/engine.md say in numbers is what was stored."""

from __future__ import annotations

import copy
import json
import re

import pytest

from benchmarks import asked, first, history, page
from benchmarks.run import LIMIT, RESULTS

EVERY = history.results(RESULTS)


def test_the_pages_are_those_of_the_stored_results():
    """If not: python benchmarks/run.py --page."""
    assert (page.DOCS / "benchmarks.md").read_text() == page.page(EVERY)
    for name in page.PAGES:
        text = (page.DOCS / name).read_text()
        assert text == page.filled(text, EVERY[-1])
        assert page.PLACE.search(text), name


def test_the_readme_has_the_times_of_its_first_command():
    readme, found = (first.ROOT / "README.md").read_text(), json.loads(first.RESULT.read_text())
    assert first.MARK.search(readme) and first.said(readme, found) == readme
    typed = first.first(readme)
    assert found["command"] == " ".join(typed) and "seed=0-5" in typed


def test_no_speed_is_typed_by_hand():
    for name in page.PAGES:
        text = page.PLACE.sub("", (page.DOCS / name).read_text())
        assert not re.findall(r"\d[\d,.]* (?:us|ms|µs|cycles a CPU-second|times (?:faster|slower))\b", text)


def test_the_history_has_every_result_with_its_commit():
    rows = history.table(EVERY)[2:]
    assert len(rows) == len(list(RESULTS.glob("[0-9]*.json"))) >= 4
    assert [row.split(" | ")[0].strip("| ") for row in rows] == sorted(one["date"][:16] for one in EVERY)
    for one in EVERY:
        assert one["code"]["commit"] and one["machine"]["cpu"] and one["versions"]["python"]
        assert history.share(one, LIMIT) == 1.0
    assert history.share(EVERY[0], "compiled, whole run") is None


def test_what_was_asked_may_fail_and_may_be_missing():
    first = next(one for one in EVERY if one["file"] == asked.FIRST)
    found = {"contest": {LIMIT: {"median": 300.0}, "compiled, loop alone": {"median": 99.0},
                         "compiled, whole run": {"median": 61.0}}, "study": {"planar": {"wall_s": 40.5}}}
    rows = {row.split(" | ")[0].strip("| "): row for row in asked.table(found, first)[2:]}
    assert rows["compiled, loop alone: at least 1/3 of the fused kernel"].endswith("| 1/3.0 | **not reached** |")
    assert rows["compiled, whole run: at least 1/5 of the fused kernel"].endswith("| 1/4.9 |  |")
    assert rows["study of 40 runs on planar, start to page: under 40 s"].endswith("| 40.50 s | **not reached** |")
    assert "not measured" in rows["--help: under 1 s"] and "not measured" in rows["planar, interpreted: at least 300 "
                                                                                   "times ir-sim"]


def test_a_number_that_changes_changes_the_page():
    other = copy.deepcopy(EVERY)
    other[-1]["contest"][LIMIT]["median"] *= 2
    assert page.page(other) != page.page(EVERY)


@pytest.mark.parametrize(("kind", "name", "shown"), [("us", "sonar", "2.5 us"), ("share", "slow / fast", "1/4"),
                                               ("share", "fast / slow", "4.0 times"), ("compile", "first", "13")])
def test_a_place_is_filled(kind, name, shown):
    found = {"calls": {"sonar": {"median": 4e5}}, "contest": {"slow": {"median": 2.0}, "fast": {"median": 8.0}},
             "starts": {"first compile": {"cpu_s": 15.0}, "compiled": {"cpu_s": 2.0}}}
    place = f"a <!-- measured: {kind} {name} -->old<!-- end --> b"
    assert page.filled(place, found) == f"a <!-- measured: {kind} {name} -->{shown}<!-- end --> b"
