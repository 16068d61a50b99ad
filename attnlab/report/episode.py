"""Figures within one episode: the needs (Fig 8A) and the attention raster with the needs below it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from attnlab.report.panels import Line, panels
from attnlab.report.style import GREY, INK, WIDTH_IN, cut, empty
from attnlab.results.conditions import Conditions

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

HUNGER, THIRST = "#009e73", "#56b4e9"  # as food and water are green and blue
MOST = 6


def first_lines(conditions: Conditions, most: int) -> list[tuple[str, Line]]:
    """(title, condition) of the first conditions, one after the other."""
    found = [(cut(f"{line.name}" + (f" ({panel.title})" if panel.title else ""), 44), line)
             for panel in panels(conditions) for line in panel.lines]
    return found[:most]


def last_episode(line: Line):
    """(cycles of the last recorded episode of the first seed that has one, that seed); (None, None) without any."""
    rows = line.runs.rows("cycles")
    if not len(rows):
        return None, None
    seed = int(rows["seed"].min())
    return rows[rows["seed"] == seed], seed


def needs(conditions: Conditions) -> Figure:
    """Fig 8A: hunger and thirst in the last recorded episode of the first seed, a panel a condition."""
    import matplotlib.pyplot as plt
    lines = first_lines(conditions, MOST)
    rows = max(1, len(lines))
    figure, axes = plt.subplots(rows, 1, figsize=(WIDTH_IN, 0.7 + 1.75 * rows), sharex=True, sharey=True, squeeze=False)
    for ax, (title, line) in zip(axes.flat, lines, strict=False):
        cycles, seed = last_episode(line)
        if cycles is None or not _need_lines(ax, cycles):
            empty(ax, "no needs were recorded")
        ax.set_title(title + (f", seed {seed}" if seed is not None else ""), color=line.colour)
        ax.margins(x=0.01)
    if not lines:
        empty(axes[0, 0], "no complete runs")
    _below(figure, axes[:, 0], "need, UoE")
    return figure


def _need_lines(ax: Axes, cycles) -> bool:
    drawn = False
    for need, colour, dash in (("hunger", HUNGER, "-"), ("thirst", THIRST, (0, (5, 1.4)))):
        if cycles[need].notna().any():
            ax.plot(cycles["cycle"], cycles[need], color=colour, ls=dash, lw=1.5, label=need)
            drawn = True
    return drawn


def _below(figure: Figure, axes, unit: str) -> None:
    axes[-1].set_xlabel("machine cycle")
    if unit:
        figure.supylabel(unit, fontsize=9.5)
    handles, labels = axes[0].get_legend_handles_labels()
    if handles:
        figure.legend(handles, labels, loc="outside upper right", ncol=4)


def raster(conditions: Conditions) -> Figure:
    """Who looked when: a tick for every activation in the last recorded episode, coloured by the period granted, with
    hunger and thirst below on the same time axis."""
    import matplotlib.pyplot as plt
    lines = first_lines(conditions, 4)
    rows = max(1, len(lines))
    figure, axes = plt.subplots(2 * rows, 1, figsize=(WIDTH_IN, 0.9 + 2.35 * rows), sharex=True, squeeze=False,
                                height_ratios=[1.25, 1] * rows)
    periods: list[int] = []
    for _, line in lines:
        cycles, _ = last_episode(line)
        if cycles is not None:
            names = [name for name in cycles.columns if name.endswith("_period") and cycles[name].notna().any()]
            periods = sorted({*periods, *(int(v) for name in names for v in cycles[name].dropna().unique())})
    colour = _period_colours(periods)
    for row, (title, line) in enumerate(lines):
        ticks, below = axes[2 * row, 0], axes[2 * row + 1, 0]
        cycles, seed = last_episode(line)
        if cycles is None:
            empty(ticks, "no cycles were recorded")
            continue
        _ticks(ticks, cycles, colour)
        ticks.set_title(f"{title}, seed {seed}", color=line.colour)
        if not _need_lines(below, cycles):
            empty(below, "no needs were recorded")
        below.set_ylabel("need, UoE")
        below.margins(x=0.01)
    if not lines:
        empty(axes[0, 0], "no complete runs")
    axes[-1, 0].set_xlabel("machine cycle")
    _raster_legend(figure, axes, colour)
    return figure


def _period_colours(periods: list[int]) -> dict[int, tuple]:
    import matplotlib
    shades = matplotlib.colormaps["viridis"](np.linspace(0.0, 0.88, max(2, len(periods))))
    return {period: tuple(shade) for period, shade in zip(periods, shades, strict=False)}


def _ticks(ax: Axes, cycles, colour: dict[int, tuple]) -> None:
    names = [name[:-len("_active")] for name in cycles.columns
             if name.endswith("_active") and cycles[name].notna().any()]
    for place, name in enumerate(reversed(names)):
        active = cycles[cycles[f"{name}_active"].astype(bool)]
        for period, group in active.groupby(f"{name}_period"):
            ax.vlines(group["cycle"], place - 0.4, place + 0.4, color=colour[int(period)], lw=0.8)
    ax.set_yticks(range(len(names)), [f"{name.upper()}" for name in reversed(names)])
    ax.set_ylim(-0.6, len(names) - 0.4)
    ax.grid(False)
    ax.margins(x=0.01)
    for place, name in enumerate(reversed(names)):
        ax.text(1.005, place, f"{int(cycles[f'{name}_active'].sum())}", transform=ax.get_yaxis_transform(),
                va="center", ha="left", fontsize=8.5, color=INK)


def _raster_legend(figure: Figure, axes, colour: dict[int, tuple]) -> None:
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
