"""The parts of the page that a study of many readings has, and the files beside it."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from attnlab.report import curve, drawn, kept, spread, told
from attnlab.report.curve_tables import curve_csv, effects_csv, joint_csv, shares_csv
from attnlab.report.explorer import script
from attnlab.report.multiverse import Multiverse
from attnlab.report.page import Section
from attnlab.report.sentences import apart
from attnlab.tables.files import write_bytes


@dataclass
class Page:
    """What comes first on a page: its first screen (HTML), the sections after it, their script; and notes."""
    first_screen: str
    sections: list[Section] = field(default_factory=list)
    script: str = ""
    notes: list[str] = field(default_factory=list)


def of(found: Multiverse, study: Path, target: Path) -> Page:
    """Writes tables and figures to ``target``; what the filter of the readings did is in ``study``, if it is known."""
    write_bytes(target / "effects.csv", effects_csv(found))
    curves = found.curves
    if curves is not None:
        for name, csv in (("curve", curve_csv(found, curves)), ("joint", joint_csv(found, curves)),
                          ("shares", shares_csv(curves))):
            write_bytes(target / f"{name}.csv", csv)
        drawn.save(curve.curves(curves), "multiverse_curves", target)
        drawn.save(curve.dashboard(found, curves, curve.ranked(curves)[0]), "multiverse_dashboard", target)
    drawn.save(curve.shares(found), "multiverse_shares", target)
    which, note = kept.section(study)
    notes = [said for said in (note, apart(curves) if curves is not None else "") if said]
    return Page(told.first_screen(found), [*told.sections(found), spread.section(found), *([which] if which else [])],
                script() if curves is not None else "", notes)
