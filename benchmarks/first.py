"""``python benchmarks/first.py --publish``: what the first command of the README takes.

CPU seconds of the study and of all its processes, in an empty folder; wall seconds too, which other work on the machine
makes more. ``--publish`` stores them, and writes the README's times: a fast machine's and a slow one's.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import shlex
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
RESULT = ROOT / "benchmarks" / "results" / "first.json"
MARK = re.compile(r"(<!-- first: by python benchmarks/first.py --publish -->).*?(<!-- end -->)", re.DOTALL)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--publish", action="store_true", help=f"store them in {RESULT.relative_to(ROOT)}")
    given = parser.parse_args()
    sys.path.insert(0, str(ROOT))
    from benchmarks.batch import of_command
    readme = ROOT / "README.md"
    typed = first(readme.read_text())
    found = {"command": shlex.join(typed), "cores": len(os.sched_getaffinity(0)), "load_before": os.getloadavg()[0],
             **of_command(typed)}
    print(json.dumps(found, indent=1))
    if given.publish:
        RESULT.write_text(json.dumps(found, indent=1) + "\n")
        readme.write_text(said(readme.read_text(), found))
    return 0


def first(text: str) -> list[str]:
    """The study of the README's first command, as arguments of attnlab."""
    line = re.search(r"^    python3 -m venv .* -m attnlab (.*)$", text, re.MULTILINE)
    assert line is not None
    return shlex.split(line[1])


def said(text: str, found: dict[str, Any]) -> str:
    """The README with its times: of two quiet cores, from the CPU time, and of the machine as busy as it was."""
    quick, slow = found["cpu_s"] / 2, found["wall_s"]
    return MARK.sub(lambda m: f"{m[1]}{max(10, round(quick, -1)):.0f} seconds on two quiet cores, "
                              f"{max(1, round(slow / 60)):.0f} minutes on two busy ones{m[2]}", text)


if __name__ == "__main__":
    raise SystemExit(main())
