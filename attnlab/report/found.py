"""What was found here, in one sentence a figure: the numbers that a caption needs."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from attnlab.measures.base import CannotMeasure, Measure
from attnlab.measures.body import consumed
from attnlab.measures.space import Coverage
from attnlab.report.economics import points
from attnlab.report.episode import first_lines, last_episode
from attnlab.report.panels import block_of, by_episode
from attnlab.report.policies import learned
from attnlab.results.conditions import Conditions
from attnlab.stats import bootstrap_interval

MOST = 6


def start_and_end(column: str, unit: str, scale: float = 1.0, block: int = 50, digits: int = 1) -> Callable:
    """A caption: mean of the first and of the last block of training, for each condition."""
    def say(conditions: Conditions) -> str:
        size, parts = block_of(conditions, block), []
        for title, line in first_lines(conditions, MOST):
            _, values = by_episode(line.runs, "episodes", column, size)
            if np.isfinite(values).any():
                first, last = scale * np.nanmean(values[:, 0]), scale * np.nanmean(values[:, -1])
                parts.append(f"{title} {first:.{digits}f} to {last:.{digits}f}{unit}")
        return _join(parts, f"from the first to the last {size} training episodes: ", conditions)
    return say


def validation(measures: list[tuple[str, Measure]], unit: str, digits: int = 0) -> Callable:
    """A caption: means with intervals over the validation episodes, for each condition."""
    def say(conditions: Conditions) -> str:
        parts = []
        for title, line in first_lines(conditions, MOST):
            words = []
            for name, measure in measures:
                try:
                    words.append(f"{name}{_interval(measure.of(line.runs), digits)}")
                except CannotMeasure:
                    continue
            if words:
                parts.append(f"{title}: {', '.join(words)}{unit}")
        return _join(parts, "in validation, ", conditions, "; ")
    return say


def _interval(of_seed, digits: int) -> str:
    value, low, high = bootstrap_interval(list(of_seed.values()))
    return f"{value:.{digits}f}" + (f" [{low:.{digits}f}, {high:.{digits}f}]" if np.isfinite(low) else "")


def coverage(conditions: Conditions) -> str:
    parts = []
    for title, line in first_lines(conditions, MOST):
        try:
            cells, body = (_interval(Coverage(Coverage.Params(phase="train", footprint=f)).of(line.runs), 1)
                           for f in (False, True))
            parts.append(f"{title} {cells} % by the centre and {body} % by the body")
        except CannotMeasure:
            continue
    return _join(parts, "floor covered in training: ", conditions)


def meals(conditions: Conditions) -> str:
    parts = []
    for title, line in first_lines(conditions, MOST):
        cycles, seed = last_episode(line)
        try:
            if cycles is not None:
                ate, drank = consumed(cycles)
                parts.append(f"{title} (seed {seed}) ate {len(ate)} and drank {len(drank)} times in {len(cycles)} "
                             "cycles")
        except CannotMeasure:
            continue
    return _join(parts, "", conditions)


def looks(conditions: Conditions) -> str:
    parts = []
    for title, line in first_lines(conditions, 4):
        cycles, _ = last_episode(line)
        if cycles is None:
            continue
        names = [n[:-7] for n in cycles.columns if n.endswith("_active") and cycles[n].notna().any()]
        active = cycles[[f"{n}_active" for n in names]].to_numpy(bool)
        counts = ", ".join(f"{n.upper()} {int(active[:, i].sum())}" for i, n in enumerate(names))
        parts.append(f"{title} looked {int(active.sum())} times ({counts}) in {int(active.any(axis=1).sum())} of "
                     f"{len(active)} cycles")
    return _join(parts, "in the episode shown, ", conditions)


def policies(conditions: Conditions) -> str:
    tables = learned(conditions)
    drink = [t for t in tables if t.behaviour == "drink"] or tables
    parts = [f"{t.condition} {t.behaviour.upper()}" + (f", {t.level}" if t.level != "none" else "") + f": {t.words}"
             for t in drink[:8]]
    return _join(parts, "", conditions, "; ")


def costs(conditions: Conditions, baselines: Conditions | None = None) -> str:
    parts = [f"{p.name} {np.mean(p.cost):.0f} activations in 100 cycles for {np.nanmean(p.outcomes['survival']):.1f} % "
             "survival" for p in points(conditions, baselines)[:10]]
    return _join(parts, "", conditions, "; ")


def _join(parts: list[str], before: str, conditions: Conditions, between: str = "; ") -> str:
    if not parts:
        return "Nothing to report: these runs hold no data for it."
    lines = len(first_lines(conditions, 1000))
    text = before + between.join(parts) + ("" if lines <= MOST else f" (the first {len(parts)} of {lines} conditions)")
    return text[0].upper() + text[1:] + "."
