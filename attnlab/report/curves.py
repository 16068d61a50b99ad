"""Figures along episodes: survival (Fig 6), rewards (Fig 7), maximum need (Fig 8B), safety (Fig 9), energy (Fig 10)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from attnlab.report.panels import Panel, band, block_of, by_episode, grid, legend, shown, title_of_lines
from attnlab.report.style import GREY, cut, empty, seeds_note
from attnlab.results.conditions import Conditions

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST_ROWS = 4  # combinations of settings drawn where each takes a row of panels


def survival(conditions: Conditions) -> Figure:
    """Fig 6: survival time in % of the episode, means of 50 training episodes."""
    return _one_curve(conditions, "Survival", "survival", 50, "survival time, % of the episode", 100.0, marker="o",
                      ms=3.5)


def safety(conditions: Conditions) -> Figure:
    """Fig 9: mean safety (eq 13) of an episode, means of 10 training episodes."""
    return _one_curve(conditions, "Safety (eq 13)", "safety_mean", 10, "mean safety of an episode, 0-1")


def energy(conditions: Conditions) -> Figure:
    """Fig 10: mean energy of an episode with E_well, means of 10 training episodes."""
    def well(ax: Axes, panel: Panel) -> None:
        levels = sorted({line.runs.reading().energy_well for line in panel.lines})
        for level in levels:
            ax.axhline(level, color=GREY, ls=(0, (4, 2)), lw=1.1,
                       label="E_well" if len(levels) == 1 else f"E_well = {level:g}")
    return _one_curve(conditions, "Energy", "energy_mean", 10, "mean energy of an episode, UoE", over=well)


def _one_curve(conditions: Conditions, name: str, column: str, wanted: int, unit: str, scale: float = 1.0,
               over: Callable | None = None, **style) -> Figure:
    drawn, note = shown(conditions)
    figure, axes = grid(max(1, len(drawn)), 3.5, sharex=True, sharey=True)
    block = block_of(conditions, wanted)
    for ax, panel in zip(axes, drawn, strict=False):
        for line in panel.lines:
            x, values = by_episode(line.runs, "episodes", column, block)
            if np.isfinite(values).any():
                band(ax, x, scale * values, line, **style)
        if over:
            over(ax, panel)
        ax.set_title(cut(panel.title, 105 // min(3, len(drawn))))
        ax.margins(x=0.02)
        if not ax.lines:
            empty(ax, f"no {column} in these runs")
    if not drawn:
        empty(axes[0], "no complete runs")
    _finish(figure, axes, conditions, name, block, unit, note)
    return figure


def rewards(conditions: Conditions) -> Figure:
    """Fig 7: reward summed over an episode, by behaviour and in all, means of 10 training episodes.

    Penalties of -1500 would flatten everything else, so the axis ends a little below the bulk and says so.
    """
    drawn, note = shown(conditions)
    if len(drawn) > MOST_ROWS:
        drawn, note = drawn[:MOST_ROWS], f"The first {MOST_ROWS} combinations of settings are drawn."
    frame = conditions.frame("behaviours")
    names = list(dict.fromkeys(frame["behaviour"])) if len(frame) else []
    block = block_of(conditions, 10)
    whole = [*names, None] if names else [None]
    columns = len(whole) if len(drawn) > 1 or len(whole) > 4 else 2
    figure, axes = grid(max(1, len(drawn)) * len(whole), 3.4 if len(drawn) > 1 else 5.4, columns, sharex=True)
    for row, panel in enumerate(drawn):
        for name, ax in zip(whole, axes[row * len(whole):], strict=False):
            bulk = _reward_lines(ax, panel, name, block)
            _cut_axis(ax, bulk)
            title = "all behaviours" if name is None else name.upper()
            ax.set_title(cut(title if not panel.title else f"{title} ({panel.title})", 90 // columns))
            ax.margins(x=0.02)
    if not drawn:
        empty(axes[0], "no complete runs")
    _finish(figure, axes, conditions, "Cumulative rewards", block, "reward of an episode, UoR", note)
    return figure


def _reward_lines(ax: Axes, panel: Panel, name: str | None, block: int) -> np.ndarray:
    """Draw the lines of a panel; for all behaviours the extrinsic part apart where it differs. All block means."""
    found = []
    for line in panel.lines:
        equal = {} if name is None else {"behaviour": name}
        series = {}
        for column in ("reward", "reward_extrinsic"):
            x, values = by_episode(line.runs, "behaviours", column, block, **equal)
            if name is None and len(x):
                values = values * line.runs.rows("behaviours")["behaviour"].nunique()
            series[column] = values
        if not len(x):
            continue
        band(ax, x, series["reward"], line)
        found.append(series["reward"].ravel())
        if not np.allclose(series["reward"], series["reward_extrinsic"], equal_nan=True):
            ax.plot(x, np.nanmean(series["reward_extrinsic"], axis=0), color=line.colour, lw=1.1, ls=":",
                    label=f"{line.name}, extrinsic part")
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


def maximum_need(conditions: Conditions) -> Figure:
    """Fig 8B: largest hunger and thirst of an episode, means of 10 training episodes."""
    drawn, note = shown(conditions)
    if len(drawn) > MOST_ROWS:
        drawn, note = drawn[:MOST_ROWS], f"The first {MOST_ROWS} combinations of settings are drawn."
    block = block_of(conditions, 10)
    figure, axes = grid(2 * max(1, len(drawn)), 3.4, 2, sharex=True, sharey=True)
    for row, panel in enumerate(drawn):
        for need, ax in zip(("hunger", "thirst"), axes[2 * row:], strict=False):
            for line in panel.lines:
                x, values = by_episode(line.runs, "episodes", f"{need}_max", block)
                if np.isfinite(values).any():
                    band(ax, x, values, line)
            ax.set_title(cut(need.capitalize() + (f" ({panel.title})" if panel.title else ""), 52))
            ax.margins(x=0.02)
            if not ax.lines:
                empty(ax, f"no {need} in these runs")
    if not drawn:
        empty(axes[0], "no complete runs")
    _finish(figure, axes, conditions, "Maximum need", block, "largest need of an episode, UoE", note)
    return figure


def _finish(figure: Figure, axes: list[Axes], conditions: Conditions, name: str, block: int, unit: str,
            note: str) -> None:
    figure.supylabel(unit, fontsize=9.5)
    for ax in axes:
        if ax.get_subplotspec().is_last_row():  # not the figure's own label: a legend below would lie upon it
            ax.set_xlabel(f"training episodes (means of {block})" if block > 1 else "training episodes")
        if ax.lines:  # an empty panel has no ticks to speak of
            ax.xaxis.get_major_locator().set_params(integer=True)
    legend(figure, axes, title_of_lines(conditions))
    under = f"{seeds_note(conditions)}\n{note}" if note else seeds_note(conditions)
    figure.suptitle(f"{name}\n{under}", x=0.01, ha="left", fontsize=9.5)
