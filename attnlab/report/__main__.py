"""``python -m attnlab.report STUDY [--out DIR] [--claims NAME] [--baselines STUDY | --against STUDY] [--quiet]``."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from attnlab.console import guarded
from attnlab.errors import ConfigError
from attnlab.report.steps import Steps


def main(argv: Sequence[str]) -> int:
    """Entry point; returns 0."""
    parser = argparse.ArgumentParser(
        prog="python -m attnlab.report", description="Figures, verdicts on the paper's claims and one page of a study.")
    parser.add_argument("study", help="folder of a study, or its name in outputs/")
    parser.add_argument("--out", help="folder of the report (default: report/ in the study)")
    parser.add_argument("--claims", help="name or path of a claims file (default: that of the runs); docs/claims.md")
    parser.add_argument("--baselines", metavar="STUDY", help="a study of baselines for the attention economics")
    parser.add_argument("--against", metavar="STUDY2", help="hold the study against this one, on a page of their own")
    parser.add_argument("--quiet", action="store_true", help="print nothing")
    given = parser.parse_args(list(argv))
    from attnlab.report import build_report, compare
    if given.against:
        if given.baselines:
            raise ConfigError("--baselines", "belongs to a report, not to two studies side by side")
        page = compare(given.study, given.against, given.out, given.claims)
        print("" if given.quiet else page, end="" if given.quiet else "\n")
        return 0
    if given.quiet:
        build_report(given.study, given.out, given.claims, given.baselines, quiet=True)
        return 0
    with Steps("drawing the report", "figures") as steps:
        build_report(given.study, given.out, given.claims, given.baselines, tell=steps)
    return 0


if __name__ == "__main__":
    sys.exit(guarded(main))
