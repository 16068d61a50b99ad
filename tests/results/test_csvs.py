"""Comma-separated values have one writer, and no cell of it is a formula to a spreadsheet."""

from __future__ import annotations

import re

import pandas as pd

from attnlab.paths import PACKAGE
from attnlab.tables.csvs import csv_bytes, frame_csv


def test_no_formulas_in_any_cell():
    assert csv_bytes(["=head", "b"], [["@sum(a1)", -0.5], ["-0.5", "+1e-3"], ["plain, quoted", "-cmd"]]).decode() == (
        "'=head,b\n'@sum(a1),-0.5\n-0.5,+1e-3\n\"plain, quoted\",'-cmd\n")


def test_no_formulas_in_frames():
    frame = pd.DataFrame({"-a": pd.Series(["=1+1", "x"], dtype="category"), "n": [-1.25, 2.0]})
    assert frame_csv(frame, "%.6g").decode() == "'-a,n\n'=1+1,-1.25\nx,2\n"


def test_nobody_else_writes_them():
    others = [str(file) for file in PACKAGE.rglob("*.py")
              if file.name != "csvs.py" and re.search(r"to_csv|csv\.(Dict)?[Ww]riter", file.read_text())]
    assert not others
