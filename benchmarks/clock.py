"""``python benchmarks/clock.py [--page]``: what a call of a clock to take away costs (attnlab/clock.py).

A clock of three levels, four periods and six percepts, as the paper's robot learns, is asked in all of its states, and
for percepts of values all over its range. The least CPU time of several rounds, in microseconds a call; ``--page``
keeps it in benchmarks/results/clock.json and in docs/clock.md, where a test compares the two.
"""

from __future__ import annotations

import json
import platform
import re
import sys
import time
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))
RESULT = ROOT / "benchmarks" / "results" / "clock.json"
PAGE = ROOT / "docs" / "clock.md"
PLACE = re.compile(r"(<!-- clock: (\w+) -->).*?(<!-- end -->)")
ROUNDS, CALLS = 30, 20_000


def measured() -> dict[str, object]:
    """Microseconds a call, and where."""
    from attnlab.clock import Clock
    levels, periods, bins = ["low", "LH", "HH"], [1, 4, 8, 12], 6
    table = [[[(level + period + percept) % 4 for percept in range(bins)] for period in range(4)] for level in range(3)]
    clock = Clock(periods, levels, 0.0, 1.0, bins, table)
    percepts, asked = [i * 7 % bins + 1 for i in range(CALLS)], [levels[i % 3] for i in range(CALLS)]
    values = [i / CALLS for i in range(CALLS)]

    def each_next() -> None:
        for percept, level in zip(percepts, asked, strict=True):
            clock.next(percept, level)

    def each_percept() -> None:
        for value in values:
            clock.percept(value)
    return {"next": _us(each_next), "percept": _us(each_percept), "python": platform.python_version(),
            "machine": platform.machine()}


def _us(play: Callable[[], None]) -> float:
    best = float("inf")
    for _ in range(ROUNDS):
        began = time.process_time()
        play()
        best = min(best, time.process_time() - began)
    return round(best / CALLS * 1e6, 2)


def filled(text: str, found: dict[str, object]) -> str:
    """The page with its figures."""
    return PLACE.sub(lambda place: f"{place[1]}{found[place[2]]} us{place[3]}", text)


def main() -> int:
    found = measured()
    print(f"next {found['next']} us, percept {found['percept']} us a call (Python {found['python']})")
    if "--page" in sys.argv[1:]:
        RESULT.write_text(json.dumps(found, indent=1) + "\n")
        PAGE.write_text(filled(PAGE.read_text(), found))
    return 0


if __name__ == "__main__":
    sys.exit(main())
