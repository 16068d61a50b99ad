"""What a measure is, and how one says that it cannot be taken."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal

from attnlab.measures import frames

if TYPE_CHECKING:
    import pandas as pd

    from attnlab.results.conditions import Runs

Phase = Literal["train", "validation"]


class CannotMeasure(Exception):
    """The runs lack what a measure needs; the message says what, in words for a reader of the report."""


class Measure(ABC):
    """One number a seed. Subclass it, register it as ``@register("measure", "mine")``, name it in a claims file.

        @register("measure", "meals")
        class Meals(Measure):
            '''Meals an episode.'''
            unit = "meals"
            def of(self, runs: Runs) -> dict[int, float]:
                return self.mean_of(runs, "meals", "validation")

    ``unit`` may be set in ``__init__`` when it depends on the parameters. ``bounds``: the least and the most that it
    can be, so that a rule that cannot fail is refused. ``censored``: may a seed's value be inf, for what had not
    happened when watching ended? ``compares_seeds``: is a seed's value about how it differs from the others, so that it
    changes with them? Draws nothing at random; a measure that must draw takes its own fixed seed, so that a report is
    the same twice.
    """
    unit = "1"
    bounds: tuple[float, float] = (float("-inf"), float("inf"))
    censored = False
    compares_seeds = False

    def __init__(self, params: Any, context: Any = None):
        self.params = params

    @abstractmethod
    def of(self, runs: Runs) -> Mapping[int, float]:
        """Seed -> value; nan for a seed that has none. Raises :class:`CannotMeasure` if no seed can have one."""

    # for subclasses

    @staticmethod
    def check_episodes(runs: Runs, phase: str, within: Sequence[int] | None = None, table: str = "episodes"
                       ) -> frames.Window:
        """Raise CannotMeasure unless there are episodes of this phase, and all of ``within`` = [first, end)."""
        counts = frames.of_seeds(runs, frames.episode_counts(runs.conditions, table, phase))
        if not counts:
            raise CannotMeasure(f"there are no {phase} episodes")
        if within and max(counts.values()) < within[1]:
            raise CannotMeasure(f"needs {within[1]} {phase} episodes, the study has {max(counts.values())}")
        return (within[0], within[1]) if within else None

    @classmethod
    def mean_of(cls, runs: Runs, column: str, phase: str, within: Sequence[int] | None = None) -> dict[int, float]:
        """Mean of a column of ``episodes`` for each seed."""
        window = cls.check_episodes(runs, phase, within)
        return frames.of_seeds(runs, frames.episode_means(runs.conditions, column, phase, window))

    @classmethod
    def episodes(cls, runs: Runs, phase: str, within: Sequence[int] | None = None, table: str = "episodes"
                 ) -> pd.DataFrame:
        """Rows of a phase; ``within``: [first, end) of the episodes, which all must be there."""
        cls.check_episodes(runs, phase, within, table)
        rows = runs.rows(table, phase=phase)
        return rows[(rows["episode"] >= within[0]) & (rows["episode"] < within[1])] if within else rows

    @staticmethod
    def means(rows: pd.DataFrame, column: str) -> dict[int, float]:
        """Mean of a column for each seed."""
        return {int(str(seed)): float(value) for seed, value in rows.groupby("seed")[column].mean().items()}

    @staticmethod
    def last_cycles(runs: Runs) -> dict[int, pd.DataFrame]:
        """The cycles of each seed's last recorded episode."""
        found = frames.of_seeds(runs, frames.last_cycles(runs.conditions))
        if not found:
            raise CannotMeasure("no cycles were recorded (record=last stores those of the last episode)")
        return found


def window(value: list[int] | None, where: str) -> None:
    """Check a [first, end) window of episodes. Raises ConfigError."""
    from attnlab.errors import ConfigError
    if value is not None and (len(value) != 2 or not 0 <= value[0] < value[1]):
        raise ConfigError(where, f"expected [first, end) with 0 <= first < end, got {value}")
