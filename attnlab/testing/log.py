"""A log for checks of parts that live on one."""

from __future__ import annotations

import atexit
from functools import cache
from pathlib import Path

from attnlab.tables.scratch import scratch

SCANS = 1440
BLOCKS = 12  # of 120 scans: the cycles of a short run
BEARINGS_DEG = (90, 50, 30, 10, -10, -30, -50, -90, -90, -130, -150, -170, 170, 150, 130, 90)


def lines() -> list[str]:
    """The rows of a CSV: sixteen sonars that see things come and go, ten times a second, from a robot that drives
    along a line and turns."""
    bearings = list(dict.fromkeys(BEARINGS_DEG))
    head = ",".join(["t_s", "x_m", "y_m", "heading_rad", *(f"r{bearing}" for bearing in bearings)])
    rows = [head]
    for i in range(SCANS):
        near = [0.25 + abs((i * (3 + j) + 37 * j) % 100 - 50) / 20 for j in range(len(bearings))]
        rows.append(",".join([f"{i / 10}", f"{i / 100 - 3}", "1.5", f"{i % 60 / 20 - 1.5}", *map(str, near)]))
    return rows


@cache
def small_log() -> str:
    """Its path; gone when the process ends."""
    folder = scratch()
    atexit.register(folder.cleanup)
    path = Path(folder.name) / "log.csv"
    path.write_text("\n".join(lines()) + "\n")
    return str(path)
