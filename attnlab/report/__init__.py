"""What a study found: figures, verdicts on the paper's claims, and one page a person can read.

    python -m attnlab.report outputs/cr_vs_ncr

This module is light; pandas, scipy and matplotlib are imported when something is drawn.
"""

from __future__ import annotations

from pathlib import Path


def build_report(study_path: str | Path, out: str | Path | None = None, claims: str | None = None,
                 baselines: str | Path | None = None, quiet: bool = False) -> Path:
    """Write the report of a study and return the path of its page, ``<out>/index.html``.

    ``out``: a folder, ``<study>/report`` if left out. ``claims``: name or path of a claims file; the one
    that the runs were started under if left out, or dinocera2014.
    ``baselines``: a second study whose runs are drawn in the attention economics. ``quiet``: print nothing.
    Raises ConfigError if there is no such study, or no such or a wrong claims file.
    """
    from attnlab.report.build import build
    return build(study_path, out, claims, baselines, quiet)


def survival_picture(study_path: str | Path) -> Path:
    """Draw survival against episodes (mean over seeds, 95 % band, a line a condition) to ``<study>/survival.png``."""
    from attnlab.figures.base import FigureContext
    from attnlab.figures.style import drawing, save_png
    from attnlab.figures.survival import Survival
    from attnlab.results.conditions import Conditions
    from attnlab.results.load import load
    study = load(study_path)
    with drawing():
        figure = Survival(None, FigureContext()).draw(Conditions(study))
        return save_png(figure, study.path / "survival.png")
