"""What a measure is, and how one says that it cannot be taken."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pandas as pd

    from attnlab.results.conditions import Runs

PHASES = ("train", "validation")


class CannotMeasure(Exception):
    """The runs lack what a measure needs; the message says what, in words for a reader of the report."""


class Measure(ABC):
    """One number a seed. Subclass it, register it as ``@register("measure", "mine")``, name it in a claims file.

        @register("measure", "meals")
        class Meals(Measure):
            '''Meals an episode.'''
            unit = "meals"
            def of(self, runs):
                return self.means(self.episodes(runs, "validation"), "meals")

    ``unit`` may be set in ``__init__`` when it depends on the parameters. Draws nothing at random; a measure that must
    draw takes its own fixed seed, so that a report is the same twice.
    """
    unit = "1"

    def __init__(self, params: Any, context: Any = None):
        self.params = params

    @abstractmethod
    def of(self, runs: Runs) -> Mapping[int, float]:
        """Seed -> value; nan for a seed that has none. Raises :class:`CannotMeasure` if no seed can have one."""

    # for subclasses

    @staticmethod
    def episodes(runs: Runs, phase: str, within: list[int] | None = None, table: str = "episodes",
                 **equal: Any) -> pd.DataFrame:
        """Rows of a phase; ``within``: [first, end) of the episodes, which all must be there."""
        rows = runs.rows(table, phase=phase, **equal)
        if not len(rows):
            what = "".join(f" of {value}" for value in equal.values())
            raise CannotMeasure(f"there are no {phase} episodes{what}")
        if within:
            has = int(rows["episode"].max()) + 1
            if has < within[1]:
                raise CannotMeasure(f"needs {within[1]} {phase} episodes, the study has {has}")
            rows = rows[(rows["episode"] >= within[0]) & (rows["episode"] < within[1])]
        return rows

    @staticmethod
    def means(rows: pd.DataFrame, column: str) -> dict[int, float]:
        """Mean of a column for each seed."""
        return {int(seed): float(value) for seed, value in rows.groupby("seed")[column].mean().items()}

    @staticmethod
    def last_cycles(runs: Runs) -> dict[int, pd.DataFrame]:
        """The cycles of each seed's last recorded episode."""
        rows = runs.rows("cycles")
        if not len(rows):
            raise CannotMeasure("no cycles were recorded (record=last stores those of the last episode)")
        return {int(seed): group for seed, group in rows.groupby("seed")}


def window(value: list[int] | None, where: str) -> None:
    """Check a [first, end) window of episodes. Raises ConfigError."""
    from attnlab.errors import ConfigError
    if value is not None and (len(value) != 2 or not 0 <= value[0] < value[1]):
        raise ConfigError(where, f"expected [first, end) with 0 <= first < end, got {value}")
