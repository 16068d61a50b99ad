"""The toys of the papers on when to look: ``python docs/results/make.py toys``, minutes; their page is written by
``python -m attnlab.toys`` itself."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

TOYS = "toys"


def make(to: Path, short: bool) -> None:
    """Play, judge, write."""
    subprocess.run([sys.executable, "-m", "attnlab.toys", "--out", str(to / TOYS),
                    *(["--seeds", "6", "--short", "100"] if short else [])], check=True)


def write_page(folder: Path) -> None:
    """The page from the table that is there, if there is one."""
    table = folder / TOYS / "toys.csv"
    if table.exists():
        subprocess.run([sys.executable, "-m", "attnlab.toys", "--table", str(table), "--out", str(folder / TOYS)],
                       check=True, stdout=subprocess.DEVNULL)
