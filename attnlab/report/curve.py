"""Figures of a multiverse, for paper: specification curves, the dashboard of factors under one, shares of claims."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from attnlab.figures.style import BLUE, GREY, VERMILLION, WIDTH_IN, cut
from attnlab.report.multiverse import Curves, Multiverse
from attnlab.stats.specification import LIMIT

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST = 12  # curves on one figure


def curves(found: Curves) -> Figure:
    """One small curve a contrast, of those most clearly told from chance: the effects of all readings in rising order,
    each with its interval; what lies beyond ``LIMIT`` is drawn there."""
    import matplotlib.pyplot as plt
    chosen, columns = ranked(found)[:MOST], 3
    rows = max(1, -(-len(chosen) // columns))
    figure, axes = plt.subplots(rows, columns, figsize=(WIDTH_IN, 0.5 + 1.6 * rows), sharex=True, sharey=True,
                                squeeze=False)
    for place, ax in enumerate(axes.flat):
        if place >= len(chosen):
            ax.set_visible(False)
            continue
        m = chosen[place]
        of = found.contrasts[m]
        _curve(ax, found, m, in_order(found, m))
        ax.set_title(cut(f"{of.claim} {of.measure}", 38), fontsize=7.5)
        ax.text(0.03, 0.93, f"against {of.whom}: p {p_text(found.joint.p_family[m])}", transform=ax.transAxes,
                fontsize=6.5, va="top", color=GREY)
    figure.supxlabel("readings, in the order of their effect", fontsize=9)
    figure.supylabel("effect d; above 0: as claimed", fontsize=9)
    return figure


def in_order(found: Curves, m: int) -> np.ndarray:
    """The readings that have a value, in the order of their effect."""
    order = np.argsort(found.effects[:, m], kind="stable")
    return np.array([r for r in order if not np.isnan(found.effects[r, m])], int)


def _curve(ax: Axes, found: Curves, m: int, order: np.ndarray) -> None:
    effects, low, high = (np.clip(of[order, m], -LIMIT, LIMIT) for of in (found.effects, found.low, found.high))
    x = np.arange(len(order))
    clear = np.where(found.low[order, m] > 0, BLUE, np.where(found.high[order, m] < 0, VERMILLION, GREY))
    ax.vlines(x, low, high, color=clear.tolist(), lw=0.8, alpha=0.45)
    ax.scatter(x, effects, s=4, c=clear.tolist(), zorder=3)
    ax.axhline(0, color="#333333", lw=0.8)
    ax.set_ylim(-LIMIT * 1.05, LIMIT * 1.05)


def dashboard(found: Multiverse, of: Curves, m: int) -> Figure:
    """A contrast's curve over the dashboard of factors: which levels each reading has."""
    import matplotlib.pyplot as plt
    rows = [(factor, level) for factor, levels in found.levels.items() for level in dict.fromkeys(sorted(levels))]
    figure, (top, below) = plt.subplots(2, 1, figsize=(WIDTH_IN, 2.9 + 0.135 * len(rows)), sharex=True,
                                        gridspec_kw={"height_ratios": [2.2, max(1.0, 0.135 * len(rows))]})
    order = in_order(of, m)
    _curve(top, of, m, order)
    top.set_ylabel("effect d", fontsize=8.5)
    top.set_title(of.contrasts[m].title, fontsize=9)
    for place, (factor, level) in enumerate(rows):
        has = [x for x, r in enumerate(order) if found.levels[factor][r] == level]
        below.scatter(has, [place] * len(has), marker="|", s=14, lw=0.9, color="#333333")
    labels = [cut(f"{factor.split(' + ')[0]} = {level.split(' + ')[0]}", 44) for factor, level in rows]
    below.set_yticks(range(len(rows)), labels, fontsize=6.5)
    below.set_ylim(len(rows) - 0.5, -0.5)
    below.set_xlabel("readings, in the order of their effect")
    below.grid(visible=False)
    return figure


def shares(found: Multiverse) -> Figure:
    """For each claim the share of readings in which it holds, and in which it is reproduced, number and all."""
    import matplotlib.pyplot as plt
    n = len(found.claims)
    figure, ax = plt.subplots(figsize=(WIDTH_IN, 1.1 + 0.27 * n))
    for row in range(n):
        value, testable = found.share(row)
        if not testable:
            ax.text(0, row, " untestable in every reading", va="center", color=GREY, fontsize=8.5)
            continue
        ax.barh(row, 100 * value, color="#56b4e9", height=0.68,
                label=None if ax.patches else "claimed direction clear")
        exact = 100 * found.reproduced[row].sum() / testable
        ax.plot(exact, row, "D", color="#00674d", ms=5, label=None if ax.lines else
                ("supported" if found.own else "reproduced") + ", number and all")
    ax.set_yticks(range(n), [cut(f"{i}  {claim.title}", 62) for i, claim in found.claims.items()])
    ax.invert_yaxis()
    ax.set_xlim(0, 103)
    ax.set_xlabel(f"% of the readings that can test the claim ({len(found.names)} at most)")
    ax.grid(axis="y", visible=False)
    if ax.get_legend_handles_labels()[0]:
        figure.legend(loc="outside upper right", ncol=2)
    return figure


def ranked(found: Curves) -> list[int]:
    """Contrasts, those most clearly told from chance first."""
    return sorted(range(len(found.contrasts)), key=lambda m: (found.joint.p_family[m], -abs(found.joint.median[m]), m))


def p_text(value: float) -> str:
    return "-" if np.isnan(value) else f"{value:.2g}" if value >= 0.001 else "<0.001"
