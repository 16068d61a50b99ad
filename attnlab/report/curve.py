"""The multiverse on the page: specification curves, the dashboard of factors under one, shares of claims."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from attnlab.figures.style import BLUE, GREY, VERMILLION, WIDTH_IN, cut
from attnlab.report.multiverse import Multiverse
from attnlab.report.page import Section, table

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LIMIT = 3.0  # standard deviations; what lies beyond is drawn at the edge


def curves(found: Multiverse) -> Figure:
    """One small curve a measure: the effects of all readings in rising order, each with its interval."""
    import matplotlib.pyplot as plt
    n, columns = len(found.measures), 4
    rows = max(1, -(-n // columns))
    figure, axes = plt.subplots(rows, columns, figsize=(WIDTH_IN + 0.8, 0.5 + 1.55 * rows), sharex=True, sharey=True,
                                squeeze=False)
    for m, ax in enumerate(axes.flat):
        if m >= n:
            ax.set_visible(False)
            continue
        _curve(ax, found, m, np.argsort(found.effects[:, m], kind="stable"))
        ax.set_title(cut(found.measures[m].title, 34), fontsize=7.5)
        if found.joint is not None:
            ax.text(0.03, 0.93, f"joint p {_p(found.joint.p[m])}, of all {_p(found.joint.p_family[m])}",
                    transform=ax.transAxes, fontsize=6.5, va="top", color=GREY)
    figure.supxlabel("readings, in the order of their effect", fontsize=9)
    figure.supylabel("effect d; above 0: as claimed", fontsize=9)
    return figure


def _curve(ax: Axes, found: Multiverse, m: int, order: np.ndarray) -> None:
    effects, low, high = (np.clip(of[order, m], -LIMIT, LIMIT) for of in (found.effects, found.low, found.high))
    x = np.arange(len(order))
    clear = np.where(found.low[order, m] > 0, BLUE, np.where(found.high[order, m] < 0, VERMILLION, GREY))
    ax.vlines(x, low, high, color=clear.tolist(), lw=0.8, alpha=0.45)
    ax.scatter(x, effects, s=4, c=clear.tolist(), zorder=3)
    ax.axhline(0, color="#333333", lw=0.8)
    ax.set_ylim(-LIMIT * 1.05, LIMIT * 1.05)


def dashboard(found: Multiverse, m: int) -> Figure:
    """A measure's curve over the dashboard of factors: which levels each reading has."""
    import matplotlib.pyplot as plt
    rows = [(factor, level) for factor, of in found.levels.items() for level in dict.fromkeys(sorted(of))]
    figure, (top, below) = plt.subplots(2, 1, figsize=(WIDTH_IN, 2.9 + 0.135 * len(rows)), sharex=True,
                                        gridspec_kw={"height_ratios": [2.2, max(1.0, 0.135 * len(rows))]})
    order = np.argsort(found.effects[:, m], kind="stable")
    _curve(top, found, m, order)
    top.set_ylabel("effect d", fontsize=8.5)
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
    n = len(found.ids)
    figure, ax = plt.subplots(figsize=(WIDTH_IN, 1.1 + 0.27 * n))
    for row in range(n):
        value, testable = found.share(row)
        if not testable:
            ax.text(0, row, " untestable in every reading", va="center", color=GREY, fontsize=8.5)
            continue
        ax.barh(row, 100 * value, color="#56b4e9", height=0.68,
                label=None if ax.patches else "claimed direction clear")
        exact = 100 * found.reproduced[row].sum() / testable
        ax.plot(exact, row, "D", color="#00674d", ms=5, label=None if ax.lines else "reproduced, number and all")
    ax.set_yticks(range(n), [cut(f"{i}  {t}", 62) for i, t in zip(found.ids, found.titles, strict=True)])
    ax.invert_yaxis()
    ax.set_xlim(0, 103)
    ax.set_xlabel(f"% of the readings that can test the claim ({len(found.names)} at most)")
    ax.grid(axis="y", visible=False)
    if ax.get_legend_handles_labels()[0]:
        figure.legend(loc="outside upper right", ncol=2)
    return figure


def leading(found: Multiverse) -> int:
    """The measure whose curve gets the dashboard: the most clearly told from chance."""
    p = found.joint.p_family if found.joint is not None else np.ones(len(found.measures))
    return min(range(len(found.measures)), key=lambda m: (p[m], -abs(float(np.nanmedian(found.effects[:, m])))))


def sections(found: Multiverse) -> list[Section]:
    """The curve in numbers first, then what moves claims, shares and best readings."""
    return [_statements(found), _claims(found)]


def _statements(found: Multiverse) -> Section:
    rows = []
    for m, measure in enumerate(found.measures):
        mover, share = found.mover(m)
        j = found.joint
        numbers = ["-"] * 4 if j is None else [f"{j.clear[m]:.0f}", f"{j.opposite[m]:.0f}", _p(j.p[m]),
                                              _p(j.p_family[m])]
        rows.append([measure.title, found.statement(m), f"{float(np.nanmedian(found.effects[:, m])):+.2f}", *numbers,
                     f"{mover.split(' + ')[0]} ({100 * share:.0f} %)"])
    seeds = found.differences.shape[-1]
    how = "no joint test: the readings share fewer than two seeds" if found.joint is None else \
        (f"all {found.joint.patterns} exchanges" if found.joint.exact else f"{found.joint.patterns} exchanges drawn") \
        + f" of {seeds} seeds"
    html = (f"<p>{len(found.names)} readings of the paper's open points, {seeds} seeds, the same in all. Effects are "
            "signed: above 0 is as claimed.</p>"
            + table(("measure", "statement", "median d", "clear as claimed", "clear opposite", "joint p",
                     "p of all measures", "moved most by (share of variance)"), rows, range(2, 7))
            + "<p class=small>The readings are a fixed design: nothing is inferred over them. Joint test: the labels "
            f"of a whole seed are exchanged in every reading at once ({how}); the statistic is the mean effect; p of "
            "all measures is corrected by max-T. Every effect with its interval: curve.csv; this table: joint.csv.</p>")
    return Section("curve", "Which statements are robust", html)


def _claims(found: Multiverse) -> Section:
    rows = []
    for i, key in enumerate(found.ids):
        value, testable = found.share(i)
        top = sorted((e for e in found.moved if e.claim == key and e.difference), key=lambda e: -abs(e.difference))[:2]
        said = [f"{e.factor.split(' + ')[0]}={e.level.split(' + ')[0]} {100 * e.difference:+.0f}" for e in top]
        rows.append([f"{key} {found.titles[i]}", f"{100 * value:.0f} %" if testable else "-", str(testable),
                     "; ".join(said) or "nothing"])
    best = sorted(range(len(found.names)), key=lambda j: (-np.nansum(found.holds[:, j]), j))[:5]
    readings = [[found.names[j], f"{np.nansum(found.holds[:, j]):.0f}", f"{found.reproduced[:, j].sum()}",
                 ", ".join(f"{f.split(' + ')[0]}={of[j].split(' + ')[0]}" for f, of in found.levels.items()
                           if of[j] != found.defaults[f]) or "nothing"] for j in best]
    html = ("<p>A claim holds in a reading if its verdict is <i>reproduced</i> or one of the two <i>direction</i> "
            "ones.</p>" + table(("claim", "holds in", "readings", "moved most by (percent points)"), rows, (1, 2))
            + "<h3>Readings that satisfy most claims</h3>"
            + table(("reading", "claims that hold", "reproduced", "differs from the default in"), readings, (1, 2))
            + f"<p class=small>All {len(found.names)} readings: combinations.csv. Moved: the share with a level less "
            f"the share with the default level, all {len(found.moved)} in effects.csv; differences within a fixed "
            "design, without intervals.</p>")
    return Section("multiverse", "The multiverse: claims under every reading", html)


def _p(value: float) -> str:
    return "-" if np.isnan(value) else f"{value:.2g}" if value >= 0.001 else "<0.001"
