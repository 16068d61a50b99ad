"""``python -m attnlab.work STUDY [--share I/N] [--minutes M] [--jobs N]``: do what is missing of a study."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from attnlab.console import guarded
from attnlab.errors import ConfigError
from attnlab.loading import load_all


def main(argv: Sequence[str]) -> int:
    """Entry point; 0, or 1 if a run failed. Any number of these may work at one study at once, on any machines that
    share its folder; each run is done by one of them. SIGTERM gives back what is running."""
    parser = argparse.ArgumentParser(
        prog="python -m attnlab.work",
        description="Do the runs of a study that are missing. Started again it goes on; several share the work.")
    parser.add_argument("study", help="folder of a study, or its name in outputs/")
    parser.add_argument("--share", default="1/1", metavar="I/N", help="begin with the I-th of N shares, then help")
    parser.add_argument("--minutes", type=float, metavar="M", help="leave before so many minutes are over")
    parser.add_argument("--jobs", type=int, metavar="N", help="runs side by side (default: all cores)")
    parser.add_argument("--run", action="append", metavar="NAME", help="only this run; several times for several")
    given = parser.parse_args(list(argv))
    if given.minutes is not None and not given.minutes > 0:
        raise ConfigError("--minutes", f"is {given.minutes}, must be more than 0")
    from attnlab.launch.asked import do
    load_all()
    return do(given.study, share_of(given.share), given.minutes, given.jobs, only=given.run)


def share_of(text: str) -> tuple[int, int]:
    """``3/10`` as (3, 10). Raises ConfigError."""
    one, _, of = text.partition("/")
    if not (one.isdecimal() and of.isdecimal() and 1 <= int(one) <= int(of)):
        raise ConfigError("--share", f"'{text}' is no share", "Write --share 1/10 up to --share 10/10")
    return int(one), int(of)


if __name__ == "__main__":
    sys.exit(guarded(main))
