"""The table of docs/claims.md is what its command made: of the file beside the results, by today's rules."""

import csv
from pathlib import Path

import pytest

from attnlab.calibrate.__main__ import MARKS
from attnlab.calibrate.table import as_markdown, calibrate, read_seeds
from attnlab.claims.files import load_claims

DOCS = Path(__file__).resolve().parents[2] / "docs"


def test_the_page_says_what_the_file_says():
    page = (DOCS / "claims.md").read_text()
    lines = page[page.index(MARKS[0]):page.index(MARKS[1])].splitlines()
    with (DOCS / "results" / "calibration" / "calibration.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 27
    for row in rows:
        line = next(line for line in lines if line.startswith(f"| {row['claim']} "))
        cells = [cell.strip() for cell in line.strip("| ").split(" | ")]
        for cell, rate, high in ((cells[1], row["false_reproduced"], row["false_reproduced_high"]),
                                 (cells[2], row["false_contradicted"], row["false_contradicted_high"])):
            assert cell == f"{100 * float(rate):.1f} % (≤ {100 * float(high):.1f})"
            assert float(rate) <= 0.05 and float(high) < 0.065
        assert cells[4:] == [row["seeds_to_hold"], row["seeds_to_reproduce"]]


@pytest.mark.long
def test_the_command_makes_it_again():
    page = (DOCS / "claims.md").read_text()
    rows = calibrate(load_claims("dinocera2014"), read_seeds(DOCS / "results" / "controls" / "seeds.csv"), 2000, 20)
    assert as_markdown(rows) in page
