"""A study's frames as CSV, for programs that read nothing better."""

from __future__ import annotations

from pathlib import Path

from attnlab.results.load import Study
from attnlab.tables.csvs import frame_csv
from attnlab.tables.files import write_bytes
from attnlab.tables.schema import TABLES


def export_csv(study: Study, out: Path) -> list[Path]:
    """``runs.csv`` and a file for each table, all rows of all complete runs; the files."""
    out.mkdir(parents=True, exist_ok=True)
    made = []
    for name in ("runs", *TABLES):
        made.append(out / f"{name}.csv")
        write_bytes(made[-1], frame_csv(getattr(study, name)))
    return made
