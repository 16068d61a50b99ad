"""The report's figures on a study, for a notebook: a function a figure, plugins' figures too.

    from attnlab import plot
    plot.survival("outputs/cr_vs_ncr")              # a folder, a study that was loaded, or its conditions
    plot.attention_economics(study, baselines="outputs/baselines")

Each returns a matplotlib Figure, one that says so where the study lacks what is drawn; ``dir(attnlab.plot)`` names them
all.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from attnlab.errors import nearest
from attnlab.figures.base import FigureContext, gallery, make

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from attnlab.results.conditions import Conditions
    from attnlab.results.load import Study

    Source = Study | Conditions | str | Path


def __getattr__(name: str) -> Callable[..., Figure]:
    if name.startswith("_"):
        raise AttributeError(name)
    known = gallery()
    if name not in known:
        raise AttributeError(f"no figure is called '{name}'. {nearest(name, known)}")

    def draw(study: Source, baselines: Source | None = None) -> Figure:
        import matplotlib.pyplot as plt

        from attnlab.figures.style import looks
        figure = make(name, FigureContext(None if baselines is None else _conditions(baselines)))
        conditions = _conditions(study)
        with looks():
            drawn = figure.draw(conditions) if figure.applies(conditions) else _nothing(figure.heading)
        plt.close(drawn)  # a notebook shows what is returned; left open, it would show it twice
        return drawn
    draw.__name__ = draw.__qualname__ = name
    draw.__doc__ = f"{make(name, FigureContext()).heading}, of a study; ``baselines``: another one for comparison."
    return draw


def __dir__() -> list[str]:
    return gallery()


def _nothing(heading: str) -> Figure:
    """A figure that says that a study lacks what is drawn."""
    from attnlab.figures.panels import grid
    from attnlab.figures.style import empty
    drawn, (ax,) = grid(1)
    empty(ax, f"{heading}: nothing of it is in this study")
    return drawn


def _conditions(study: Source) -> Conditions:
    from attnlab.results.conditions import Conditions
    from attnlab.results.load import load
    if isinstance(study, Conditions):
        return study
    return Conditions(load(study) if isinstance(study, (str, Path)) else study)
