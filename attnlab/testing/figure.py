"""Checks of a figure of the report, on small studies."""

from __future__ import annotations

from typing import Any

from attnlab.figures.base import Figure, FigureContext
from attnlab.figures.style import drawing, png_bytes
from attnlab.registry import make
from attnlab.testing.build import node
from attnlab.testing.measure import under_random_states
from attnlab.testing.study import conditions

KINDS = ("normal", "bare", "empty")


def figure_of(name: str, settings: dict[str, Any], baselines: bool = False) -> Figure:
    """The figure, with a study of baselines or without."""
    context = FigureContext(conditions() if baselines else None)
    made: Figure = make("figure", node("figure", name, **settings), context)
    return made


def has_its_place(name: str, **settings: Any) -> None:
    """A heading, and an order that is a number."""
    figure = figure_of(name, settings)
    assert figure.heading.strip() and figure.key.isidentifier(), f"{name}: {figure.heading!r}, {figure.key!r}"
    assert isinstance(figure.order, (int, float)), f"{name}: its order is {figure.order!r}"


def draws_any_study(name: str, **settings: Any) -> None:
    """It draws a normal study, one without needs and AVOID, and one without complete runs; with baselines too."""
    import matplotlib.figure
    for kind in KINDS:
        for baselines in (False, True):
            with drawing():
                figure, study = figure_of(name, settings, baselines), conditions(kind)
                if not figure.applies(study):
                    continue
                drawn = figure.draw(study)
                assert isinstance(drawn, matplotlib.figure.Figure), f"{name}: draw() of a {kind} study gave {drawn!r}"
                assert png_bytes(drawn)[:4] == b"\x89PNG"


def says_a_sentence(name: str, **settings: Any) -> None:
    """``say`` gives a sentence: a capital first, a full stop last; also where there is nothing to tell."""
    for kind in KINDS:
        figure, study = figure_of(name, settings), conditions(kind)
        if figure.applies(study):
            said = figure.say(study)
            assert isinstance(said, str) and said[:1].strip() and said.endswith("."), f"{name}, {kind}: {said!r}"
            assert not said[0].islower(), f"{name}, {kind}: {said!r}"


def same_bytes(name: str, **settings: Any) -> None:
    """The same study gives the same bytes, and nothing is drawn from the global random state."""
    def drawn() -> tuple[bytes, str]:
        with drawing():
            figure, study = figure_of(name, settings), conditions()
            return (png_bytes(figure.draw(study)), figure.say(study)) if figure.applies(study) else (b"", "")
    results = under_random_states(name, drawn)
    assert results[0] == results[1], f"{name}: drawn again, it is another figure"


CHECKS = (has_its_place, draws_any_study, says_a_sentence, same_bytes)
