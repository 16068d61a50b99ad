"""Steps of a ladder: what each next condition of a study changes."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from attnlab.figures.base import Figure
from attnlab.figures.compared import (
    BETTER,
    EARLY,
    LATE,
    SAFETY,
    UNCLEAR,
    VALID,
    WORSE,
    Difference,
    asked,
    called,
    difference,
    outcome,
    values_of,
)
from attnlab.figures.panels import grid
from attnlab.figures.style import cut, empty
from attnlab.registry import register

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Drawing

    from attnlab.results.conditions import Conditions

LEAST, MOST = 4, 12  # conditions of a ladder
DIGITS = {EARLY: 1, LATE: 1, VALID: 1, SAFETY: 3}
Step = tuple[str, Difference]


@register("figure", "steps")
class Steps(Figure):
    """Differences between neighbouring variants of a study, in the order in which it names them, ranked: survival early
    and late in training and in validation, and safety."""
    title, order = "What each step changes", 10
    how = "A row is a condition less the one before it in the study's order: mean over paired seeds with its t " \
        "interval (95 %), the largest on top. Blue: better, orange: worse, grey: the interval holds 0."

    def applies(self, conditions: Conditions) -> bool:
        variants = values_of(conditions, "variant")
        return LEAST <= len(variants) <= MOST and len(conditions.keyed) == len(variants)

    def draw(self, conditions: Conditions) -> Drawing:
        rows = len(conditions.keyed) - 1
        figure, axes = grid(4, height_in=2.7, columns=2)
        figure.set_figheight(2 * (1.0 + 0.36 * rows))
        for ax, (which, found) in zip(axes, steps(conditions).items(), strict=True):
            _panel(ax, found, DIGITS[which])
            ax.set_title(which[0].upper() + which[1:])
            ax.set_xlabel("difference, 0-1" if which == SAFETY else "difference, points")
        return figure

    def say(self, conditions: Conditions) -> str:
        parts = []
        for which, found in steps(conditions).items():
            clear = [f"{name} {step.said(DIGITS[which])}" for name, step in found if step.side]
            if clear:
                parts.append(f"{which[0].upper()}{which[1:]}: {'; '.join(clear)}")
        return f"Clear steps. {'. '.join(parts)}." if parts else "No step is clear."


def steps(conditions: Conditions) -> dict[str, list[Step]]:
    """Outcome -> (``one - the one before``, difference) of each step, the largest first."""
    ladder = asked(conditions)
    found: dict[str, list[Step]] = {}
    for which in DIGITS:
        made = [(f"{cut(called(conditions, one), 24)} − {cut(called(conditions, before), 24)}",
                 difference(outcome(one.runs, which), outcome(before.runs, which)))
                for before, one in pairwise(ladder)]
        found[which] = sorted(((name, step) for name, step in made if step is not None),
                              key=lambda row: -row[1].value)
    return found


def _panel(ax: Axes, found: list[Step], digits: int) -> None:
    if not found:
        empty(ax, "not recorded")
        return
    for place, (_, step) in enumerate(reversed(found)):
        colour = {1: BETTER, -1: WORSE, 0: UNCLEAR}[step.side]
        if np.isfinite(step.low):
            ax.plot([step.low, step.high], [place, place], color=colour, lw=2.2, solid_capstyle="butt")
        ax.plot(step.value, place, "o", ms=6.5, color=colour, mec="white", mew=0.7)
        ax.annotate(step.said(digits), (1.0, place), xycoords=("axes fraction", "data"), ha="right", va="bottom",
                    xytext=(0, 3), textcoords="offset points", fontsize=7.5, color=colour)
    ax.axvline(0, color="#999999", lw=0.9, zorder=0)
    ax.set_yticks(range(len(found)), [name.replace(" − ", "\n− ") for name, _ in reversed(found)], fontsize=7.5)
    ax.set_ylim(-0.6, len(found) - 0.2)
    ax.grid(False, axis="y")
