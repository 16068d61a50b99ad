"""``python -m attnlab.logs FILE``: what is in a log, and what of it was skipped."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from math import degrees
from pathlib import Path

from attnlab.console import guarded
from attnlab.logs.command import add_arguments, log_of


def main(argv: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m attnlab.logs", description="Say what is in a log of a real robot.")
    parser.add_argument("log", type=Path, help="CSV, CARMEN, MRPT rawlog or MCAP, perhaps gzipped")
    add_arguments(parser)
    log = log_of(parser.parse_args(argv))
    count, first, last, posed = 0, 0.0, 0.0, 0
    for scan in log:
        first, last = first if count else scan.time_s, scan.time_s
        posed += scan.pose is not None
        count += 1
        beams = scan.beams
    print(f"{log.path.name}: {log.kind}, {count} scans")
    if count:
        low, high = (round(degrees(f(beams.bearings_rad)), 2) for f in (min, max))
        print(f"{len(beams.bearings_rad)} beams from {low:g} to {high:g} degrees, up to {beams.range_max_m:g} m; "
              f"{last - first:.1f} s, {(count - 1) / (last - first) if last > first else 0.0:.2f} scans a second; "
              f"{'poses' if posed == count else f'{posed} poses' if posed else 'no poses'}")
    for line in log.ledger.lines():
        print(line)
    return 0 if count else 1


if __name__ == "__main__":
    sys.exit(guarded(main))
