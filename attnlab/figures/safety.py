"""Fig 9: mean safety (eq 13) of an episode, means of 10 training episodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from attnlab.figures.base import Figure
from attnlab.figures.curves import one_curve
from attnlab.figures.found import start_and_end
from attnlab.registry import register

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawing

    from attnlab.results.conditions import Conditions


@register("figure", "safety")
class Safety(Figure):
    """Mean safety (eq 13) of an episode along training."""
    title, order, place = "safety", 90, "Fig 9"
    how = "A point is the mean of 10 training episodes over seeds, with its 95 % bootstrap band; more is " \
        "safer."

    def draw(self, conditions: Conditions) -> Drawing:
        return one_curve(conditions, "Safety (eq 13)", "safety_mean", 10, "mean safety of an episode, 0-1")

    def say(self, conditions: Conditions) -> str:
        return start_and_end(conditions, "safety_mean", "", block=10, digits=2)
