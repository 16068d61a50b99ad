"""``python -m attnlab.retry STUDY [--jobs N]``: do again what failed, and what is missing or damaged."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from attnlab.console import guarded
from attnlab.loading import load_all


def main(argv: Sequence[str]) -> int:
    """Entry point; 0, or 1 if a run failed again."""
    parser = argparse.ArgumentParser(prog="python -m attnlab.retry",
                                     description="Do the runs of a study again that failed, are damaged or missing.")
    parser.add_argument("study", help="folder of a study, or its name in outputs/")
    parser.add_argument("--jobs", type=int, metavar="N", help="runs side by side (default: all cores)")
    given = parser.parse_args(list(argv))
    from attnlab.launch.asked import do
    load_all()
    return do(given.study, at_once=given.jobs, failed=True)


if __name__ == "__main__":
    sys.exit(guarded(main))
