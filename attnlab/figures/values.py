"""The values of a figure's lines: for the pointer on the page, and as CSV.

They are read from the drawn figure, so that a figure of anybody's has them: of every line with a label, its points, and
the ends of its band where a filled area has the same ``gid``.
"""

from __future__ import annotations

import json
import zlib
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from attnlab.tables.csvs import csv_bytes

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

MOST_POINTS = 120  # of a line, on the page; the CSV has all
WHOLE = 1000  # width and height of a figure in the page's numbers
Floats = npt.NDArray[np.float64]


class Series(NamedTuple):
    """A line: ``points`` (n, 2) in the units of its axes, ``ends`` (n, 2) of its band (nan where there is none),
    ``places`` (n, 2) in thousandths of the figure from its upper left corner; ``gid`` names the condition."""
    name: str
    gid: str
    points: Floats
    ends: Floats
    places: Floats


class Plot(NamedTuple):
    """Axes with lines: their labels and their box (left, top, right, bottom) in thousandths of the figure."""
    title: str
    x: str
    y: str
    box: tuple[int, int, int, int]
    lines: list[Series]


def gid_of(name: str) -> str:
    """What the artists of a condition are marked with, so that the page can hide them."""
    return f"of-{zlib.crc32(name.encode()):08x}"


def plots(figure: Figure) -> list[Plot]:
    """Every panel of a figure that was drawn which has a line with a label."""
    found = []
    width, height = figure.bbox.width, figure.bbox.height
    labels = figure.get_supxlabel(), figure.get_supylabel()
    below = next((ax.get_xlabel() for ax in reversed(figure.axes) if ax.get_xlabel()), labels[0])
    for ax in figure.axes:
        lines = [_series(ax, line, width, height) for line in ax.lines
                 if not str(line.get_label()).startswith("_") and line.get_visible() and np.size(line.get_xdata())]
        if lines and ax.get_visible():
            box = ax.get_window_extent()
            left, right = (round(WHOLE * x / width) for x in (box.x0, box.x1))
            top, bottom = (round(WHOLE * (1 - y / height)) for y in (box.y1, box.y0))
            title = next((text for loc in ("left", "center", "right") if (text := ax.get_title(loc=loc))), "")
            found.append(Plot(title, ax.get_xlabel() or below, ax.get_ylabel() or labels[1],
                              (left, top, right, bottom), lines))
    return found


def _series(ax: Axes, line: Line2D, width: float, height: float) -> Series:
    points = np.asarray(line.get_xydata(), float)
    at = line.get_transform().transform(points) / (width, height) * WHOLE
    ends = np.full_like(points, np.nan)
    gid = line.get_gid() or ""
    first = next((other for other in ax.lines if other.get_gid() == gid), None)  # of a condition: it has the band
    for area in ax.collections:
        if gid and line is first and area.get_gid() == gid and area.get_paths():
            corners = np.concatenate([path.vertices for path in area.get_paths()])
            for row, x in enumerate(points[:, 0]):
                of = corners[corners[:, 0] == x, 1]
                if of.size:
                    ends[row] = of.min(), of.max()
    return Series(str(line.get_label()), gid, points, ends, np.column_stack([at[:, 0], WHOLE - at[:, 1]]))


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
                [int(u), int(v), float(f"{x:.4g}"), _said(y, low, high)] for (u, v), (x, y), (low, high) in
                zip(line.places[rows].round(), line.points[rows], line.ends[rows], strict=True)]})
        content.append({"title": plot.title, "x": plot.x, "y": plot.y, "box": plot.box, "lines": lines})
    return json.dumps(content, separators=(",", ":"), allow_nan=False) if content else ""


def _said(value: float, low: float, high: float) -> str:
    return f"{value:.4g}" + (f" [{low:.4g}, {high:.4g}]" if np.isfinite(low) else "")


def as_csv(found: list[Plot]) -> bytes:
    """A row for every point of every line: panel, line, labels of the axes, x, y, and the ends of its band."""
    return csv_bytes(
        ["panel", "line", "x_label", "y_label", "x", "y", "low", "high"],
        ([plot.title, line.name, plot.x, plot.y, *(f"{n:.9g}" if np.isfinite(n) else "" for n in row)]
         for plot in found for line in plot.lines for row in np.hstack([line.points, line.ends])))
