"""What a figure of the report is: a picture of a study, and a sentence that says what was found."""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import matplotlib.figure

    from attnlab.results.conditions import Conditions


@dataclass(frozen=True)
class FigureContext:
    """What a figure may use besides the study. ``baselines``: conditions of another one, drawn for comparison."""
    baselines: Conditions | None = None


class Figure(ABC):
    """A figure. Subclass it and register it as ``@register("figure", "mine")``; every report then draws it.

    ``title``: its heading. ``order``: where it stands on the page, small ones first. ``place``: the figure of the paper
    that shows the same (``Fig 6``), if there is one. ``how``: how to read it, below the figure. What the paper shows
    there is no business of a figure: that is data, in conf/captions.

    The drawing functions are those of :mod:`attnlab.figures.panels`: one rule for what is a panel and what is a line.
    """
    name: str
    title = ""
    order = 1000.0
    place = ""
    how = ""

    def __init__(self, params: Any, context: FigureContext):
        self.params, self.context = params, context

    @abstractmethod
    def draw(self, conditions: Conditions) -> matplotlib.figure.Figure:
        """Draw it. A study that lacks what it needs gets a figure that says so (:func:`attnlab.figures.style.empty`).
        Draws nothing at random."""

    @abstractmethod
    def say(self, conditions: Conditions) -> str:
        """What was found, in a sentence with its numbers."""

    def applies(self, conditions: Conditions) -> bool:
        """Is there anything to draw in this study? Where not, the page leaves the figure out."""
        return True

    @property
    def heading(self) -> str:
        """The title with its place in the paper: ``Fig 6: survival``."""
        title = self.title or self.name.replace("_", " ")
        return f"{self.place}: {title}" if self.place else title

    @property
    def key(self) -> str:
        """Names its files and its place on the page: ``fig06_survival``."""
        place = re.match(r"Fig (\d+)(\w*)", self.place)
        return f"fig{int(place[1]):02}{place[2].lower()}_{self.name}" if place else self.name

    def shows(self, where: str, measures: Sequence[str]) -> bool:
        """Does it show what a claim is about? ``where``: the claim's place in the paper; ``measures``: what it compares
        (what was learned is shown by the figure of policies alone)."""
        place = re.match(r"Fig (\d+)", self.place)
        return place is not None and re.search(rf"\bFig {place[1]}(?!\d)", where) is not None and \
            not any(name.startswith("policy") for name in measures)


def gallery() -> list[str]:
    """Names of all figures that there are, in their order on the page."""
    from attnlab.loading import load_all
    from attnlab.registry import parts
    load_all()
    specs = [spec for spec in parts.values() if spec.group == "figure"]
    return [spec.name for spec in sorted(specs, key=lambda spec: (getattr(spec.cls, "order", 0.0), spec.name))]


def make(name: str, context: FigureContext) -> Figure:
    """The figure of this name. Raises ConfigError if there is none."""
    from attnlab import registry
    made: Figure = registry.make("figure", {"name": name}, context)
    return made
