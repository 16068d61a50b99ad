"""What each run comes to in a few numbers: those in its run.json, or from its tables where a version kept none."""

from __future__ import annotations

from typing import Any

from attnlab.results.load import Study
from attnlab.tables.numbers import kept, numbers_of


def by_run(study: Study) -> dict[str, dict[str, Any]]:
    """Every complete run -> its numbers (:func:`attnlab.tables.numbers.numbers_of`). Tables are read only if one lacks
    them."""
    found = {run: kept(study.about(run)) for run in study.named()}
    numbers = {run: of for run, of in found.items() if of is not None}
    if len(numbers) < len(found):
        frames = {name: getattr(study, name) for name in ("episodes", "behaviours")}
        for run in study.named():  # without those whose tables turned out to be damaged
            if run not in numbers:
                mine = {name: frame[frame["run"] == run] for name, frame in frames.items()}
                numbers[run] = numbers_of({name: {str(column): list(values) for column, values in frame.items()}
                                           for name, frame in mine.items()})
    return {run: numbers[run] for run in study.named()}
