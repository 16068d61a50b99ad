"""What the page says of deep networks, from the tables of their study."""

from __future__ import annotations

from pathlib import Path

import found
from studies import DEEP, NETWORKS, RIVALS

from attnlab.learners.sb3 import Sb3


def text(folder: Path) -> str:
    """How each network survives in validation beside each rival, and how often it looks; whatever came out."""
    if not found.made(folder, DEEP):
        return found.MISSING.format(DEEP)
    said = []
    for network in NETWORKS:
        than: dict[str, list[str]] = {}
        for rival in RIVALS:
            if row := found.contrast(folder, DEEP, found.VALID, network, rival):
                than.setdefault(found.side(row), []).append(f"{rival} ({found.against(row)})")
        if than:
            sides = "; ".join(f"{side} than {', '.join(rivals)}" for side, rivals in than.items())
            said.append(f"{network} looks {looks(folder, network)} times an episode and survives in validation "
                        f"{sides}.")
    if not said:
        return "The networks were left out."
    others = ", ".join(f"{rival} {looks(folder, rival)}" for rival in RIVALS)
    return " ".join([f"The networks of a robot are trained on {Sb3.Params().steps:,} decisions before its run.", *said,
                     f"Looks of the others: {others}."])


def looks(folder: Path, condition: str) -> int:
    """Activations of all behaviours in an episode."""
    return sum(map(int, found.table_row(folder, DEEP, condition)["activations"].split()))
