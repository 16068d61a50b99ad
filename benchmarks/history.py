"""Results over commits: ratios within one result each, for neither machines nor hours can be compared otherwise."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from benchmarks.run import LIMIT

ENTRIES = ("compiled, loop alone", "compiled, whole run", "python, whole run", "pybullet, whole run", "Enki")
BEFORE = {"fused kernel, same sensing": LIMIT, "attnlab planar, whole loop": "python, whole run",
          "attnlab pybullet, whole loop": "pybullet, whole run"}  # what they were called in results until 2026-11-22


def results(folder: Path) -> list[dict[str, Any]]:
    """All stored results, the oldest first, each with the name of its ``file``; entries by their names of today."""
    found = []
    for path in sorted(folder.glob("[0-9]*.json")):
        one = json.loads(path.read_text())
        one["contest"] = {BEFORE.get(name, name): speed for name, speed in one["contest"].items()}
        found.append({**one, "file": path.name})
    return found


def share(found: dict[str, Any], name: str) -> float | None:
    """The median of an entry over that of the limit, in the same result; None where it was not measured."""
    contest = found["contest"]
    return contest[name]["median"] / contest[LIMIT]["median"] if name in contest else None


def table(every: list[dict[str, Any]]) -> list[str]:
    """A row a result, as Markdown."""
    lines = ["| date | commit | code | Python | machine | load | " + " | ".join(ENTRIES) + " |",
             "|---|---|---|---|---|---:|" + "---:|" * len(ENTRIES)]
    for one in every:
        machine, code = one["machine"], one["code"]
        shares = [share(one, name) for name in ENTRIES]
        cells = [one["date"][:16], code["commit"][:7] + " and changes" * code["dirty"], code["hash"][:8] or "-",
                 one["versions"]["python"], f"{machine['cpu']}, {machine['cores']} cores", f"{machine['load']:.1f}",
                 *("-" if value is None else f"{value:.4f}" for value in shares)]
        lines.append(f"| {' | '.join(cells)} |")
    return lines
