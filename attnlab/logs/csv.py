"""CSV of ranges: a row a scan."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import chain
from math import radians
from typing import IO

from attnlab.errors import ConfigError
from attnlab.logs.base import Beams, Ledger, LogSettings, Pose, Raw, text_lines

RANGE_MAX_M = 5.0  # of a sonar
BEAM = re.compile(r"r(-?\d+(?:\.\d+)?)$")  # r-15: the range at 15 degrees to the right
POSE = ("x_m", "y_m", "heading_rad")


def read(stream: IO[bytes], settings: LogSettings, ledger: Ledger) -> Iterator[Raw]:
    """Scans of a CSV.

    With a header: ``t_s``, ranges ``r<bearing in degrees>`` (left positive), perhaps ``x_m,y_m,heading_rad``; other
    columns are left alone. Without: every number of a row is a range, words at its end are left alone, and times and
    bearings are ``rate_hz``, ``first_deg``, ``step_deg``. Raises ConfigError if the first row is neither.
    """
    lines = text_lines(stream, ledger)
    first = next(lines, None)
    if first is None:
        raise ConfigError("log", "the file is empty")
    cells = [cell.strip() for cell in first[1].split(",")]
    if any(BEAM.match(cell) for cell in cells):
        yield from _with_header(cells, lines, settings, ledger)
    else:
        yield from _bare(_numbers(cells), chain([first], lines), settings, ledger)


def _with_header(names: list[str], lines: Iterator[tuple[int, str]], settings: LogSettings, ledger: Ledger
                 ) -> Iterator[Raw]:
    if "t_s" not in names:
        raise ConfigError("log", "its header has no column t_s", "Columns: t_s, r<bearing in degrees>, ..., perhaps "
                          "x_m, y_m, heading_rad")
    if len(set(names)) < len(names):
        raise ConfigError("log", "its header names a column twice")
    columns = [(i, float(found[1])) for i, name in enumerate(names) if (found := BEAM.match(name))]
    beams = _beams([bearing for _, bearing in columns], settings)
    posed = [names.index(name) for name in POSE] if set(POSE) <= set(names) else None
    when = names.index("t_s")
    for number, line in lines:
        row = line.split(",")
        if len(row) != len(names):
            ledger.skip("row of another number of columns", f"line {number}")
            continue
        try:
            pose: Pose | None = None
            if posed:
                x, y, heading = (float(row[i]) for i in posed)
                pose = x, y, heading
            ranges = tuple(float(row[i] or "nan") for i, _ in columns)
            yield Raw(float(row[when]), ranges, beams, pose, f"line {number}")
        except ValueError:
            ledger.skip("row that is no numbers", f"line {number}")


def _bare(first: list[float], lines: Iterator[tuple[int, str]], settings: LogSettings, ledger: Ledger) -> Iterator[Raw]:
    count = len(first)
    if count < 2:
        raise ConfigError("log", "its first row is neither ranges nor a header with r<bearing> columns",
                          "docs/logs.md has the formats")
    step = -360.0 / count if settings.step_deg is None else settings.step_deg
    ledger.note(f"no header: taken as {count} ranges, the first at {settings.first_deg:g} degrees, the next "
                f"{step:+g} degrees from it, {settings.rate_hz:g} rows a second")
    beams = _beams([settings.first_deg + i * step for i in range(count)], settings)
    for row, (number, line) in enumerate(lines):
        ranges = _numbers(line.split(","))
        if not ranges:
            ledger.skip("row that is no numbers", f"line {number}")
        else:
            yield Raw(row / settings.rate_hz, tuple(ranges), beams, None, f"line {number}")


def _beams(bearings_deg: list[float], settings: LogSettings) -> Beams:
    return Beams(tuple(map(radians, bearings_deg)), settings.range_min_m, settings.range_max_m or RANGE_MAX_M)


def _numbers(cells: list[str]) -> list[float]:
    """The numbers that a row begins with; none if a word is among them."""
    found: list[float] = []
    words = False
    for cell in cells:
        try:
            value = float(cell or "nan")
        except ValueError:
            words = True
            continue
        if words:
            return []
        found.append(value)
    return found
