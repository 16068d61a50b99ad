"""Draws the figures that there are, by all cores. One that fails is named in its place, and the others are drawn."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from attnlab.claims.judge import Verdict
from attnlab.errors import describe
from attnlab.figures import values
from attnlab.figures.base import FigureContext, make
from attnlab.figures.style import png_bytes, svg_bytes
from attnlab.registry import parts
from attnlab.report.hands import Hands
from attnlab.report.plates import Shown
from attnlab.results.conditions import Conditions
from attnlab.tables.files import write_bytes


@dataclass
class Gallery:
    """What the figures of a study are drawn from, and where their files go: ``target``/figures. ``captions``: figure
    -> what the paper shows there."""
    context: FigureContext
    conditions: Conditions
    captions: Mapping[str, str]
    target: Path

    def begin(self, names: Sequence[str], hands: int) -> Hands[str, Shown | None]:
        """Draw the figures of these names that apply to this study, so many at a time."""
        return Hands(self.sketch, self.failed, names, hands)

    def sketch(self, name: str) -> Shown | None:
        """A figure in its files, and what it says; None where there is nothing to draw."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # a glyph that the font lacks, a mean of nothing
            try:
                figure = make(name, self.context)
                if not figure.applies(self.conditions):
                    return None
                said = figure.say(self.conditions)
                lines = save(figure.draw(self.conditions), figure.key, self.target)
                # its place in the paper stands on the pages of that paper's claims alone
                title = figure.heading if self.captions else figure.title or name
                return Shown(figure.key, title, self.captions.get(name, ""), said, values=lines,
                             how=figure.how)
            except Exception as cause:  # noqa: BLE001  a figure of anybody's: it is named, and the page goes on
                return self.failed(name, describe(cause))

    def failed(self, name: str, why: str) -> Shown:
        """What stands in its place."""
        spec = parts["figure", name]
        title = str(getattr(spec.cls, "title", "") or name)
        return Shown(name, title, self.captions.get(name, ""), failed=f"{_short(spec.origin)}: {why}")

    def shown(self, name: str, drawn: Shown, judged: Sequence[Verdict]) -> Shown:
        """With its picture, and those of the verdicts that it may show."""
        if drawn.failed:
            return drawn
        try:
            figure = make(name, self.context)
            drawn.claims = [v.id for v in judged if figure.shows(v.claim.where, [p.part.measure_name for p in v.parts])]
            drawn.png, drawn.svg = ((self.target / "figures" / f"{drawn.key}.{kind}").read_bytes()
                                    for kind in ("png", "svg"))
        except Exception as cause:  # noqa: BLE001  as above
            return self.failed(name, describe(cause))
        return drawn


def _short(file: str) -> str:
    path, here = Path(file), Path.cwd()
    return str(path.relative_to(here)) if path.is_relative_to(here) else file


def save(drawn: Any, key: str, target: Path) -> str:
    """Write a figure as PNG and SVG and the values of its lines as CSV, close it; the values as JSON, none: empty."""
    import matplotlib.figure
    import matplotlib.pyplot as plt
    if not isinstance(drawn, matplotlib.figure.Figure):
        raise TypeError(f"draw() gave {drawn!r}, not a matplotlib figure")
    png = png_bytes(drawn)
    drawn.set_layout_engine("none")  # everything has its place now; laying it out again would take as long as drawing
    found = values.plots(drawn)
    svg = svg_bytes(drawn)
    plt.close(drawn)
    write_bytes(target / "figures" / f"{key}.png", png)
    write_bytes(target / "figures" / f"{key}.svg", svg)
    if found:
        write_bytes(target / "figures" / f"{key}.csv", values.as_csv(found))
    return values.as_json(found)
