"""Which condition a row or a line of the page is of, so that its script can hide all of it."""

from __future__ import annotations

from html import escape
from typing import NamedTuple

from attnlab.figures.panels import panels
from attnlab.results.conditions import Conditions


class Toggles(NamedTuple):
    """``names``: mark of the lines of a condition -> what they are called in figures; ``marks``: name of a condition in
    the study's file -> the mark of its lines."""
    names: dict[str, str]
    marks: dict[str, str]

    def html(self) -> str:
        """A box to tick for each; none for a single one. Hidden until a script is there to hear them."""
        if len(self.names) < 2:
            return ""
        boxes = "".join(f'<label><input type=checkbox checked value="{mark}"> {escape(name)}</label> '
                        for mark, name in self.names.items())
        return ('<details id=shown class="pick small" hidden><summary>Conditions shown</summary><div role=group '
                f'aria-label="Conditions shown">{boxes}</div></details>')


def of_study(conditions: Conditions) -> Toggles:
    """The lines of all figures that are drawn from a study."""
    names: dict[str, str] = {}
    marks: dict[str, str] = {}
    for panel in panels(conditions):
        for line in panel.lines:
            names.setdefault(line.gid, line.name)
            marks.update({conditions.study.condition(run).name: line.gid for run in line.runs.runs.values()})
    return Toggles(names, marks)
