"""The paragraphs of the project's own studies: words follow the tables, and every number in them is from one."""

from __future__ import annotations

import csv
import importlib
import json
import re
from pathlib import Path

import pytest

from attnlab.claims import claims_hash
from attnlab.figures.phase_map import ROWS, papers

ROOT = Path(__file__).resolve().parents[2]
RESULTS = ROOT / "docs" / "results"
NAMES = ("bigger_table", "matched_budget", "where_curiosity_pays", "clamped_levels")
CONTRAST = ("quantity", "unit", "treatment", "control", "seeds", "treatment_mean", "control_mean", "difference", "low",
            "high")
UP, DOWN, FLAT = (2.0, 1.0, 3.0), (-2.0, -3.0, -1.0), (0.5, -1.0, 2.0)


@pytest.fixture
def script(monkeypatch):
    """A module of the folder by name."""
    monkeypatch.syspath_prepend(str(RESULTS))
    return importlib.import_module


def write(folder, study, name, heads, rows):
    """A table of a study, as if it were made today."""
    (folder / study).mkdir(parents=True, exist_ok=True)
    with (folder / study / f"{name}.csv").open("w", newline="") as sink:
        writer = csv.writer(sink)
        writer.writerows([heads, *rows])
    made = {"claims_sha256": claims_hash(study), "seeds": 40, "runs": 200, "asked_for": 200, "cpu_s_of_runs": 600,
            "code": {"hash": "abc"}}
    (folder / study / "made.json").write_text(json.dumps(made))


def contrasts(folder, study, *rows):
    """``rows``: (quantity, unit, one, other, (difference, low, high))."""
    write(folder, study, "contrasts", CONTRAST, [[*row[:4], 40, 90 + row[4][0], 90, *row[4]] for row in rows])


def ladder(script, folder, ends):
    """Every pair of the ladder with the same differences."""
    own, studies = script("own"), script("studies")
    pairs = studies.BY_NAME["bigger_table"].pairs
    contrasts(folder, "bigger_table", *((q, "1" if q == "safety" else "%", *pair, ends.get(q, FLAT))
                                        for pair in pairs for q in own.LADDER))


def test_nothing_is_said_of_what_was_not_made(script, tmp_path):
    own, page, studies = script("own"), script("page"), script("studies")
    for name in NAMES:
        assert own.text(name, tmp_path) == f"This is not known yet: {name} has not been made under today's rules."
        assert page.own_study(tmp_path, studies.BY_NAME[name]) == []
    ladder(script, tmp_path, {})
    (tmp_path / "bigger_table" / "made.json").write_text(json.dumps({"claims_sha256": "0" * 64}))
    assert own.text("bigger_table", tmp_path).startswith("This is not known yet")


@pytest.mark.parametrize(("ends", "word"), [(UP, "more"), (DOWN, "less")])
def test_the_ladder_says_what_is_clear(script, tmp_path, ends, word):
    own, found = script("own"), script("found")
    ladder(script, tmp_path, {found.EARLY: ends, "safety": ends})
    said = own.text("bigger_table", tmp_path)
    number = f"{ends[0]:+.1f} [{ends[1]:+.1f}, {ends[2]:+.1f}] points"
    assert said.startswith("40 seeds that took no part in `controls`. The bigger table by itself (NCR, same states "
                           f"less NCR, plain): {word} early survival ({number}), {word} safety (")
    assert said.count("not clear late survival and survival in validation") == 6
    heads, *rows = own.steps("bigger_table", tmp_path)
    assert len(rows) == 6 and rows[0][:2] == ["NCR, same states less NCR, plain", number] and len(heads) == 5
    third = found.sentences(tmp_path)[2]
    assert f"CR survives {word} in the first half of training ({number})" in third
    assert third.endswith("(bigger_table, 40 seeds).")


def test_the_budget_counts_caps(script, tmp_path):
    own, found, studies = script("own"), script("found"), script("studies")
    ends = dict(zip(studies.CAPS, (UP, DOWN, (-5.0, -6.0, -4.0), FLAT), strict=True))
    contrasts(tmp_path, "matched_budget", *((found.VALID, "%", *pair, ends[pair[0].split()[0].partition("=")[2]])
                                            for pair in studies.BY_NAME["matched_budget"].pairs))
    write(tmp_path, "matched_budget", "front",
          ("outcome", "condition", "cap", "seeds", "looks_mean", "mean", "on_front"),
          [("survival, validation", "CR", "1.8", 12, 1.75, 88.25, 1), ("survival, validation", "random", "1.8", 12,
                                                                      1.70, 80.0, 1),
           ("survival, validation", "fixed at 4", "1.8", 12, 1.8, 70.0, 0)])
    said = own.text("matched_budget", tmp_path)
    assert "from the fewest looks: random at 1.70/s (80.0 %), CR at 1.75/s (88.2 %)." in said
    assert "fixed at 4 at" not in said
    assert "CR survives clearly more under 1 and clearly less under 2 of 4 caps (most apart at 2.6/s: -5.0" in said
    assert len(own.steps("matched_budget", tmp_path)) == 1 + len(studies.BY_NAME["matched_budget"].pairs)


def test_the_map_counts_sound_worlds_and_names_the_papers(script, tmp_path):
    own, titles = script("own"), list(ROWS)
    distance, obstacles, well = papers()
    worlds = [(title, *place, sound, 8, 1.5, 0.5, 2.5) for title in titles for place, sound in
              (((distance, int(obstacles), well), 1), ((1.0, 0, 1533.0), 0), ((1.0, 4, 1533.0), 1))]
    write(tmp_path, "where_curiosity_pays", "map", ("what", "distance_m", "obstacles", "energy_well", "sound", "seeds",
                                                    "difference", "low", "high"), worlds)
    write(tmp_path, "where_curiosity_pays", "together",
          ("what", "energy_well", "worlds", "better", "worse", "seeds", "mean", "low", "high"),
          [(title, of, 2, 1, 0, 8, 0.25, -0.5, 1.0) for title in titles for of in ("all", "1533")])
    said = own.text("where_curiosity_pays", tmp_path)
    assert said.startswith("3 worlds, 8 seeds each. In 2 of them the robot of 2012 is sound")
    assert f"{titles[0]}, +0.2 [-0.5, +1.0] points over all of them, clearly better in 1 and clearly worse in 0" in said
    assert f"In the paper's own world (ring): {titles[0]}, +1.5 [+0.5, +2.5] points" in said
    assert own.steps("where_curiosity_pays", tmp_path)[2][:3] == [titles[0], "0.33", "+0.2 [-0.5, +1.0] points"]


def test_levels_say_how_well_they_were_known(script, tmp_path):
    own, found, studies = script("own"), script("found"), script("studies")
    contrasts(tmp_path, "clamped_levels", *((q, unit, level, studies.OWN_LEVEL, DOWN) for level in studies.LEVELS
                                            for q, unit in ((found.VALID, "%"), ("hunger", "UoE"))))
    write(tmp_path, "clamped_levels", "levels", ("condition", "quantity", "seeds", "mean", "low", "high"),
          [(level, quantity, 40, 33.3, 30.0, 36.0) for level in (studies.OWN_LEVEL, *studies.LEVELS)
           for quantity in ("looks in 100 cycles", "states visited in training, %")])
    said = own.text("clamped_levels", tmp_path)
    assert "Held at low (33 [30, 36] % of its states were ever visited in training) it takes 33 [30, 36] looks" in said
    assert said.count("less survival (-2.0 [-3.0, -1.0] points), less hunger (-2 [-3, -1] UoE)") == 3


@pytest.mark.parametrize("name", [name for name in NAMES if (RESULTS / name).is_dir()])
def test_the_study_that_is_here_is_whole(script, name):
    """Its paragraph stands on the page, its figure is there, all runs were complete, and no number in it is of no
    table."""
    own, found = script("own"), script("found")
    with_ = found.made(RESULTS, name)
    assert with_["runs"] == with_["asked_for"] > 0
    said = own.text(name, RESULTS)
    assert said in (RESULTS / "README.md").read_text()
    assert (RESULTS / name / f"{script('studies').BY_NAME[name].figures[0]}.png").exists()
    files = [*(RESULTS / name).glob("*.csv"), RESULTS / "controls" / "contrasts.csv"]
    cells = [cell for file in files for row in csv.reader(file.read_text().splitlines()) for cell in row]
    known = [abs(float(cell)) for cell in cells if re.fullmatch(r"-?\d+(\.\d+)?(e-?\d+)?", cell)]
    for number in re.findall(r"[-+]\d+\.\d+", said):
        half = 0.5 * 10.0 ** -len(number.partition(".")[2]) + 1e-9
        assert any(abs(abs(float(number)) - value) <= half for value in known), number
