"""How conditions are spread over panels and lines: one rule for all figures."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from attnlab.figures.style import WIDTH_IN, colours, cut, dashes
from attnlab.figures.values import gid_of
from attnlab.measures.frames import of_seeds, phase_rows, split
from attnlab.measures.once import once_a_study
from attnlab.stats import bootstrap_band

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from attnlab.results.conditions import Conditions, Runs

MOST_PANELS = 12


@dataclass
class Line:
    """A condition as it is drawn: its name in the legend, colour and dash."""
    name: str
    runs: Runs
    colour: str
    dash: object

    @property
    def gid(self) -> str:
        """What its artists are marked with (``gid=line.gid``), so that the page can hide them."""
        return gid_of(self.name)


@dataclass
class Panel:
    """A group of lines that share axes; ``title`` is empty if there is only one panel."""
    title: str
    lines: list[Line]


@once_a_study
def panels(conditions: Conditions) -> list[Panel]:
    """Lines are the curiosities, panels the other settings. Where a curiosity has no rival under the same settings, the
    first setting makes the lines: generations of attention share their axes, though only one of them is curious."""
    curiosities = conditions.curiosities
    if not one_line_each(conditions):
        colour, dash = colours(curiosities), dashes(curiosities)
        found = []
        for stratum in conditions.strata:
            lines = [Line(cut(conditions.name(c), 40), conditions.runs(c, stratum), colour[c], dash[c])
                     for c in curiosities]
            found.append(Panel(conditions.stratum_name(stratum), [line for line in lines if line.runs.runs]))
        return found
    values = list(dict.fromkeys(stratum[0] for stratum in conditions.strata))
    colour, dash = colours([f"{v} " for v in values]), dashes(values)
    # a setting that follows from the first, as those of a variant do, tells no panels apart
    apart = [i for i in range(1, len(conditions.settings))
             if len({(stratum[0], stratum[i]) for stratum in conditions.strata}) > len(values)]
    groups: dict[tuple[str, ...], list[Line]] = {}
    for stratum in conditions.strata:
        value = stratum[0]
        curiosity, runs = next((c, runs) for c, runs in ((c, conditions.runs(c, stratum)) for c in curiosities)
                               if runs.runs)
        name = conditions.labels.get(value, value if len(curiosities) == 1 else f"{conditions.name(curiosity)} {value}")
        rest = tuple(stratum[i] for i in apart)
        groups.setdefault(rest, []).append(Line(cut(name, 40), runs, colour[f"{value} "], dash[value]))
    return [Panel(", ".join(f"{conditions.settings[i]}={v}" for i, v in zip(apart, rest, strict=True)), lines)
            for rest, lines in groups.items()]


@once_a_study
def one_line_each(conditions: Conditions) -> bool:
    """Does every combination of settings have one curiosity?"""
    return bool(conditions.settings) and all(sum(bool(conditions.runs(c, stratum).runs) for c in conditions.curiosities)
                                             == 1 for stratum in conditions.strata)


def title_of_lines(conditions: Conditions) -> str:
    """What the lines of a figure differ by."""
    return cut(conditions.settings[0], 40) if one_line_each(conditions) else ""


def shown(conditions: Conditions) -> tuple[list[Panel], str]:
    """The panels that are drawn (not more than 12) and a note if there are more."""
    found = panels(conditions)
    note = f"The first {MOST_PANELS} of {len(found)} combinations of settings are drawn." \
        if len(found) > MOST_PANELS else ""
    return found[:MOST_PANELS], note


def grid(count: int, height_in: float = 3.2, columns: int = 3, **sharing: Any) -> tuple[Figure, list[Axes]]:
    """A figure of page width with ``count`` panels, and its axes in reading order."""
    import matplotlib.pyplot as plt
    columns = max(1, min(columns, count))
    rows = -(-count // columns)
    height = height_in if rows == 1 else min(height_in, 2.7) * rows
    figure, axes = plt.subplots(rows, columns, figsize=(WIDTH_IN, height), squeeze=False, **sharing)
    flat = list(axes.flat)
    for place, spare in enumerate(flat[count:], start=count):
        spare.set_visible(False)
        if place >= columns:  # the panel above it is the lowest of its column
            flat[place - columns].tick_params(labelbottom=True)
    return figure, flat[:count]


def legend(figure: Figure, axes: list[Axes], title: str = "") -> None:
    """One legend for all panels: above them, beside the title, or below them if there are too many names for that."""
    entries: dict[str, Artist] = {}
    for ax in axes:
        for handle, label in zip(*ax.get_legend_handles_labels(), strict=True):
            entries.setdefault(label, handle)
    if entries:
        where: Any = "outside upper right" if sum(map(len, entries)) + 6 * len(entries) < 60 else "outside lower center"
        figure.legend(handles=list(entries.values()), labels=list(entries), loc=where, ncol=_columns(list(entries)),
                      title=title or None, columnspacing=1.6, handlelength=2.4)


def _columns(names: list[str]) -> int:
    """Columns of a legend with these names: as many as the page has room for, five at most."""
    room = WIDTH_IN * 72 / 5  # letters of 5 pt; a line and the gaps beside it take nine
    for count in range(min(5, len(names)), 1, -1):
        parts = np.array_split([len(name) for name in names], count)  # as matplotlib does, the first columns longest
        if sum(9 + part.max() for part in parts) <= room:
            return count
    return 1


def band(ax: Axes, x: np.ndarray, values: np.ndarray, line: Line, label: bool = True, **style: Any) -> None:
    """Mean line and 95 % band over seeds of ``values`` (seeds, x)."""
    centre, low, high = bootstrap_band(values)
    ax.plot(x, centre, color=line.colour, ls=line.dash, label=line.name if label else None, gid=line.gid,
            **style)
    if np.isfinite(low).any():
        ax.fill_between(x, low, high, color=line.colour, alpha=0.18, lw=0, gid=line.gid)


@once_a_study
def _of_behaviour(conditions: Conditions, table: str, phase: str, behaviour: str | None) -> dict[str, pd.DataFrame]:
    """Run -> its rows of a phase, of all behaviours or of one."""
    rows = phase_rows(conditions, table, phase)
    return split(rows if behaviour is None else rows[rows["behaviour"] == behaviour])


@once_a_study
def _series(conditions: Conditions, table: str, column: str, phase: str, behaviour: str | None
            ) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Run -> (episodes, values of a column in them)."""
    rows = _of_behaviour(conditions, table, phase, behaviour)
    return {run: (mine["episode"].to_numpy(), mine[column].to_numpy(float)) for run, mine in rows.items()}


def by_episode(runs: Runs, table: str, column: str, block: int, phase: str = "train", behaviour: str | None = None
               ) -> tuple[np.ndarray, np.ndarray]:
    """Block means: (episode at each block's end, values of shape (seeds, blocks)); nan where a seed has no episodes."""
    series = of_seeds(runs, _series(runs.conditions, table, column, phase, behaviour))
    if not series:
        return np.zeros(0), np.zeros((0, 0))
    last = max(int(episode.max()) for episode, _ in series.values())
    blocks = -(-(last + 1) // block)
    means = np.full((len(runs.runs), blocks), np.nan)
    for row, seed in enumerate(sorted(runs.runs)):
        if seed in series:
            episode, y = series[seed]
            good = ~np.isnan(y)
            total = np.bincount(episode[good] // block, y[good], blocks)
            count = np.bincount(episode[good] // block, minlength=blocks)
            with np.errstate(invalid="ignore", divide="ignore"):
                means[row] = total / count
    return np.minimum((np.arange(blocks) + 1) * block, last + 1), means


def block_of(conditions: Conditions, wanted: int, phase: str = "train") -> int:
    """The paper's block of episodes, or a smaller one if that would leave fewer than five points."""
    frame = conditions.frame("episodes")
    episodes = frame.loc[frame["phase"] == phase, "episode"].to_numpy() if len(frame) else np.zeros(0)
    most = int(episodes.max()) + 1 if len(episodes) else 0
    return wanted if most >= 5 * wanted or not most else max(1, most // 8)
