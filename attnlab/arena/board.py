"""The leaderboard: a row for each way, place, and seed or block; a file of JSON lines that others can add to."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any

from attnlab.errors import ConfigError
from attnlab.tables.files import write_bytes

FORMAT = "attnlab arena 1"
FIELDS = ("place", "way", "unit", "looks", "harm")


@dataclass(frozen=True)
class Row:
    """One result. ``place``: a world or a log; ``unit``: what it is one of (a seed in a world, a block of a log, the
    mean over seeds); ``looks``: a cycle and behaviour; ``harm``: lost survival, or the share of wrong cycles;
    ``detail``: more numbers, for the table; ``between``: did it learn from percepts between looks; ``made``: command,
    code, settings."""
    place: str
    way: str
    unit: str
    looks: float
    harm: float
    detail: dict[str, float] = field(default_factory=dict)
    between: bool = False
    made: dict[str, Any] = field(default_factory=dict)


def write_board(rows: Iterable[Row], path: Path) -> None:
    """All rows, sorted, a line each."""
    ordered = sorted(rows, key=lambda row: (row.place, row.way, row.unit))
    write_bytes(path, "".join(json.dumps({"format": FORMAT, **asdict(row)}, sort_keys=True) + "\n" for row in ordered)
                .encode())


def short(row: Row) -> Row:
    """With nine digits of each number: so many are kept in a file, and all that is said is said of these."""
    return replace(row, looks=_nine(row.looks), harm=_nine(row.harm),
                   detail={key: _nine(value) for key, value in row.detail.items()})


def _nine(x: float) -> float:
    return float(f"{x:.9g}")


def read_board(path: Path) -> list[Row]:
    """The rows of a file. Raises ConfigError naming the line that is none."""
    if not path.is_file():
        raise ConfigError("--add", f"there is no file {path}")
    rows = []
    for number, line in enumerate(path.read_text(encoding="utf-8", errors="replace").splitlines(), start=1):
        try:
            found = json.loads(line)
            if found.pop("format") != FORMAT:
                raise KeyError("format")
            row = Row(**found)
            good = all(isinstance(getattr(row, name), str) for name in FIELDS[:3]) and isinstance(row.detail, dict)
            if not good or not 0.0 <= float(row.looks) <= 1.0 or not 0.0 <= float(row.harm) <= 1.0:
                raise ValueError("looks and harm are shares between 0 and 1")
            rows.append(row)
        except (KeyError, TypeError, ValueError, AttributeError) as cause:
            raise ConfigError("--add", f"line {number} of {path.name} is no row of a leaderboard: {cause}") from None
    return rows


def merged(rows: Sequence[Row], added: Sequence[Row]) -> list[Row]:
    """Ours and others'. Raises ConfigError where both have the same way, place and unit with other numbers."""
    known = {(row.place, row.way, row.unit): row for row in rows}
    found = list(rows)
    for row in added:
        mine = known.get((row.place, row.way, row.unit))
        if mine is None:
            found.append(row)
        elif (mine.looks, mine.harm) != (row.looks, row.harm):
            raise ConfigError("--add", f"'{row.way}' in {row.place} ({row.unit}) is there already, with other numbers",
                              "Give it another name")
    return found
