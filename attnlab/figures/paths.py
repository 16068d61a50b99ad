"""Fig 11: where the robots have been, and how much of the floor that is."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from attnlab.figures.base import Figure
from attnlab.figures.episode import first_lines, last_episode
from attnlab.figures.found import MOST, interval, sentence
from attnlab.figures.panels import Line
from attnlab.figures.style import GREY, WIDTH_IN, cut, empty, own_colours
from attnlab.figures.values import Cells, tell
from attnlab.measures.base import CannotMeasure
from attnlab.measures.space import Coverage, visit_maps
from attnlab.registry import register
from attnlab.stats import mean_interval
from attnlab.tables.schema import CELL_M

if TYPE_CHECKING:
    import matplotlib.figure
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Drawing

    from attnlab.results.conditions import Conditions
    from attnlab.worlds.base import Layout

KINDS = {"wall": "#444444", "obstacle": "#111111", "food": "#009e73", "water": "#0072b2"}


@register("figure", "paths")
class Paths(Figure):
    """Visits in training (shade, first seed), the last recorded path (line), and coverage of every seed by the centre
    and by the body."""
    title, order, place = "paths and coverage", 110, "Fig 11"
    how = ("Shade: visits in training of the first seed (dark: often); line: its last recorded episode from the circle "
           "on; green: food, blue: water.")

    def draw(self, conditions: Conditions) -> Drawing:
        import matplotlib.pyplot as plt
        lines = first_lines(conditions, MOST)
        per_row = min(3, max(1, len(lines)))
        map_rows = -(-max(1, len(lines)) // per_row)
        layouts = [_layout(line) for _, line in lines]
        own = own_colours({solid.kind for layout in layouts if layout for solid in layout.solids} - set(KINDS))
        below, above = 1.3 + 0.5 * max(2, len(lines)), 0.3 if own else 0.0
        figure = plt.figure(figsize=(WIDTH_IN, 2.9 * map_rows + below + above + 0.3))
        outer = figure.add_gridspec(2, 1, height_ratios=[2.9 * map_rows, below])
        maps = outer[0].subgridspec(map_rows, per_row)
        for place, ((title, line), layout) in enumerate(zip(lines, layouts, strict=True)):
            ax = figure.add_subplot(maps[place // per_row, place % per_row])
            _map(ax, line, layout, {**KINDS, **own})
            ax.set_title(cut(title, 96 // per_row), color=line.colour)
        bars = outer[1].subgridspec(1, 2)
        for place, footprint in enumerate((False, True)):
            ax = figure.add_subplot(bars[0, place])
            _coverage(ax, lines, footprint)
        if own:
            _legend(figure, layouts, {**KINDS, **own})
        return figure

    def say(self, conditions: Conditions) -> str:
        parts = []
        for title, line in first_lines(conditions, MOST):
            try:
                cells, body = (interval(Coverage(Coverage.Params(phase="train", footprint=f)).of(line.runs), 1)
                               for f in (False, True))
                parts.append(f"{title} {cells} % by the centre and {body} % by the body")
            except CannotMeasure:
                continue
        return sentence(parts, "floor covered in training: ", conditions)


def _layout(line: Line) -> Layout | None:
    """The world of the seed whose map is drawn; None if there is no map."""
    try:
        seed = min(visit_maps(line.runs, "train"))
    except CannotMeasure:
        return None
    return line.runs.conditions.layout(line.runs.runs[seed])


def _map(ax: Axes, line: Line, layout: Layout | None, colour: dict[str, str]) -> None:
    try:
        found = visit_maps(line.runs, "train")
    except CannotMeasure as why:
        empty(ax, str(why))
        return
    seed = min(found)
    visits = found[seed]
    extent = (0, visits.shape[0] * CELL_M, 0, visits.shape[1] * CELL_M)
    shade = np.where(visits > 0, np.log10(np.maximum(visits, 1)), np.nan)
    ax.imshow(shade.T, origin="lower", extent=extent, cmap="Greys", vmin=-1.0, vmax=max(1.0, np.nanmax(shade) * 1.35),
              interpolation="nearest")
    edges = CELL_M * np.arange(visits.shape[0] + 1), CELL_M * np.arange(visits.shape[1] + 1)
    columns, rows = ([f"{name} {edge + CELL_M / 2:.2f} m" for edge in of[:-1]]
                     for name, of in zip("xy", edges, strict=True))
    said = [[f"{count:.0f}" if count else "" for count in row] for row in visits.T]
    tell(ax, Cells(columns, rows, *edges, said, " visits"))
    assert layout is not None  # visit_maps has complained
    for solid in layout.solids:
        ax.fill(*zip(*solid.corners(), strict=True), color=colour[solid.kind], lw=0)
    cycles, shown_seed = last_episode(line)
    if cycles is not None and shown_seed == seed:
        ax.plot(cycles["x_m"], cycles["y_m"], color=line.colour, lw=0.9)
        ax.plot(cycles["x_m"].iloc[0], cycles["y_m"].iloc[0], "o", ms=5, mfc="white", mec=line.colour)
    ax.set_xlim(-0.1, layout.width_m + 0.1)
    ax.set_ylim(-0.1, layout.depth_m + 0.1)
    ax.set_aspect("equal")
    ax.set_xlabel("x, m")
    ax.set_ylabel("y, m")
    ax.grid(False)


def _legend(figure: matplotlib.figure.Figure, layouts: list[Layout | None], colour: dict[str, str]) -> None:
    """Which colour is what: for worlds with boxes of other kinds than the paper's."""
    from matplotlib.patches import Patch
    there = {solid.kind for layout in layouts if layout for solid in layout.solids}
    figure.legend(handles=[Patch(color=shade, label=kind) for kind, shade in colour.items() if kind in there],
                  loc="outside upper right", ncol=6, handlelength=1.0)


def _coverage(ax: Axes, lines: list[tuple[str, Line]], footprint: bool) -> None:
    measure = Coverage(Coverage.Params(phase="train", footprint=footprint))
    for place, (_, line) in enumerate(reversed(lines)):
        try:
            values = list(measure.of(line.runs).values())
        except CannotMeasure:
            continue
        ax.plot(values, [place] * len(values), "o", ms=3.5, alpha=0.45, mew=0, color=line.colour, gid=line.gid)
        mean, low, high = mean_interval(values)
        if np.isfinite(low):
            ax.plot([low, high], [place, place], color=line.colour, lw=3, solid_capstyle="butt", alpha=0.6,
                    gid=line.gid)
        ax.plot(mean, place, "D", ms=6, color=line.colour, gid=line.gid)
        ax.annotate(f"{mean:.1f} %", (mean, place), xytext=(0, 9), textcoords="offset points", ha="center",
                    fontsize=8.5)
    ax.set_yticks(range(len(lines)), [cut(title, 26) for title, _ in reversed(lines)])
    ax.set_ylim(-0.6, len(lines) - 0.25)
    ax.margins(x=0.15)
    ax.set_title("floor touched by the body" if footprint else "floor visited by the centre")
    ax.set_xlabel("% of the floor, training")
    if not ax.lines:
        empty(ax, "no coverage was recorded")
    ax.spines["left"].set_color(GREY)
