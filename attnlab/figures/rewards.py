"""Fig 7: reward summed over an episode, by behaviour and in all, means of 10 training episodes."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from attnlab.figures.base import Figure
from attnlab.figures.curves import finish, rows_of_panels
from attnlab.figures.found import validation
from attnlab.figures.many import crowded, ranked
from attnlab.figures.panels import Line, Panel, band, block_of, by_episode, grid
from attnlab.figures.style import GREY, cut, empty
from attnlab.measures.rewards import Reward, behaviours_of
from attnlab.registry import register

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Drawing

    from attnlab.results.conditions import Conditions


@register("figure", "rewards")
class Rewards(Figure):
    """Cumulative rewards along training, a panel a behaviour and one for all.

    Drawn thick, with the band: the extrinsic part, on which scale all are paid alike, with penalties as eqs 7-9 have
    them. Thin: the same without penalties. Dotted: what CR learns from, eq 4's mixture, where it differs. Penalties of
    -1500 would flatten everything else, so an axis ends a little below the bulk and says so.
    """
    title, order, place = "cumulative rewards", 70, "Fig 7"
    how = ("Thick: the extrinsic part of the reward, on which scale CR and NCR are paid alike, with the penalties of "
           "eqs 7-9; thin: the same without them; dotted: the mixture of eq 4, with penalties, where it differs. "
           "More than 7 conditions are ranked by the first of these.")

    def draw(self, conditions: Conditions) -> Drawing:
        drawn, note = rows_of_panels(conditions)
        frame = conditions.frame("behaviours")
        names = list(dict.fromkeys(frame["behaviour"])) if len(frame) else []
        block = block_of(conditions, 10)
        whole = [*names, None] if names else [None]
        if crowded(drawn):
            figure, told = ranked(drawn, {"all" if name is None else name.upper(): partial(_paid, name, block)
                                          for name in whole}, "UoR an episode")
            figure.suptitle(f"Reward, extrinsic part with penalties\n{told}", x=0.01, ha="left", fontsize=9.5)
            return figure
        columns = len(whole) if len(drawn) > 1 else 3 if len(whole) > 4 else 2
        figure, axes = grid(max(1, len(drawn)) * len(whole), 3.4 if len(drawn) > 1 else 5.4, columns, sharex=True)
        for row, panel in enumerate(drawn):
            for name, ax in zip(whole, axes[row * len(whole):], strict=False):
                bulk = _lines(ax, panel, name, block)
                _cut_axis(ax, bulk)
                title = "all behaviours" if name is None else name.upper()
                ax.set_title(cut(title if not panel.title else f"{title} ({panel.title})", 90 // columns))
                ax.margins(x=0.02)
        if not drawn:
            empty(axes[0], "no complete runs")
        finish(figure, axes, conditions, "Cumulative rewards", block, "reward of an episode, UoR", note)
        return figure

    def say(self, conditions: Conditions) -> str:
        forms = {"extrinsic part with penalties ": Reward.Params(extrinsic=True),
                 "without them ": Reward.Params(extrinsic=True, penalties=False), "as mixed by eq 4 ": Reward.Params()}
        return validation(conditions, [(name, Reward(form)) for name, form in forms.items()], " UoR an episode")


def _paid(name: str | None, block: int, line: Line) -> tuple[np.ndarray, np.ndarray]:
    """A condition's reward along training, as it is drawn thick."""
    behaviours = len(behaviours_of(line.runs, "train")) if name is None else 1
    (x, extrinsic), (_, penalty) = (by_episode(line.runs, "behaviours", column, block, behaviour=name)
                                    for column in ("reward_extrinsic", "penalty"))
    return x, (extrinsic + penalty) * behaviours


def _lines(ax: Axes, panel: Panel, name: str | None, block: int) -> np.ndarray:
    """Draw the lines of a panel; all block means that decide where its axis ends."""
    found = []
    for line in panel.lines:
        behaviours = len(behaviours_of(line.runs, "train")) if name is None else 1
        series = {}
        for column in ("reward_extrinsic", "reward", "penalty"):
            x, values = by_episode(line.runs, "behaviours", column, block, behaviour=name)
            series[column] = values * behaviours  # by_episode has the mean over them
        if not len(x):
            continue
        extrinsic, paid = series["reward_extrinsic"], series["reward"]
        band(ax, x, extrinsic + series["penalty"], line)
        found += [extrinsic.ravel(), (extrinsic + series["penalty"]).ravel()]
        if series["penalty"].any():
            ax.plot(x, np.nanmean(extrinsic, axis=0), color=line.colour, lw=0.8, alpha=0.75,
                    label=f"{line.name}, no penalties", gid=line.gid)
        if not np.allclose(extrinsic, paid, equal_nan=True):
            ax.plot(x, np.nanmean(paid + series["penalty"], axis=0), color=line.colour, lw=1.1, ls=":",
                    label=f"{line.name}, eq 4", gid=line.gid)
    return np.concatenate(found) if found else np.zeros(0)


def _cut_axis(ax: Axes, values: np.ndarray) -> None:
    values = values[np.isfinite(values)]
    if not values.size:
        return
    low, bulk, high = values.min(), np.quantile(values, 0.25), values.max()
    span = max(high - bulk, 1e-9)
    floor = bulk - 2.0 * span
    if low < floor:
        ax.set_ylim(floor, high + 0.15 * span)
        ax.text(0.985, 0.03, f"penalties reach down to {low:.0f}", transform=ax.transAxes, ha="right", va="bottom",
                fontsize=8, color=GREY)
