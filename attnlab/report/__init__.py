"""What a study found: figures, verdicts on the paper's claims, and one page a person can read.

    python -m attnlab.report outputs/cr_vs_ncr

This module is light; pandas, scipy and matplotlib are imported when something is drawn.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from attnlab.results.load import Study


def build_report(study: Study | str | Path, out: str | Path | None = None, claims: str | None = None,
                 baselines: str | Path | None = None, quiet: bool = False,
                 tell: Callable[[int, int], None] | None = None) -> Path:
    """Write the report of a study and return the path of its page, ``<out>/index.html``.

    ``out``: a folder, ``<study>/report`` if left out. ``claims``: name or path of a claims file; the one
    that the runs were started under if left out, or dinocera2014.
    ``baselines``: a second study whose runs are drawn in the attention economics. ``quiet``: print nothing.
    ``tell`` hears how many figures of how many are drawn.
    Raises ConfigError if there is no such study, or no such or a wrong claims file.
    """
    from attnlab.report.build import build
    return build(study, out, claims, baselines, quiet, tell)


def statements_of(page: Path) -> str:
    """How many statements of each kind the report of a multiverse makes, in words; empty for any other report."""
    import csv
    import io
    from collections import Counter
    file = page.parent / "joint.csv"
    if not file.is_file():
        return ""
    kinds = Counter(row["statement"] for row in csv.DictReader(io.StringIO(file.read_text())))
    return f"{', '.join(f'{count} {kind}' for kind, count in kinds.most_common())}, of {kinds.total()} comparisons"


def compare(study: str | Path, other: str | Path, out: str | Path | None = None, claims: str | None = None) -> Path:
    """Write the page that holds a study against another one: conditions of the same name side by side, with the
    interval of every difference (paired by seed where seeds are shared and at most one thing was set otherwise),
    verdicts, and what their settings differ in. Returns the page, ``<out>/against-<other>.html``; a CSV of the
    numbers is beside it.

    ``out``, ``claims``: as for :func:`build_report`, of the first study. Raises ConfigError if one of them is no study,
    they are the same one, or they have no condition in common.
    """
    from attnlab.report.facing import build
    return build(study, other, claims, out)


def survival_picture(study: Study | str | Path) -> Path:
    """Draw survival against episodes (mean over seeds, 95 % band, a line a condition) to ``<study>/survival.png``."""
    from attnlab.figures.base import FigureContext
    from attnlab.figures.style import drawing, save_png
    from attnlab.figures.survival import Survival
    from attnlab.results.conditions import Conditions
    from attnlab.results.load import load
    found = load(study)
    with drawing():
        figure = Survival(None, FigureContext()).draw(Conditions(found))
        return save_png(figure, found.path / "survival.png")
