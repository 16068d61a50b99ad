"""The first screen: sentences that follow the numbers, and every condition in rank."""

import re

import pytest
from small_study import write_run

from attnlab.report.forest import Row, first_screen, rows_of, sentences
from attnlab.results.load import load
from attnlab.stats import mean_interval


def row(name, *values):
    seeds = dict(enumerate(values))
    return Row(name, seeds, mean_interval(values))


def test_two_conditions_are_compared_by_seed():
    clear = sentences([row("CR", 90.0, 80.0, 70.0), row("NCR", 85.0, 74.0, 65.0)])
    assert clear[0].startswith("CR survives 80.0 % [") and "the most" in clear[0]
    assert "difference is +5.3 points [+3.9, +6.8]: clear over seeds." in clear[1]  # 5, 6, 5: t of 2 degrees, 4.303
    unclear = sentences([row("CR", 90.0, 80.0, 70.0), row("NCR", 70.0, 85.0, 80.0)])
    assert "not clear: the interval allows either side" in unclear[1]


def test_one_seed_has_no_interval():
    texts = sentences([row("a", 90.0), row("b", 80.0)])
    assert "one seed, no interval" in texts[0] and "clear over seeds" not in texts[1]


def test_many_conditions_are_ranked_not_listed():
    rows = [row("best", 99.0, 98.0, 99.0), row("near", 98.0, 99.0, 99.0), row("far", 50.0, 52.0, 51.0)]
    assert sentences(rows)[1] == ("1 of the other 2 conditions is clearly below it, paired by seed and not corrected "
                                  "for their number: far.")
    assert "None of the others" in sentences([*rows[:2], row("also", 99.0, 97.0, 99.0)])[1]


def test_the_page_has_every_condition_best_first(tmp_path):
    study = tmp_path / "study"
    for seed in range(3):
        for learner in ("one", "two", "<three>"):
            write_run(study, "none", seed, swept={"learner": learner}, learner={"name": learner})
    found = load(study)
    rows = rows_of(found)
    assert [r.value.value for r in rows] == sorted((r.value.value for r in rows), reverse=True) and len(rows) == 3
    html = first_screen(found)
    assert len(re.findall(r"<th scope=\"row\">", html)) == 3 and "<three>" not in html
    assert html.count("class=seed") == 9
    episodes = found.episodes[found.episodes["phase"] == "validation"]
    assert rows[0].value.value == pytest.approx(
        100 * episodes[episodes["condition"] == rows[0].name].groupby("seed")["survival"].mean().mean())


def test_no_interval_reaches_beyond_what_a_percentage_can_be(tmp_path):
    for seed in range(2):
        write_run(tmp_path / "study", "none", seed, validation=1)
    row, = rows_of(load(tmp_path / "study"))
    assert mean_interval(list(row.seeds.values())).high > 100.0 == row.value.high
