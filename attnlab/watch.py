"""``python -m attnlab.watch STUDY [--once] [--every S]``: how a study stands, from its files alone."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from attnlab.console import guarded
from attnlab.errors import ConfigError

CLEAR = "\x1b[H\x1b[2J"


def main(argv: Sequence[str]) -> int:
    """Entry point; returns 0. Nothing is written, but for a probe of the file server's clock."""
    parser = argparse.ArgumentParser(
        prog="python -m attnlab.watch",
        description="How a study stands, whoever does its runs, wherever. Ends when nobody is at work at it.")
    parser.add_argument("study", help="folder of a study, or its name in outputs/")
    parser.add_argument("--once", action="store_true", help="one look")
    parser.add_argument("--every", type=float, default=5.0, metavar="S", help="seconds between two looks (default: 5)")
    given = parser.parse_args(list(argv))
    if not given.every > 0:
        raise ConfigError("--every", f"is {given.every}, must be more than 0")
    from attnlab.results.load import folder_of
    from attnlab.results.standing import watched
    clear = CLEAR if sys.stdout.isatty() and not given.once else ""
    for text in watched(folder_of(given.study), given.every):
        print(f"{clear}{text}", flush=True)
        if given.once:
            break
    return 0


if __name__ == "__main__":
    sys.exit(guarded(main))
