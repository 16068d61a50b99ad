"""Attention economics: what a robot gets for the looking it does, next to fixed, random and always-on baselines."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from attnlab.figures.base import Figure
from attnlab.figures.episode import first_lines
from attnlab.figures.found import sentence
from attnlab.figures.panels import Line, panels
from attnlab.figures.style import GREY, WIDTH_IN, cut, empty
from attnlab.measures.base import CannotMeasure, Measure
from attnlab.measures.needs import units_of
from attnlab.measures.rewards import mean_sums
from attnlab.registry import register
from attnlab.stats import bootstrap_interval

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawing

    from attnlab.results.conditions import Conditions

MARKERS = "osD^vPX*<>ph"
MOST, MOST_MARKS, SAID = 24, 10, 10  # conditions that are drawn, can be told apart in a panel, and in a sentence


class Point(NamedTuple):
    """A condition: (cost, outcomes) by seed. ``cost``: activations in 100 cycles, all behaviours together; outcomes:
    survival (%), safety (0-1), need."""
    name: str
    colour: str
    marker: str
    cost: list[float]
    outcomes: dict[str, list[float]]
    gid: str


@register("figure", "attention_economics")
class Economics(Figure):
    """Outcome against activations, three panels; small marks are seeds, crosses 95 % intervals of their means. More
    conditions than can be told apart are ranked."""
    title, order = "Attention economics", 140
    how = "Large marks are means with 95 % intervals, small ones seeds; grey: baselines, if given. More than 10 " \
        "conditions are ranked by how they survive."

    def draw(self, conditions: Conditions) -> Drawing:
        import matplotlib.pyplot as plt
        drawn, (needs, unit) = points(conditions, self.context.baselines, MOST), common_needs(conditions)
        every = len(first_lines(conditions, 10_000))
        note = f" (the first {MOST} of {every} conditions)" if every > MOST else ""
        if len(drawn) > MOST_MARKS:
            return _ranked(drawn, f"mean of {_and(needs)}, {unit}", note)
        lines_of_legend = -(-len(drawn) // 4)
        figure, axes = plt.subplots(1, 3, figsize=(WIDTH_IN, 3.7 + 0.22 * max(0, lines_of_legend - 3)))
        labels = {"survival": "survival, %", "safety": "mean safety, 0-1", "need": f"mean of {_and(needs)}, {unit}"}
        for ax, (outcome, label) in zip(axes, labels.items(), strict=True):
            for point in drawn:
                y = point.outcomes[outcome]
                if not np.isfinite(y).any():
                    continue
                cx, cy = bootstrap_interval(point.cost), bootstrap_interval(y)
                ax.plot(point.cost, y, ls="", marker=point.marker, ms=3, alpha=0.35, mew=0, color=point.colour,
                        gid=point.gid)
                if np.isfinite(cx.low) and np.isfinite(cy.low):
                    ax.plot([cx.low, cx.high], [cy.value] * 2, color=point.colour, lw=1.2, gid=point.gid)
                    ax.plot([cx.value] * 2, [cy.low, cy.high], color=point.colour, lw=1.2, gid=point.gid)
                ax.plot(cx.value, cy.value, ls="", marker=point.marker, ms=8, color=point.colour, mec="white", mew=0.8,
                        label=point.name, gid=point.gid)
            ax.set_ylabel(label)
            ax.margins(0.08)
            if not ax.lines:
                empty(ax, "not recorded")
        figure.supxlabel(f"activations in 100 cycles, all behaviours together{note}", fontsize=9.5)
        handles, names = axes[0].get_legend_handles_labels()
        if handles:
            figure.legend(handles, names, loc="outside upper left", ncol=min(4, len(handles)), handletextpad=0.3)
        return figure

    def say(self, conditions: Conditions) -> str:
        parts = [f"{p.name} {np.mean(p.cost):.0f} activations in 100 cycles for "
                 f"{np.nanmean(p.outcomes['survival']):.1f} % survival"
                 for p in points(conditions, self.context.baselines, SAID)]
        return sentence(parts, "", conditions)


def _ranked(drawn: Sequence[Point], need: str, note: str) -> Drawing:
    """A row a condition: what it spends, and what it gets for that; who survives most is on top."""
    import matplotlib.pyplot as plt
    order = sorted(drawn, key=lambda of: float(np.nan_to_num(np.mean(of.outcomes["survival"]), nan=-np.inf)))
    columns = {"activations in 100 cycles": [of.cost for of in order],
               **{label: [of.outcomes[key] for of in order] for key, label in
                  (("survival", "survival, %"), ("safety", "mean safety, 0-1"), ("need", need))}}
    figure, axes = plt.subplots(1, len(columns), figsize=(WIDTH_IN, 1.1 + 0.21 * len(order)), sharey=True)
    for ax, (label, rows) in zip(axes, columns.items(), strict=True):
        for place, (of, values) in enumerate(zip(order, rows, strict=True)):
            if not np.isfinite(values).any():
                continue
            mean, low, high = bootstrap_interval(values)[:3]
            ax.plot(values, [place] * len(values), ls="", marker="o", ms=2.5, alpha=0.35, mew=0, color=of.colour,
                    gid=of.gid)
            if np.isfinite(low):
                ax.plot([low, high], [place, place], color=of.colour, lw=1.6, gid=of.gid)
            ax.plot(mean, place, "o", ms=4.5, color=of.colour, gid=of.gid)
        ax.set_title(label.replace(", ", ",\n", 1) if len(label) > 22 else label, fontsize=8.5)
        ax.locator_params(axis="x", nbins=4)
        ax.tick_params(axis="x", labelsize=7.5)
    axes[0].set_yticks(range(len(order)), [cut(of.name, 30) for of in order])
    figure.supxlabel(f"means over seeds with 95 % intervals{note}", fontsize=9.5)
    return figure


def common_needs(conditions: Conditions) -> tuple[list[str], str]:
    """(needs whose mean is the outcome, their unit): those in the unit of the first, for others cannot be added."""
    units = units_of(conditions)
    unit = next(iter(units.values()))
    return [need for need, of in units.items() if of == unit], unit


def points(conditions: Conditions, baselines: Conditions | None, most: int) -> list[Point]:
    """The first conditions in their colours, then the baselines in grey; those without validation episodes use
    training."""
    found: list[Point] = []
    needs = common_needs(conditions)[0]
    for source, grey in ((conditions, False), (baselines, True)):
        lines = [(panel, line) for panel in panels(source) for line in panel.lines] if source is not None else []
        for panel, line in lines[:most]:
            name = cut(line.name + (f" ({panel.title})" if panel.title else ""), 34)
            marker = MARKERS[len(found) % len(MARKERS)]
            point = _point(line, name, GREY if grey else line.colour, marker, needs)
            if point:
                found.append(point)
    return found


def _point(line: Line, name: str, colour: str, marker: str, needs: list[str]) -> Point | None:
    for phase in ("validation", "train"):
        try:
            episodes = Measure.episodes(line.runs, phase)
            acts = mean_sums(line.runs, phase, "all", "activations")
        except CannotMeasure:
            continue
        columns = [f"{need}_mean" for need in needs if f"{need}_mean" in episodes]
        episodes = episodes.assign(need=episodes[columns].mean(axis=1))
        cycles = Measure.means(episodes, "cycles")
        outcomes = {}
        for outcome, column, scale in (("survival", "survival", 100.0), ("safety", "safety_mean", 1.0),
                                       ("need", "need", 1.0)):
            of_seed = Measure.means(episodes, column)
            outcomes[outcome] = [scale * of_seed.get(seed, float("nan")) for seed in sorted(acts)]
        return Point(name, colour, marker, [100 * acts[s] / cycles[s] for s in sorted(acts)], outcomes,
                     line.gid)
    return None


def _and(words: list[str]) -> str:
    return " and ".join(filter(None, [", ".join(words[:-1]), words[-1]]))
