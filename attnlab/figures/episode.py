"""What figures within one episode share: which episode is drawn, and its needs."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from attnlab.figures.panels import Line, panels
from attnlab.figures.style import cut, own_colours
from attnlab.measures.needs import units_of

Shade = tuple[float, float, float, float]

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes

    from attnlab.results.conditions import Conditions

HUNGER, THIRST = "#009e73", "#56b4e9"  # as food and water are green and blue
LOOKS = {"hunger": (HUNGER, "-"), "thirst": (THIRST, (0, (5, 1.4)))}
OTHERS = ("#cc79a7", "#e69f00", "#882255", "#332288", "#999933")  # for needs of an author's own


def first_lines(conditions: Conditions, most: int) -> list[tuple[str, Line]]:
    """(title, condition) of the first conditions, one after the other."""
    found = [(panel, line) for panel in panels(conditions) for line in panel.lines]
    return [(cut(f"{line.name}" + (f" ({panel.title})" if panel.title else ""), 44), line)
            for panel, line in found[:most]]


def last_episode(line: Line) -> tuple[pd.DataFrame, int] | tuple[None, None]:
    """(cycles of the last recorded episode of the first seed that has one, that seed); (None, None) without any."""
    rows = line.runs.rows("cycles")
    if not len(rows):
        return None, None
    seed = int(rows["seed"].min())
    return rows[rows["seed"] == seed], seed


def need_lines(ax: Axes, cycles: pd.DataFrame, units: dict[str, str]) -> bool:
    """Draw the needs (with their units) of an episode; False if none was recorded."""
    same, own = len(set(units.values())) == 1, own_colours(set(units) - set(LOOKS), OTHERS)
    drawn = False
    for need, unit in units.items():
        colour, dash = LOOKS.get(need) or (own[need], (0, (6, 1.4, 1.5, 1.4)))
        if need in cycles and cycles[need].notna().any():
            ax.plot(cycles["cycle"], cycles[need], color=colour, ls=dash, lw=1.5,
                    label=need if same else f"{need}, {unit}")
            drawn = True
    return drawn


def label_of_needs(conditions: Conditions) -> str:
    """``need, UoE``; without a unit where needs have several."""
    units = set(units_of(conditions).values())
    return f"need, {units.pop()}" if len(units) == 1 else "need"


def period_colours(periods: list[int]) -> dict[int, Shade]:
    """A shade for each period."""
    import matplotlib
    shades = matplotlib.colormaps["viridis"](np.linspace(0.0, 0.88, max(2, len(periods))))
    return {period: (shade[0], shade[1], shade[2], shade[3]) for period, shade in zip(periods, shades, strict=False)}
