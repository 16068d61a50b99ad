"""Fig 10: mean energy of an episode with E_well, means of 10 training episodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from attnlab.figures.base import Figure
from attnlab.figures.curves import one_curve
from attnlab.figures.found import start_and_end
from attnlab.figures.style import GREY
from attnlab.registry import register

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Drawing

    from attnlab.figures.panels import Panel
    from attnlab.results.conditions import Conditions


@register("figure", "energy")
class Energy(Figure):
    """Mean energy of an episode along training, and E_well."""
    title, order, place = "energy", 100, "Fig 10"
    how = "A point is the mean of 10 training episodes over seeds, with its 95 % bootstrap band; dashed: E_well, " \
        "below which nothing is left by eq 11."

    def draw(self, conditions: Conditions) -> Drawing:
        return one_curve(conditions, "Energy", "energy_mean", 10, "mean energy of an episode, UoE", over=_well)

    def say(self, conditions: Conditions) -> str:
        return start_and_end(conditions, "energy_mean", " UoE", block=10, digits=0)


def _well(ax: Axes, panel: Panel) -> None:
    levels = sorted({line.runs.reading().energy_well for line in panel.lines})
    for level in levels:
        ax.axhline(level, color=GREY, ls=(0, (4, 2)), lw=1.1,
                   label="E_well" if len(levels) == 1 else f"E_well = {level:g}")
