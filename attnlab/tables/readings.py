"""Which readings of a multiverse are sound, as it was decided once: ``readings.json`` and, to be read by people,
``readings.csv`` in the study's folder."""

from __future__ import annotations

import dataclasses
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from attnlab.tables.csvs import csv_bytes
from attnlab.tables.files import read_json, write_bytes, write_json

FILE, TABLE = "readings.json", "readings.csv"


@dataclass
class Tried:
    """A reading whose pilots were run. ``survival``: mean share (%) of an episode that its robots lived; ``meals``,
    ``drinks``: of all its pilots; ``reason``: why it is not sound, or ""; ``taken``: is it part of the study?"""
    reading: str
    levels: dict[str, str]
    survival: float
    meals: int
    drinks: int
    reason: str = ""
    taken: bool = False


@dataclass
class Decided:
    """What was decided. ``mark``: hash of the pilots' keys and the rule; ``rule``: the rule, in words; ``candidates``:
    how many there were; ``counts``: of the taken ones, factor -> level -> readings; ``confounded``: the two factors of
    which one tells most of the other, and Cramer's V; ``uneven``: readings by which the number of a pair of levels is
    off its even share at most."""
    mark: str
    rule: str
    candidates: int
    tried: list[Tried]
    counts: dict[str, dict[str, int]] = field(default_factory=dict)
    confounded: tuple[str, str, float] = ("", "", 0.0)
    uneven: float = 0.0

    @property
    def taken(self) -> list[str]:
        """Names of the readings that make the study."""
        return [tried.reading for tried in self.tried if tried.taken]

    @property
    def sound(self) -> int:
        """How many of those tried are sound."""
        return len([tried for tried in self.tried if not tried.reason])

    def casualties(self) -> dict[str, int]:
        """Why readings are not sound -> how many, most first; one with two reasons counts for both."""
        reasons = Counter("survives too little" if why.startswith("survives ") else why for of in self.tried
                          for why in of.reason.split("; ") if why)
        return dict(reasons.most_common())


def write_decided(folder: Path, decided: Decided) -> None:
    """Both files; the one that counts last."""
    folder.mkdir(parents=True, exist_ok=True)
    heads = ["reading", "taken", "reason", "survival_pct", "meals", "drinks", *decided.tried[0].levels]
    rows = list[list[object]]()
    for tried in decided.tried:
        reason = tried.reason or ("" if tried.taken else "sound, and not needed")
        rows.append([tried.reading, "yes" if tried.taken else "no", reason, f"{tried.survival:.2f}", tried.meals,
                     tried.drinks, *tried.levels.values()])
    write_bytes(folder / TABLE, csv_bytes(heads, rows))
    write_json(folder / FILE, dataclasses.asdict(decided))


def read_decided(folder: Path) -> Decided | None:
    """What was decided for this study, or None."""
    content: dict[str, Any] | None = read_json(folder / FILE)
    if content is None:
        return None
    try:
        content["tried"] = [Tried(**node) for node in content["tried"]]
        one, other, v = content["confounded"]
        return Decided(**{**content, "confounded": (one, other, v)})
    except (TypeError, KeyError, ValueError):
        return None
