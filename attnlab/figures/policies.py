"""What was learned: the period each behaviour grants itself at each percept, as heat maps and in the paper's words."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from attnlab.figures.base import Figure
from attnlab.figures.episode import first_lines, period_colours
from attnlab.figures.found import sentence
from attnlab.figures.style import WIDTH_IN, empty
from attnlab.figures.values import Cells, tell
from attnlab.measures.base import CannotMeasure
from attnlab.measures.policies import greedy, in_words
from attnlab.registry import register

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawing

    from attnlab.results.conditions import Conditions

MOST = 8


@register("figure", "policies")
class Policies(Figure):
    """A panel a behaviour: rows are conditions and curiosity levels, columns percepts; the number is the period that
    most seeds learned, the small one how many of those that visited the percept."""
    title, order = "Learned policies", 120
    how = ("Large: the period that most seeds learned; small: how many of the seeds that visited the bin; grey: never "
           "visited, or nothing learned. Low: no wanting; LH: wanting, little liking; HH: both.")

    def shows(self, where: str, measures: Collection[str]) -> bool:
        return any(name.startswith("policy") for name in measures)

    def draw(self, conditions: Conditions) -> Drawing:
        import matplotlib.pyplot as plt
        from matplotlib.colors import BoundaryNorm, ListedColormap
        tables = learned(conditions)
        names = list(dict.fromkeys(table.behaviour for table in tables))
        if not names:
            figure, ax = plt.subplots(figsize=(WIDTH_IN, 2))
            empty(ax, "no learned tables in these runs")
            return figure
        rows = max(sum(t.behaviour == name for t in tables) for name in names)
        columns = min(3, len(names))
        lines = -(-len(names) // columns)
        figure, axes = plt.subplots(lines, columns, figsize=(WIDTH_IN, lines * (1.1 + 0.46 * rows)), squeeze=False,
                                    sharey=False)
        for spare in list(axes.flat)[len(names):]:
            spare.set_visible(False)
        frame = conditions.frame("policy")
        periods = sorted(int(p) for p in frame["action"].unique())
        bins = int(frame["percept"].max())
        shades = period_colours(periods)
        cmap, norm = ListedColormap([shades[p] for p in periods]), BoundaryNorm(range(len(periods) + 1), len(periods))
        for place, (ax, name) in enumerate(zip(axes.flat, names, strict=False)):
            mine = [table for table in tables if table.behaviour == name]
            grid = np.full((len(mine), bins), np.nan)
            for i, table in enumerate(mine):
                for percept, (period, most, of) in table.cells.items():
                    index = periods.index(period)
                    grid[i, percept - 1] = index + 0.5
                    dark = index < 0.62 * len(periods)
                    ax.text(percept - 1, i - 0.1, str(period), ha="center", va="center", fontsize=9.5,
                            color="white" if dark else "black", weight="bold")
                    ax.text(percept - 1, i + 0.28, f"{most}/{of}", ha="center", va="center", fontsize=6.5,
                            color="white" if dark else "black")
            ax.imshow(grid, cmap=cmap, norm=norm, aspect="auto")
            rows_of = [t.condition if t.level in ("none", "") else f"{t.condition}, {t.level}" for t in mine]
            tell(ax, Cells([f"percept {i + 1}" for i in range(bins)], rows_of, np.arange(bins + 1) - 0.5,
                           np.arange(len(mine) + 1) - 0.5, [[t.said(i + 1) for i in range(bins)] for t in mine],
                           " seeds that visited it"))
            ax.set_title(name.upper())
            ax.set_xticks(range(bins), [str(i + 1) for i in range(bins)])
            ax.set_yticks(range(len(mine)), rows_of if place % columns == 0 else [""] * len(mine))
            ax.grid(False)
            ax.set_facecolor("#f1f1f1")
            ax.set_xlabel("percept bin")
        return figure

    def say(self, conditions: Conditions) -> str:
        tables = learned(conditions)
        drink = [t for t in tables if t.behaviour == "drink"] or tables
        parts = [f"{t.condition} {t.behaviour.upper()}" + (f", {t.level}" if t.level != "none" else "") + f": {t.words}"
                 for t in drink[:8]]
        return sentence(parts, "", conditions)



class Learned(NamedTuple):
    """The policy of a condition's behaviour at a curiosity level: percept -> (most frequent period, seeds that have it,
    seeds that have any)."""
    condition: str
    behaviour: str
    level: str
    cells: dict[int, tuple[int, int, int]]

    def said(self, percept: int) -> str:
        """What was learned at a percept, for the pointer; empty where it was never visited."""
        period, most, of = self.cells.get(percept, (0, 0, 0))
        return f"period {period}, in {most} of {of}" if of else ""

    @property
    def words(self) -> str:
        return in_words({percept: cell[0] for percept, cell in self.cells.items()})


def learned(conditions: Conditions) -> list[Learned]:
    """Learned policies of the first conditions, for every behaviour and curiosity level that they have."""
    found = []
    for title, line in first_lines(conditions, MOST):
        rows = line.runs.rows("policy")
        for behaviour in dict.fromkeys(rows["behaviour"]):
            for level in dict.fromkeys(rows.loc[rows["behaviour"] == behaviour, "curiosity_level"]):
                try:
                    by_seed = greedy(line.runs, behaviour, level)
                except CannotMeasure:
                    continue
                cells: dict[int, tuple[int, int, int]] = {}
                for percept in sorted({p for policy in by_seed.values() for p in policy}):
                    counts = Counter(policy[percept] for policy in by_seed.values() if percept in policy)
                    period, most = min(counts.items(), key=lambda item: (-item[1], item[0]))
                    cells[percept] = (period, most, sum(counts.values()))
                if cells:
                    found.append(Learned(title, behaviour, level, cells))
    return found
