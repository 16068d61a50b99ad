"""Curves along training episodes: a panel a combination of settings, a line a condition."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from attnlab.figures.many import crowded, multiples
from attnlab.figures.panels import Line, Panel, band, block_of, by_episode, grid, legend, shown, title_of_lines
from attnlab.figures.style import cut, empty, seeds_note

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from attnlab.results.conditions import Conditions

MOST_ROWS = 4  # combinations of settings drawn where each takes a row of panels


def one_curve(conditions: Conditions, name: str, column: str, wanted: int, unit: str, scale: float = 1.0,
              over: Callable[[Axes, Panel], None] | None = None, **style: Any) -> Figure:
    """``column`` of ``episodes`` times ``scale``, in means of ``wanted`` training episodes; ``over`` adds to a panel,
    ``unit`` is the label of the axis."""
    drawn, note = shown(conditions)
    block = block_of(conditions, wanted)

    def curve(line: Line) -> tuple[np.ndarray, np.ndarray]:
        x, values = by_episode(line.runs, "episodes", column, block)
        return x, scale * values
    if crowded(drawn):
        figure, axes, more = multiples(drawn, curve, over, **style)
        finish(figure, axes, conditions, name, block, unit, " ".join(filter(None, (note, more))), True)
        return figure
    figure, axes = grid(max(1, len(drawn)), 3.5, sharex=True, sharey=True)
    for ax, panel in zip(axes, drawn, strict=False):
        for line in panel.lines:
            x, values = curve(line)
            if np.isfinite(values).any():
                band(ax, x, values, line, **style)
        if over:
            over(ax, panel)
        ax.set_title(cut(panel.title, 105 // min(3, len(drawn))))
        ax.margins(x=0.02)
        if not ax.lines:
            empty(ax, f"no {column} in these runs")
    if not drawn:
        empty(axes[0], "no complete runs")
    finish(figure, axes, conditions, name, block, unit, note)
    return figure


def rows_of_panels(conditions: Conditions) -> tuple[list[Panel], str]:
    """Combinations of settings for a figure that gives each a row of panels, and a note if there are more."""
    drawn, note = shown(conditions)
    if len(drawn) > MOST_ROWS:
        return drawn[:MOST_ROWS], f"The first {MOST_ROWS} combinations of settings are drawn."
    return drawn, note


def finish(figure: Figure, axes: list[Axes], conditions: Conditions, name: str, block: int, unit: str,
           note: str, named: bool = False) -> None:
    """Labels, heading, and, where lines are not ``named`` by their panels, the legend of a figure along training."""
    from matplotlib.ticker import MaxNLocator
    figure.supylabel(unit, fontsize=9.5)
    places = [(ax, place) for ax in axes if (place := ax.get_subplotspec()) is not None]
    lowest = {place.colspan.start: ax for ax, place in places}
    means = f"{' ' if len(lowest) < 4 else chr(10)}(means of {block})" if block > 1 else ""
    for ax in lowest.values():  # not the figure's own label: a legend below would lie upon it
        ax.set_xlabel(f"training episodes{means}")
    for ax in axes:
        if ax.lines:  # an empty panel has no ticks to speak of
            ax.xaxis.set_major_locator(MaxNLocator(integer=True, nbins="auto", steps=[1, 2, 2.5, 5, 10]))
    if not named:
        legend(figure, axes, title_of_lines(conditions))
    under = f"{seeds_note(conditions)}\n{note}" if note else seeds_note(conditions)
    figure.suptitle(f"{name}\n{under}", x=0.01, ha="left", fontsize=9.5)
