"""A study's frames as CSV, for programs that read nothing better."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from attnlab.results.load import Study
from attnlab.tables.files import write_bytes
from attnlab.tables.schema import TABLES

if TYPE_CHECKING:
    import pandas as pd

FORMULA = ("=", "+", "-", "@", "\t", "\r")  # what spreadsheets take for the beginning of one


def harmless(text: Any) -> Any:
    """A cell that no spreadsheet runs: a text that begins like a formula gets an apostrophe."""
    return f"'{text}" if isinstance(text, str) and text.startswith(FORMULA) else text


def export_csv(study: Study, out: Path) -> list[Path]:
    """``runs.csv`` and a file for each table, all rows of all complete runs; the files."""
    out.mkdir(parents=True, exist_ok=True)
    made = []
    for name in ("runs", *TABLES):
        frame: pd.DataFrame = getattr(study, name)
        texts = frame.select_dtypes(include=["object", "string", "category"]).columns
        frame = frame.assign(**{column: frame[column].astype(object).map(harmless) for column in texts})
        frame.columns = [harmless(column) for column in frame.columns]
        made.append(out / f"{name}.csv")
        write_bytes(made[-1], frame.to_csv(index=False).encode())
    return made
