"""Rows and means of every run of a study, each found once; a measure of a condition looks its runs up.

Rows come from :meth:`Conditions.frame`; ``run`` -> value is turned into ``seed`` -> value by :func:`of_seeds`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, TypeVar

from attnlab.measures.once import once_a_study

if TYPE_CHECKING:
    import pandas as pd

    from attnlab.results.conditions import Conditions, Runs

Value = TypeVar("Value")
Window = tuple[int, int] | None  # [first, end) of the episodes


def of_seeds(runs: Runs, values: Mapping[str, Value]) -> dict[int, Value]:
    """Seed -> value of the runs that have one, in the order of the seeds."""
    return {seed: values[run] for seed, run in sorted(runs.runs.items()) if run in values}


def split(frame: pd.DataFrame) -> dict[str, pd.DataFrame]:
    """Run -> its rows. Runs stand one after the other, so that these are views."""
    if not len(frame):
        return {}
    places = frame.groupby("run", observed=True).indices
    return {str(run): frame.iloc[slice(at[0], at[-1] + 1) if at[-1] - at[0] + 1 == len(at) else at]
            for run, at in places.items()}


@once_a_study
def phase_rows(conditions: Conditions, table: str, phase: str) -> pd.DataFrame:
    """All rows of a phase."""
    frame = conditions.frame(table)
    return frame[frame["phase"] == phase] if len(frame) else frame


@once_a_study
def episode_counts(conditions: Conditions, table: str, phase: str) -> dict[str, int]:
    """Run -> how many episodes of a phase it has."""
    rows = phase_rows(conditions, table, phase)
    if not len(rows):
        return {}
    return {str(run): int(last) + 1 for run, last in rows.groupby("run", observed=True)["episode"].max().items()}


@once_a_study
def window_rows(conditions: Conditions, table: str, phase: str, within: Window) -> pd.DataFrame:
    """Rows of the episodes in a window, or of all of a phase."""
    rows = phase_rows(conditions, table, phase)
    return rows if within is None else rows[(rows["episode"] >= within[0]) & (rows["episode"] < within[1])]


@once_a_study
def episode_means(conditions: Conditions, column: str, phase: str, within: Window) -> dict[str, float]:
    """Run -> mean of a column of ``episodes``."""
    return means(window_rows(conditions, "episodes", phase, within), column)


@once_a_study
def last_cycles(conditions: Conditions) -> dict[str, pd.DataFrame]:
    """Run -> cycles of its last recorded episode."""
    return split(conditions.frame("cycles"))


def means(rows: pd.DataFrame, column: str) -> dict[str, float]:
    """Run -> mean of a column."""
    return {str(run): float(value) for run, value in rows.groupby("run", observed=True)[column].mean().items()}
