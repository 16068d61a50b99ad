"""Studies whose tables are written by hand, row by row."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from attnlab.results.conditions import Conditions, Runs
from attnlab.results.load import load
from attnlab.tables.files import write_parquet
from attnlab.tables.schema import SCHEMA, TABLES, columns_of
from tests.report.small_study import write_run

Rows = list[dict[str, Any]]


def plant(study: Path, seed: int = 0, curiosity: str = "none", **tables: Rows) -> Path:
    """One complete run with these rows; a column that a row does not mention is empty."""
    folder = write_run(study, curiosity, seed, train=0, validation=0, cycles=0)
    for table in TABLES:
        lived = {"survival": 1.0} if table == "episodes" else {}
        rows = [{"run": folder.name, "seed": seed, "curiosity": curiosity, **lived, **row}
                for row in tables.get(table, [])]
        names = dict.fromkeys([*SCHEMA[table], *(name for row in rows for name in row)])
        known = columns_of(table, ("avoid", "eat", "drink"), {}, {})
        write_parquet(folder / f"{table}.parquet", {name: [row.get(name) for row in rows] for name in names}, known)
    return folder


def episodes(phase: str, **columns: list) -> Rows:
    """Rows of consecutive episodes from their columns."""
    count = len(next(iter(columns.values())))
    return [{"phase": phase, "episode": i, **{name: values[i] for name, values in columns.items()}}
            for i in range(count)]


def clocks(phase: str, column: str, **behaviours: list) -> Rows:
    """Rows of ``behaviours``: a value of ``column`` an episode, by behaviour."""
    count = len(next(iter(behaviours.values())))
    return [{"phase": phase, "episode": i, "behaviour": name, column: values[i]} for i in range(count)
            for name, values in behaviours.items()]


def policy(behaviour: str, level: str, periods: dict[int, int]) -> Rows:
    """Rows of ``policy`` in which the learned period of a percept is as given."""
    return [{"behaviour": behaviour, "curiosity_level": level, "period": 1, "percept": percept, "action": action,
             "q": float(action == best), "visits": 5}
            for percept, best in periods.items() for action in (1, 4, 12)]


def cells(phase: str, *visited: tuple[int, int, int]) -> Rows:
    """Rows of ``coverage``: x, y, visits."""
    return [{"phase": phase, "x_cell": x, "y_cell": y, "visits": visits} for x, y, visits in visited]


def runs_of(study: Path, curiosity: str = "none") -> Runs:
    return Conditions(load(study)).runs(curiosity)
