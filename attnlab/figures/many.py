"""More conditions than lines can be told apart: small multiples of a curve, and conditions in rank."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from attnlab.figures.panels import Line, Panel, band, grid
from attnlab.figures.style import GREY, WIDTH_IN, cut, empty
from attnlab.stats import mean, mean_interval

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST_LINES, MOST_SMALL, COLUMNS, ROW_IN, LAST = 7, 24, 4, 1.75, 5  # LAST: of so many parts of training the last
Curve = Callable[[Line], tuple[np.ndarray, np.ndarray]]  # (x, values of shape (seeds, x)) of a condition


def crowded(drawn: Sequence[Panel]) -> bool:
    """Has a panel more lines than can be told apart?"""
    return any(len(panel.lines) > MOST_LINES for panel in drawn)


def multiples(drawn: Sequence[Panel], curve: Curve, over: Callable[[Axes, Panel], None] | None = None, **style: Any
              ) -> tuple[Figure, list[Axes], str]:
    """A small panel for every condition, with the others of its settings behind it in grey; a note if there are more
    than 24. ``over`` adds to a panel."""
    pairs = [(panel, line) for panel in drawn for line in panel.lines]
    curves = {id(line): curve(line) for _, line in pairs}
    figure, axes = grid(min(MOST_SMALL, len(pairs)), ROW_IN, COLUMNS, sharex=True, sharey=True)
    for ax, (panel, line) in zip(axes, pairs, strict=False):
        for other in panel.lines:
            x, values = curves[id(other)]
            if other is not line and np.isfinite(values).any():
                ax.plot(x, [mean(column) for column in values.T], color="#cccccc", lw=0.6)
        x, values = curves[id(line)]
        if np.isfinite(values).any():
            band(ax, x, values, line, **style)
        else:
            empty(ax, "not recorded")
        if over:
            over(ax, panel)
        ax.set_title(cut(f"{line.name} ({panel.title})" if panel.title else line.name, 26), fontsize=8.5)
        ax.margins(x=0.02)
    more = f"The first {MOST_SMALL} of {len(pairs)} conditions are drawn." if len(pairs) > MOST_SMALL else ""
    return figure, axes, more


def ranked(drawn: Sequence[Panel], columns: dict[str, Curve], unit: str) -> tuple[Figure, str]:
    """Each condition's mean over the last fifth of training with its t interval over seeds, a column a measure, best in
    the last column on top; a note that says so."""
    pairs = [(panel, line) for panel in drawn for line in panel.lines]
    ends = {title: [_end(*curve(line)) for _, line in pairs] for title, curve in columns.items()}
    last = [mean(values) for values in list(ends.values())[-1]]
    order = sorted(range(len(pairs)), key=lambda i: (np.nan_to_num(last[i], nan=-np.inf), -i))[-MOST_SMALL:]
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(1, len(columns), figsize=(WIDTH_IN, 1.3 + 0.21 * len(order)), sharey=True,
                                squeeze=False)
    for ax, (title, values) in zip(axes.flat, ends.items(), strict=True):
        for place, i in enumerate(order):
            line, (value, low, high) = pairs[i][1], mean_interval(values[i])
            if np.isfinite(low):
                ax.plot([low, high], [place, place], color=line.colour, lw=1.6, gid=line.gid)
            ax.plot(value, place, "o", ms=4.5, color=line.colour, gid=line.gid)
        ax.set_title(title)
        ax.locator_params(axis="x", nbins=4)
        ax.set_xlabel(unit)
        ax.tick_params(axis="x", labelsize=7.5)
    names = [cut(f"{line.name} ({panel.title})" if panel.title else line.name, 30) for panel, line in pairs]
    axes[0, 0].set_yticks(range(len(order)), [names[i] for i in order])
    if not order:
        empty(axes[0, 0], "no complete runs")
    axes[0, -1].spines["left"].set_color(GREY)
    more = f", the best {MOST_SMALL} of {len(pairs)}" if len(pairs) > MOST_SMALL else ""
    return figure, f"Means over the last fifth of training with 95 % t intervals over seeds{more}."


def _end(x: np.ndarray, values: np.ndarray) -> list[float]:
    """Of each seed the mean over the last fifth of its points."""
    kept = values[:, -max(1, -(-len(x) // LAST)):] if len(x) else np.zeros((0, 0))
    return [value for row in kept if np.isfinite(value := mean(row))]
