"""What was found here, in one sentence a figure: the numbers that a caption needs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from attnlab.figures.episode import first_lines
from attnlab.figures.panels import block_of, by_episode
from attnlab.measures.base import CannotMeasure, Measure
from attnlab.stats import mean_interval

if TYPE_CHECKING:
    from attnlab.results.conditions import Conditions

MOST = 6


def start_and_end(conditions: Conditions, column: str, unit: str, scale: float = 1.0, block: int = 50,
                  digits: int = 1) -> str:
    """Mean of ``column`` of ``episodes`` in the first and in the last block of training, for each condition."""
    size, parts = block_of(conditions, block), []
    for title, line in first_lines(conditions, MOST):
        _, values = by_episode(line.runs, "episodes", column, size)
        if np.isfinite(values).any():
            first, last = scale * np.nanmean(values[:, 0]), scale * np.nanmean(values[:, -1])
            parts.append(f"{title} {first:.{digits}f} to {last:.{digits}f}{unit}")
    return sentence(parts, f"from the first to the last {size} training episodes: ", conditions)


def validation(conditions: Conditions, measures: Sequence[tuple[str, Measure]], unit: str, digits: int = 0) -> str:
    """Means with intervals of measures (with what they are called) over the validation episodes, by condition."""
    parts = []
    for title, line in first_lines(conditions, MOST):
        words = []
        for name, measure in measures:
            try:
                words.append(f"{name}{interval(measure.of(line.runs), digits)}")
            except CannotMeasure:
                continue
        if words:
            parts.append(f"{title}: {', '.join(words)}{unit}")
    return sentence(parts, "in validation, ", conditions)


def interval(of_seed: Mapping[int, float], digits: int) -> str:
    """``mean [low, high]`` over seeds."""
    value, low, high = mean_interval(list(of_seed.values()))
    return f"{value:.{digits}f}" + (f" [{low:.{digits}f}, {high:.{digits}f}]" if np.isfinite(low) else "")


def sentence(parts: Sequence[str], before: str, conditions: Conditions) -> str:
    """What is said of each condition as one sentence; if not of all, that is said too."""
    if not parts:
        return "Nothing to report: these runs hold no data for it."
    lines = len(first_lines(conditions, 1000))
    text = before + "; ".join(parts) + ("" if lines <= MOST else f" (the first {len(parts)} of {lines} conditions)")
    return text[0].upper() + text[1:] + "."
