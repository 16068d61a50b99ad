"""Comma-separated values, written in one way: no cell is a formula to a spreadsheet."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pandas as pd

FORMULA = ("=", "+", "-", "@", "\t", "\r")  # what spreadsheets take for the beginning of one


def harmless(cell: Any) -> Any:
    """A cell that no spreadsheet runs: a text that begins like a formula, and is no number, gets an apostrophe."""
    if not isinstance(cell, str) or not cell.startswith(FORMULA):
        return cell
    try:
        float(cell)
    except ValueError:
        return f"'{cell}"
    return cell


def csv_bytes(heads: Sequence[str], rows: Iterable[Sequence[Any]]) -> bytes:
    """A line of heads, and one for every row."""
    sink = io.StringIO()
    writer = csv.writer(sink, lineterminator="\n")
    writer.writerows([harmless(cell) for cell in row] for row in (heads, *rows))
    return sink.getvalue().encode()


def frame_csv(frame: pd.DataFrame, float_format: str | None = None) -> bytes:
    """A frame without its index."""
    texts = frame.select_dtypes(include=["object", "string", "category"]).columns
    frame = frame.assign(**{column: frame[column].astype(object).map(harmless) for column in texts})
    frame.columns = [harmless(column) for column in frame.columns]
    return frame.to_csv(index=False, float_format=float_format).encode()
