"""``python -m attnlab.index [OUTPUTS] [--out FILE]``: all studies of a folder on one page."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from attnlab.console import guarded


def main(argv: Sequence[str]) -> int:
    """Entry point; returns 0."""
    parser = argparse.ArgumentParser(
        prog="python -m attnlab.index", description="One page with a card for every study: what it found, its report.")
    parser.add_argument("outputs", nargs="?", type=Path, default=Path("outputs"), help="folder of studies (outputs)")
    parser.add_argument("--out", type=Path, help="the page's file; index.html in that folder if left out")
    given = parser.parse_args(list(argv))
    from attnlab.report.shelf import build
    print(build(given.outputs, given.out))
    return 0


if __name__ == "__main__":
    sys.exit(guarded(main))
