"""Who looked when: the activations of an episode on one time axis with its needs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from attnlab.figures.base import Figure
from attnlab.figures.episode import first_lines, label_of_needs, last_episode, need_lines, period_colours
from attnlab.figures.found import sentence
from attnlab.figures.style import GREY, INK, WIDTH_IN, empty
from attnlab.measures.needs import units_of
from attnlab.registry import register

if TYPE_CHECKING:
    import matplotlib.figure
    import pandas as pd
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Drawing

    from attnlab.figures.episode import Shade
    from attnlab.results.conditions import Conditions

MOST = 4


@register("figure", "attention_raster")
class Raster(Figure):
    """A tick for every activation in the last recorded episode, coloured by the period granted, needs below."""
    title, order = "Who looked when", 130
    how = ("Each tick is an activation, its colour the period until the next look; the needs below on the same "
           "axis.")

    def draw(self, conditions: Conditions) -> Drawing:
        import matplotlib.pyplot as plt
        lines = first_lines(conditions, MOST)
        rows = max(1, len(lines))
        figure, axes = plt.subplots(2 * rows, 1, figsize=(WIDTH_IN, 0.9 + 2.35 * rows), sharex=True, squeeze=False,
                                    height_ratios=[1.25, 1] * rows)
        periods: list[int] = []
        for _, line in lines:
            cycles, _ = last_episode(line)
            if cycles is not None:
                names = [name for name in cycles.columns if name.endswith("_period") and cycles[name].notna().any()]
                periods = sorted({*periods, *(int(v) for name in names for v in cycles[name].dropna().unique())})
        colour = period_colours(periods)
        for row, (title, line) in enumerate(lines):
            ticks, below = axes[2 * row, 0], axes[2 * row + 1, 0]
            cycles, seed = last_episode(line)
            if cycles is None:
                empty(ticks, "no cycles were recorded")
                continue
            _ticks(ticks, cycles, colour)
            ticks.set_title(f"{title}, seed {seed}", color=line.colour)
            if not need_lines(below, cycles, units_of(conditions)):
                empty(below, "no needs were recorded")
            below.set_ylabel(label_of_needs(conditions))
            below.margins(x=0.01)
        if not lines:
            empty(axes[0, 0], "no complete runs")
        axes[-1, 0].set_xlabel("machine cycle")
        _legend(figure, axes, colour)
        return figure

    def say(self, conditions: Conditions) -> str:
        parts = []
        for title, line in first_lines(conditions, MOST):
            cycles, _ = last_episode(line)
            if cycles is None:
                continue
            names = _active(cycles)
            active = cycles[[f"{n}_active" for n in names]].to_numpy(bool)
            counts = ", ".join(f"{n.upper()} {int(active[:, i].sum())}" for i, n in enumerate(names))
            parts.append(f"{title} looked {int(active.sum())} times ({counts}) in {int(active.any(axis=1).sum())} of "
                         f"{len(active)} cycles")
        return sentence(parts, "in the episode shown, ", conditions)


def _active(cycles: pd.DataFrame) -> list[str]:
    """Behaviours that this robot has."""
    return [name[:-len("_active")] for name in cycles.columns
            if name.endswith("_active") and cycles[name].notna().any()]


def _ticks(ax: Axes, cycles: pd.DataFrame, colour: dict[int, Shade]) -> None:
    names = _active(cycles)
    for place, name in enumerate(reversed(names)):
        active = cycles[cycles[f"{name}_active"].astype(bool)]
        for period, group in active.groupby(f"{name}_period"):
            ax.vlines(group["cycle"], place - 0.4, place + 0.4, color=colour[int(float(str(period)))], lw=0.8)
    ax.set_yticks(range(len(names)), [f"{name.upper()}" for name in reversed(names)])
    ax.set_ylim(-0.6, len(names) - 0.4)
    ax.grid(False)
    ax.margins(x=0.01)
    for place, name in enumerate(reversed(names)):
        ax.text(1.005, place, f"{int(cycles[f'{name}_active'].sum())}", transform=ax.get_yaxis_transform(),
                va="center", ha="left", fontsize=8.5, color=INK)


def _legend(figure: matplotlib.figure.Figure, axes: Any, colour: dict[int, Shade]) -> None:
    from matplotlib.lines import Line2D
    handles = [Line2D([], [], color=shade, lw=3, label=f"next look in {period}") for period, shade in colour.items()]
    needs_drawn = next((ax for ax in axes[1::2, 0] if ax.get_legend_handles_labels()[0]), None)
    if needs_drawn is not None:
        handles += needs_drawn.get_legend_handles_labels()[0]
    if handles:
        figure.legend(handles=handles, loc="outside upper left", ncol=min(7, len(handles)), columnspacing=1.2,
                      handlelength=1.6)
    if any(len(ax.texts) for ax in axes[:, 0]):
        figure.text(0.995, 0.004, "number at the right: activations", ha="right", va="bottom", fontsize=8, color=GREY)
