"""Attention economics: what a robot gets for the looking it does, next to fixed, random and always-on baselines."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from attnlab.measures.base import CannotMeasure, Measure
from attnlab.measures.rewards import summed
from attnlab.report.panels import Line, panels
from attnlab.report.style import GREY, WIDTH_IN, cut, empty
from attnlab.results.conditions import Conditions
from attnlab.stats import bootstrap_interval

if TYPE_CHECKING:
    from matplotlib.figure import Figure

OUTCOMES = (("survival", "survival, %", 100.0), ("safety_mean", "mean safety, 0-1", 1.0),
            ("need", "mean of hunger and thirst, UoE", 1.0))
MARKERS = "osD^vPX*<>ph"


class Point(NamedTuple):
    """A condition: (cost, outcomes) by seed. ``cost``: activations in 100 cycles, all behaviours together."""
    name: str
    colour: str
    marker: str
    cost: list[float]
    outcomes: dict[str, list[float]]


def points(conditions: Conditions, baselines: Conditions | None = None) -> list[Point]:
    """Conditions in their colours, then the baselines in grey; those without validation episodes use training."""
    found = []
    for source, grey in ((conditions, False), (baselines, True)):
        if source is None:
            continue
        for panel in panels(source):
            for line in panel.lines:
                name = cut(line.name + (f" ({panel.title})" if panel.title else ""), 34)
                marker = MARKERS[len(found) % len(MARKERS)]
                point = _point(line, name, GREY if grey else line.colour, marker)
                if point:
                    found.append(point)
    return found


def _point(line: Line, name: str, colour: str, marker: str) -> Point | None:
    for phase in ("validation", "train"):
        try:
            episodes = Measure.episodes(line.runs, phase)
            acts = Measure.means(summed(line.runs, phase, "all", "activations"), "value")
        except CannotMeasure:
            continue
        episodes = episodes.assign(need=episodes[["hunger_mean", "thirst_mean"]].mean(axis=1))
        cycles = Measure.means(episodes, "cycles")
        seeds = sorted(acts)
        outcomes = {}
        for column, _, scale in OUTCOMES:
            of_seed = Measure.means(episodes, column)
            outcomes[column] = [scale * of_seed.get(seed, float("nan")) for seed in seeds]
        return Point(name, colour, marker, [100 * acts[s] / cycles[s] for s in seeds], outcomes)
    return None


def economics(conditions: Conditions, baselines: Conditions | None = None) -> Figure:
    """Outcome against activations, three panels; small dots are seeds, crosses 95 % intervals of their means."""
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(1, 3, figsize=(WIDTH_IN, 3.7))
    drawn = points(conditions, baselines)
    for ax, (column, unit, _) in zip(axes, OUTCOMES, strict=True):
        for point in drawn:
            y = point.outcomes[column]
            if not np.isfinite(y).any():
                continue
            cx, cy = bootstrap_interval(point.cost), bootstrap_interval(y)
            ax.plot(point.cost, y, ls="", marker=point.marker, ms=3, alpha=0.35, mew=0, color=point.colour)
            if np.isfinite(cx.low) and np.isfinite(cy.low):
                ax.plot([cx.low, cx.high], [cy.value] * 2, color=point.colour, lw=1.2)
                ax.plot([cx.value] * 2, [cy.low, cy.high], color=point.colour, lw=1.2)
            ax.plot(cx.value, cy.value, ls="", marker=point.marker, ms=8, color=point.colour, mec="white", mew=0.8,
                    label=point.name)
        ax.set_ylabel(unit)
        ax.margins(0.08)
        if not ax.lines:
            empty(ax, "not recorded")
    figure.supxlabel("activations in 100 cycles, all behaviours together", fontsize=9.5)
    handles, labels = axes[0].get_legend_handles_labels()
    if handles:
        figure.legend(handles, labels, loc="outside upper left", ncol=min(4, len(handles)), handletextpad=0.3)
    return figure
