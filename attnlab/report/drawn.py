"""Draws the figures that there are. One that fails is named in its place, and the others are drawn."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from attnlab.claims.judge import Verdict
from attnlab.errors import describe
from attnlab.figures.base import FigureContext, make
from attnlab.figures.style import png_bytes, svg_bytes
from attnlab.registry import parts
from attnlab.report.page import Shown
from attnlab.results.conditions import Conditions
from attnlab.tables.files import write_bytes


def draw(names: Sequence[str], context: FigureContext, conditions: Conditions, captions: Mapping[str, str],
         judged: Sequence[Verdict], target: Path) -> list[Shown]:
    """The figures of these names that apply to this study, written to ``target``/figures; ``judged``: verdicts that
    they may show."""
    found = []
    for name in names:
        paper = captions.get(name, "")
        try:
            figure = make(name, context)
            if not figure.applies(conditions):
                continue
            claims = [v.id for v in judged if figure.shows(v.claim.where, [p.part.measure_name for p in v.parts])]
            said = figure.say(conditions)
            png = save(figure.draw(conditions), figure.key, target)
            shown = Shown(figure.key, figure.heading, paper, said, png, claims, figure.how)
        except Exception as cause:  # noqa: BLE001  a figure of anybody's: it is named, and the page goes on
            spec = parts["figure", name]
            title = str(getattr(spec.cls, "title", "") or name)
            shown = Shown(name, title, paper, failed=f"{_short(spec.origin)}: {describe(cause)}")
        found.append(shown)
    return found


def _short(file: str) -> str:
    path, here = Path(file), Path.cwd()
    return str(path.relative_to(here)) if path.is_relative_to(here) else file


def save(drawn: Any, key: str, target: Path) -> bytes:
    """Write a figure as PNG and SVG, close it, return the PNG."""
    import matplotlib.figure
    import matplotlib.pyplot as plt
    if not isinstance(drawn, matplotlib.figure.Figure):
        raise TypeError(f"draw() gave {drawn!r}, not a matplotlib figure")
    png = png_bytes(drawn)
    drawn.set_layout_engine("none")  # everything has its place now; laying it out again would take as long as drawing
    svg = svg_bytes(drawn)
    plt.close(drawn)
    write_bytes(target / "figures" / f"{key}.png", png)
    write_bytes(target / "figures" / f"{key}.svg", svg)
    return png
