"""The values of a figure: for the pointer on the page, and as CSV.

They are read from the drawn figure, so that a figure of anybody's has them: of every line with a label, its points, and
the ends of its band where a filled area has the same ``gid``; where the ticks of the vertical axis are names, of every
row its mark and the ends of the line through it; of an image or a mesh, its cells.
"""

from __future__ import annotations

import json
import zlib
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple
from weakref import WeakKeyDictionary

import numpy as np
import numpy.typing as npt

from attnlab.tables.csvs import csv_bytes

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

MOST_POINTS = 120  # of a line, on the page; the CSV has all
WHOLE = 1000  # width and height of a figure in the page's numbers
UNTOLD = "_:"  # before the label of a line that stands in no legend, but has values: ``label=UNTOLD + name``
Floats = npt.NDArray[np.floating[Any]]


class Series(NamedTuple):
    """A line: ``points`` (n, 2) in the units of its axes, ``ends`` (n, 2) of its band (nan where there is none),
    ``places`` (n, 2) in thousandths of the figure from its upper left corner; ``gid`` names the condition."""
    name: str
    gid: str
    points: Floats
    ends: Floats
    places: Floats


class Cells(NamedTuple):
    """A heat map: names of its columns and rows, the edges between them (data), and what each cell says, a row of cells
    after the other from the first edge on; empty where it says nothing. ``unit`` follows what a cell says."""
    columns: Sequence[str]
    rows: Sequence[str]
    across: Floats
    up: Floats
    said: Sequence[Sequence[str]]
    unit: str = ""


class Plot(NamedTuple):
    """Axes with values: their labels and their box (left, top, right, bottom) in thousandths of the figure. ``rows``:
    each line is a row, its one point lies across; ``cells``: of a heat map, whose edges are at ``at`` (thousandths)."""
    title: str
    x: str
    y: str
    box: tuple[int, int, int, int]
    lines: list[Series]
    rows: bool = False
    cells: Cells | None = None
    at: tuple[list[int], list[int]] = ([], [])


_told: WeakKeyDictionary[Axes, Cells] = WeakKeyDictionary()


def tell(ax: Axes, cells: Cells) -> None:
    """What the cells of a heat map say at the pointer, instead of their bare numbers."""
    _told[ax] = cells


def gid_of(name: str) -> str:
    """What the artists of a condition are marked with, so that the page can hide them."""
    return f"of-{zlib.crc32(name.encode()):08x}"


def plots(figure: Figure) -> list[Plot]:
    """Every panel of a figure that was drawn which has values."""
    found = []
    width, height = figure.bbox.width, figure.bbox.height
    labels = figure.get_supxlabel(), figure.get_supylabel()
    below = next((ax.get_xlabel() for ax in reversed(figure.axes) if ax.get_xlabel()), labels[0])
    for ax in figure.axes:
        if not ax.get_visible():
            continue
        lines = [_series(ax, line, width, height) for line in ax.lines
                 if _name(line) and line.get_visible() and np.size(line.get_xdata())]
        ranked = [] if lines else _rows(ax, width, height)
        cells = _told.get(ax) or _cells(ax)
        if lines or ranked or cells:
            box = ax.get_window_extent()
            left, right = (round(WHOLE * x / width) for x in (box.x0, box.x1))
            top, bottom = (round(WHOLE * (1 - y / height)) for y in (box.y1, box.y0))
            title = next((text for loc in ("left", "center", "right") if (text := ax.get_title(loc=loc))), "")
            found.append(Plot(title, ax.get_xlabel() or below, ax.get_ylabel() or labels[1],
                              (left, top, right, bottom), lines or ranked, bool(ranked), cells,
                              _edges(ax, cells, width, height) if cells else ([], [])))
    return found


def _name(line: Line2D) -> str:
    """What a line is called; empty if it has no values to tell."""
    label = str(line.get_label()).removeprefix(UNTOLD)
    return "" if label.startswith("_") else label


def _names(axis: Axis) -> dict[float, str]:
    """The names at the ticks of an axis; none if they are numbers that matplotlib chose."""
    from matplotlib.ticker import FixedFormatter, FixedLocator, FuncFormatter
    locator, formatter = axis.get_major_locator(), axis.get_major_formatter()
    if not (isinstance(locator, FixedLocator) and isinstance(formatter, (FixedFormatter, FuncFormatter))):
        return {}
    return {float(at): " ".join(formatter(at, place).split()) for place, at in enumerate(axis.get_majorticklocs())}


def _rows(ax: Axes, width: float, height: float) -> list[Series]:
    """Of axes whose vertical ticks are names: the mark at each, with the ends of the line that runs through it."""
    found = []
    for at, name in _names(ax.yaxis).items():
        mine = [line for line in ax.lines if np.size(line.get_ydata()) and np.all(np.asarray(line.get_ydata()) == at)]
        marks = [line for line in mine if np.size(line.get_xdata()) == 1]
        if marks:
            series = _series(ax, marks[-1], width, height)
            spans = [np.asarray(line.get_xdata(), float) for line in mine
                     if np.size(line.get_xdata()) == 2 and line.get_linestyle() != "None"]
            ends = np.array([[spans[-1].min(), spans[-1].max()]]) if spans else series.ends
            found.append(series._replace(name=name, ends=ends))
    return found


def _cells(ax: Axes) -> Cells | None:
    """The numbers of an image or a mesh."""
    from matplotlib.collections import QuadMesh
    mesh = next((one for one in ax.collections if isinstance(one, QuadMesh)), None)
    if mesh is not None:
        corners = np.asarray(mesh.get_coordinates(), float)
        across, up, values = corners[0, :, 0], corners[:, 0, 1], mesh.get_array()
    elif ax.images:
        left, right, bottom, top = ax.images[0].get_extent()
        values = ax.images[0].get_array()
        if values is None or values.ndim != 2:
            return None  # a picture in colours has no numbers
        ends = (bottom, top) if ax.images[0].origin == "lower" else (top, bottom)
        across, up = np.linspace(left, right, values.shape[1] + 1), np.linspace(*ends, values.shape[0] + 1)
    else:
        return None
    grid: Floats = np.ma.filled(np.ma.asarray(values, float), np.nan).reshape(len(up) - 1, len(across) - 1)
    said = [[f"{value:.4g}" if np.isfinite(value) else "" for value in row] for row in grid]
    return Cells(_middles(ax.xaxis, across), _middles(ax.yaxis, up), across, up, said)


def _middles(axis: Axis, edges: Floats) -> list[str]:
    """What columns or rows between these edges are called: the name of the tick in it, or the number in its middle."""
    names = _names(axis)
    return [next((name for at, name in names.items() if min(ends) < at < max(ends)), f"{np.mean(ends):.3g}")
            for ends in pairwise(edges)]


def _edges(ax: Axes, cells: Cells, width: float, height: float) -> tuple[list[int], list[int]]:
    """Where the edges of cells are, in thousandths of the figure."""
    across = ax.transData.transform([(x, cells.up[0]) for x in cells.across])[:, 0]
    up = ax.transData.transform([(cells.across[0], y) for y in cells.up])[:, 1]
    return [round(WHOLE * x / width) for x in across], [round(WHOLE * (1 - y / height)) for y in up]


def _series(ax: Axes, line: Line2D, width: float, height: float) -> Series:
    points = np.asarray(line.get_xydata(), float)
    at = line.get_transform().transform(points) / (width, height) * WHOLE
    ends = np.full_like(points, np.nan)
    gid = line.get_gid() or ""
    if len(points) == 1:
        ends[0] = _ends(ax, line)
    first = next((other for other in ax.lines if other.get_gid() == gid), None)  # of a condition: it has the band
    for area in ax.collections:
        if gid and line is first and area.get_gid() == gid and area.get_paths():
            corners = np.concatenate([path.vertices for path in area.get_paths()])
            for row, x in enumerate(points[:, 0]):
                of = corners[corners[:, 0] == x, 1]
                if of.size:
                    ends[row] = of.min(), of.max()
    return Series(_name(line), gid, points, ends, np.column_stack([at[:, 0], WHOLE - at[:, 1]]))


def _ends(ax: Axes, mark: Line2D) -> tuple[float, float]:
    """Of a mark the ends of the upright line through it, in its colour; nan without one."""
    (x, y), = np.asarray(mark.get_xydata(), float)
    for line in ax.lines:
        points = np.asarray(line.get_xydata(), float)
        if points.shape == (2, 2) and line.get_color() == mark.get_color() and (points[:, 0] == x).all() and \
                points[:, 1].min() <= y <= points[:, 1].max():
            return float(points[:, 1].min()), float(points[:, 1].max())
    return float("nan"), float("nan")


def as_json(found: list[Plot]) -> str:
    """What the page's script reads: of each line at most 120 of its points, as texts beside their places."""
    content: list[dict[str, Any]] = []
    for plot in found:
        lines = []
        for line in plot.lines:
            kept = np.isfinite(line.points).all(axis=1) & np.isfinite(line.places).all(axis=1)
            rows = np.flatnonzero(kept)
            rows = rows[::max(1, -(-len(rows) // MOST_POINTS))]
            lines.append({"name": line.name, "gid": line.gid, "at": [
                [int(u), int(v), float(f"{x:.4g}"), _said(x if plot.rows else y, low, high)]
                for (u, v), (x, y), (low, high) in zip(line.places[rows].round(), line.points[rows], line.ends[rows],
                                                       strict=True)]})
        content.append({"title": plot.title, "x": plot.x, "y": plot.y, "box": plot.box, "lines": lines})
        if plot.rows:
            content[-1]["rows"] = True
        if plot.cells is not None:
            content[-1]["cells"] = {"columns": plot.cells.columns, "rows": plot.cells.rows, "across": plot.at[0],
                                    "up": plot.at[1], "said": plot.cells.said, "unit": plot.cells.unit}
    return json.dumps(content, separators=(",", ":"), allow_nan=False) if content else ""


def _said(value: float, low: float, high: float) -> str:
    return f"{value:.4g}" + (f" [{low:.4g}, {high:.4g}]" if np.isfinite(low) else "")


def as_csv(found: list[Plot]) -> bytes:
    """A row for every point of every line: panel, line, labels of the axes, x, y, and the ends of its band (of a row of
    a ranked figure those of its x); and one for every cell of a heat map, whose row is its line: x is its column, y
    what it says."""
    return csv_bytes(["panel", "line", "x_label", "y_label", "x", "y", "low", "high"],
                     (row for plot in found for row in [*_points(plot), *_said_by(plot)]))


def _points(plot: Plot) -> Iterator[list[str]]:
    for line in plot.lines:
        for row in np.hstack([line.points, line.ends]):
            yield [plot.title, line.name, plot.x, plot.y, *(f"{n:.9g}" if np.isfinite(n) else "" for n in row)]


def _said_by(plot: Plot) -> Iterator[list[str]]:
    """Of the cells of a heat map."""
    if plot.cells is not None:
        for name, row in zip(plot.cells.rows, plot.cells.said, strict=True):
            for column, said in zip(plot.cells.columns, row, strict=True):
                if said:
                    yield [plot.title, name, plot.x, plot.y, column, said + plot.cells.unit, "", ""]
