"""One look for all figures: colours that everybody can tell apart, type that is readable at page width, and files that
are the same bytes for the same data."""

from __future__ import annotations

import io
import zlib
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from attnlab.tables.files import write_bytes

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from attnlab.results.conditions import Conditions

# Okabe & Ito's palette, without its yellow (too light for lines). The paper draws CR red and NCR blue.
VERMILLION, BLUE = "#d55e00", "#0072b2"
OTHERS = ("#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#555555", "#882255", "#999933", "#44aa99", "#332288", "#aa4499")
OWN = ("#e69f00", "#cc79a7", "#f0e442", "#882255", "#999933")  # for what an author made up; away from green and blue
DASHES = ("-", (0, (5, 1.6)), (0, (1.5, 1.2)), (0, (6, 1.4, 1.5, 1.4)))
ROLE_COLOURS = {"litman": VERMILLION, "none": BLUE}
WIDTH_IN = 8.6
DPI = 140
INK, GREY = "#222222", "#767676"


@contextmanager
def looks() -> Iterator[None]:
    """Settings under which every figure is drawn: fixed identifiers, our type sizes."""
    import matplotlib
    rc: Any = {"axes.grid": True, "axes.axisbelow": True, "xtick.bottom": False, "ytick.left": False,
          "patch.edgecolor": "w", "patch.force_edgecolor": True, "lines.solid_capstyle": "round",
          "svg.hashsalt": "attnlab", "svg.fonttype": "path", "font.family": "DejaVu Sans", "font.size": 9.5,
          "axes.titlesize": 10.5, "axes.titleweight": "bold", "axes.titlelocation": "left", "axes.labelsize": 9.5,
          "axes.edgecolor": "#999999", "axes.linewidth": 0.8, "axes.spines.top": False, "axes.spines.right": False,
          "text.color": INK, "axes.labelcolor": INK, "xtick.color": INK, "ytick.color": INK, "legend.frameon": False,
          "legend.fontsize": 9, "xtick.labelsize": 8.5, "ytick.labelsize": 8.5, "grid.color": "#e6e6e6",
          "grid.linewidth": 0.7, "lines.linewidth": 1.8, "figure.dpi": DPI, "figure.constrained_layout.use": True,
          "axes.formatter.useoffset": False, "text.parse_math": False}
    with matplotlib.rc_context(rc):
        yield


@contextmanager
def drawing() -> Iterator[None]:
    """The same for figures that go to files: without a display. Closes all after."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    with looks():
        try:
            yield
        finally:
            plt.close("all")


def colours(names: Sequence[str]) -> dict[str, str]:
    """A colour for each value: those of the paper's two robots are always theirs."""
    free = OTHERS
    chosen: dict[str, str] = {}
    for name in names:
        chosen[name] = ROLE_COLOURS.get(name) or free[len([n for n in chosen if n not in ROLE_COLOURS]) % len(free)]
    return chosen


def own_colours(names: Iterable[str], palette: Sequence[str] = OWN) -> dict[str, str]:
    """A colour for each name that an author made up: the same in every figure and study, for it hangs on the name; the
    next free one where two would share."""
    chosen: dict[str, str] = {}
    for name in sorted(set(names)):
        wanted = zlib.crc32(name.encode()) % len(palette)
        order = [*palette[wanted:], *palette[:wanted]]
        chosen[name] = next((colour for colour in order if colour not in chosen.values()), order[0])
    return chosen


def dashes(names: Sequence[str]) -> dict[str, object]:
    """A line style for each value, so that no two lines differ by colour alone when there are many."""
    return {name: DASHES[i % len(DASHES)] for i, name in enumerate(names)}


def png_bytes(figure: Figure) -> bytes:
    """The figure as PNG without dates or versions in it. Drawn once: ``savefig`` would draw it twice."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    sink = io.BytesIO()
    figure.set_dpi(DPI)
    canvas: Any = FigureCanvasAgg(figure)
    canvas.print_png(sink, metadata={"Software": None})
    return sink.getvalue()


def svg_bytes(figure: Figure) -> bytes:
    """The figure as SVG without dates or versions in it."""
    from matplotlib.backends.backend_svg import FigureCanvasSVG
    sink = io.BytesIO()
    canvas: Any = FigureCanvasSVG(figure)
    canvas.print_svg(sink, metadata={"Date": None, "Creator": None})
    return sink.getvalue()


def save_png(figure: Figure, path: Path) -> Path:
    write_bytes(path, png_bytes(figure))
    return path


def cut(text: str, most: int = 60) -> str:
    """A text that fits in a figure."""
    return text if len(text) <= most else text[:most - 1] + "…"


def empty(axes: Axes, why: str) -> None:
    """Say in the panel why nothing is drawn."""
    axes.text(0.5, 0.5, why, ha="center", va="center", transform=axes.transAxes, color=GREY, wrap=True)
    axes.set_xticks([])
    axes.set_yticks([])


def seeds_note(conditions: Conditions) -> str:
    """What the bands are, for captions and titles."""
    counts = {len(conditions.runs(c, s).runs) for s in conditions.strata for c in conditions.curiosities} - {0}
    if not counts:
        return "no complete runs"
    least, most = min(counts), max(counts)
    if most == 1:
        return "one seed: no band can be drawn"
    number = f"{most}" if least == most else f"{least} to {most}"
    return f"bands: 95 % bootstrap intervals over {number} seeds"
