"""Fig 8B: largest value of each need in an episode, means of 10 training episodes."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from attnlab.figures.base import Figure
from attnlab.figures.curves import finish, rows_of_panels
from attnlab.figures.found import start_and_end
from attnlab.figures.many import crowded, ranked
from attnlab.figures.panels import Line, band, block_of, by_episode, grid
from attnlab.figures.style import cut, empty
from attnlab.measures.needs import needs_of, units_of
from attnlab.registry import register

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawing

    from attnlab.results.conditions import Conditions


@register("figure", "maximum_need")
class MaximumNeed(Figure):
    """Largest hunger, thirst and any other need of an episode along training, a column a need."""
    title, order, place = "largest need of an episode", 82, "Fig 8B"
    how = "A point is the mean of 10 training episodes over seeds, with its 95 % bootstrap band. More than 7 " \
        "conditions are ranked by the end of training."

    def draw(self, conditions: Conditions) -> Drawing:
        drawn, note = rows_of_panels(conditions)
        units = units_of(conditions)
        same = len(set(units.values())) == 1
        block, columns = block_of(conditions, 10), len(units)
        if crowded(drawn):
            figure, told = ranked(drawn, {need.capitalize(): partial(_most, need, block) for need in units},
                                  "largest of an episode")
            figure.suptitle(f"Maximum need\n{told}", x=0.01, ha="left", fontsize=9.5)
            return figure
        figure, axes = grid(columns * max(1, len(drawn)), 3.4, columns, sharex=True, sharey=same)
        for row, panel in enumerate(drawn):
            for (need, unit), ax in zip(units.items(), axes[columns * row:], strict=False):
                for line in panel.lines:
                    x, values = by_episode(line.runs, "episodes", f"{need}_max", block)
                    if np.isfinite(values).any():
                        band(ax, x, values, line)
                title = need.capitalize() if same else f"{need.capitalize()}, {unit}"
                ax.set_title(cut(title + (f" ({panel.title})" if panel.title else ""), 104 // columns))
                ax.margins(x=0.02)
                if not ax.lines:
                    empty(ax, f"no {need} in these runs")
        if not drawn:
            empty(axes[0], "no complete runs")
        unit = f", {next(iter(units.values()))}" if same else ""
        finish(figure, axes, conditions, "Maximum need", block, f"largest need of an episode{unit}", note)
        return figure

    def say(self, conditions: Conditions) -> str:
        units = units_of(conditions)
        told = [need for need in needs_of(conditions) if need != "thirst"] or ["thirst"]  # thirst goes as hunger does
        return " ".join(start_and_end(conditions, f"{need}_max", f" {units[need]} {need}", block=10, digits=0)
                        for need in told)


def _most(need: str, block: int, line: Line) -> tuple[np.ndarray, np.ndarray]:
    """A condition's largest need along training."""
    return by_episode(line.runs, "episodes", f"{need}_max", block)
