"""Who does best with how many looks: outcomes against looks taken, and the front that nobody beats."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from attnlab.figures.base import Figure
from attnlab.figures.compared import SAFETY, VALID, asked, called, coloured, looks, outcome, point, values_of
from attnlab.figures.panels import grid
from attnlab.figures.style import GREY, empty
from attnlab.figures.values import UNTOLD
from attnlab.registry import register

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Drawing

    from attnlab.results.conditions import Conditions

CAP = "learner.looks_per_s"
MARKERS = "osD^vPX*"
SHOWN = {VALID: "survival in validation, %", SAFETY: "mean safety in validation, 0-1"}


class Spent(NamedTuple):
    """A condition under a cap (1/s): ``looks`` a second and the outcome, by seed."""
    name: str
    cap: float
    looks: dict[int, float]
    got: dict[int, float]

    @property
    def place(self) -> tuple[float, float]:
        """(looks, outcome), means over seeds."""
        return float(np.nanmean(list(self.looks.values()))), float(np.nanmean(list(self.got.values())))


@register("figure", "budget_front")
class BudgetFront(Figure):
    """Survival and safety against the looks that were taken, of everybody under several caps on looks, with the Pareto
    front: those whom nobody with as few looks does better than."""
    title, order = "What looks buy", 11
    how = "A mark is a condition under a cap: means over seeds with t intervals (95 %); a line joins its caps. The " \
        "grey stair is the Pareto front of the means: nobody gets more with as few looks."

    def applies(self, conditions: Conditions) -> bool:
        return len(values_of(conditions, CAP)) > 1

    def draw(self, conditions: Conditions) -> Drawing:
        figure, axes = grid(2, height_in=4.0)
        shades = coloured(conditions, asked(conditions))
        for ax, (which, label) in zip(axes, SHOWN.items(), strict=True):
            _panel(ax, spent(conditions, which), shades)
            ax.set_ylabel(label)
            ax.set_xlabel("looks a second, all behaviours together")
        handles, names = axes[0].get_legend_handles_labels()
        if handles:
            figure.legend(handles, names, loc="outside lower center", ncol=min(4, len(handles)), handletextpad=0.4)
        return figure

    def say(self, conditions: Conditions) -> str:
        parts = []
        for which in SHOWN:
            on = front(spent(conditions, which))
            if on:
                parts.append(f"{which}: " + ", ".join(f"{one.name} ({one.place[0]:.2f}/s)" for one in on))
        return f"On the front of looks and {'; of looks and '.join(parts)}." if parts else "Nothing was recorded."


def spent(conditions: Conditions, which: str) -> list[Spent]:
    """Every condition under every cap in which looks and the outcome were recorded."""
    found = []
    for one in asked(conditions):
        taken = {seed: value / one.runs.reading().dt_s for seed, value in looks(one.runs).items()}
        got = outcome(one.runs, which)
        if taken and np.isfinite(list(got.values())).any():
            found.append(Spent(called(conditions, one), float(one.settings[CAP]), taken, got))
    return found


def front(of: Sequence[Spent]) -> list[Spent]:
    """Those to whom no other is equal or better in both means and better in one; by rising looks."""
    def beaten(one: Spent) -> bool:
        x, y = one.place
        return any(u <= x and v >= y and (u, v) != (x, y) for u, v in (other.place for other in of))
    return sorted((one for one in of if not beaten(one)), key=lambda one: one.place)


def _panel(ax: Axes, found: list[Spent], shades: dict[str, str]) -> None:
    if not found:
        empty(ax, "not recorded")
        return
    on = [one.place for one in front(found)]
    ax.step([x for x, _ in on], [y for _, y in on], where="post", color="#bbbbbb", lw=5, zorder=0, alpha=0.7,
            solid_capstyle="butt", label="Pareto front")
    for i, name in enumerate(dict.fromkeys(one.name for one in found)):
        mine = sorted((one for one in found if one.name == name), key=lambda one: one.cap)
        ax.plot(*zip(*(one.place for one in mine), strict=True), color=shades.get(name, GREY), lw=0.9, alpha=0.7)
        for k, one in enumerate(mine):
            x, y = one.place
            marker, colour = MARKERS[i % len(MARKERS)], shades.get(name, GREY)
            point(ax, x, one.got, colour, marker, name if k == 0 else UNTOLD + name)
            point(ax, y, one.looks, colour, marker, across=True)
