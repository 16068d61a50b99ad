"""Fig 6: survival time in % of the episode, means of 50 training episodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from attnlab.figures.base import Figure
from attnlab.figures.curves import one_curve
from attnlab.figures.found import start_and_end
from attnlab.registry import register

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawing

    from attnlab.results.conditions import Conditions


@register("figure", "survival")
class Survival(Figure):
    """Survival time along training, in % of the episode."""
    title, order, place = "survival", 60, "Fig 6"
    how = "A point is the mean of 50 training episodes (of fewer in a short study), over seeds; the band its 95 % " \
        "bootstrap interval."

    def draw(self, conditions: Conditions) -> Drawing:
        return one_curve(conditions, "Survival", "survival", 50, "survival time, % of the episode", 100.0, marker="o",
                         ms=3.5)

    def say(self, conditions: Conditions) -> str:
        return start_and_end(conditions, "survival", " %", 100)
