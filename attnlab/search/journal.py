"""What a search has done so far: a file that is written after every rung, so that it goes on where it was stopped."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from attnlab.errors import ConfigError
from attnlab.search.rungs import UNSOUND, Rung, Step
from attnlab.search.space import Row, code, row_of
from attnlab.tables.files import read_json, write_json

FILE = "search.json"


class Journal:
    """``asked``: what the search was asked for, which must not change under way. ``steps``: the rungs done; ``claims``:
    of each rung, reading by reading, the score of each claim; ``why``: of each rung, why readings are not sound."""

    def __init__(self, folder: Path, asked: Mapping[str, Any]):
        self.path, self.asked = folder / FILE, dict(asked)
        self.steps: list[Step] = []
        self.claims: list[dict[Row, dict[str, float]]] = []
        self.why: list[dict[Row, str]] = []
        self.begun: Rung | None = None  # that is under way
        self.clock: dict[str, float] = {}
        if self.path.exists():
            self._read()

    def _read(self) -> None:
        """Raises ConfigError if another search was asked for here."""
        there = read_json(self.path)
        if there is None or not isinstance(there.get("asked"), dict):
            raise ConfigError(str(self.path), "cannot be read", "Another folder: --out FOLDER")
        for name, value in self.asked.items():
            if there["asked"].get(name) != value:
                raise ConfigError(name, f"is {value}, and {self.path} is of a search with "
                                  f"{there['asked'].get(name)}", "Go on with that one, or choose another --out")
        for node in there["rungs"]:
            rows = {row_of(of["row"]): of for of in node["readings"]}
            self.steps.append(Step(Rung(*node["rung"]), {row: UNSOUND if of["score"] is None else of["score"]
                                                         for row, of in rows.items()}))
            self.claims.append({row: of["claims"] for row, of in rows.items()})
            self.why.append({row: of["why"] for row, of in rows.items() if of["why"]})
        self.begun = Rung(*there["begun"]) if there["begun"] else None
        self.clock = there["clock"]

    def done(self, step: Step, claims: dict[Row, dict[str, float]], why: dict[Row, str]) -> None:
        """A rung is over."""
        self.steps.append(step)
        self.claims.append(claims)
        self.why.append(why)
        self.begun = None

    def write(self) -> None:
        """All of it, whole."""
        rungs = [{"rung": list(step.rung), "readings": [
            {"row": code(row), "score": None if score == UNSOUND else score, "claims": claims.get(row, {}),
             "why": why.get(row, "")} for row, score in step.scores.items()]}
            for step, claims, why in zip(self.steps, self.claims, self.why, strict=True)]
        self.path.parent.mkdir(parents=True, exist_ok=True)
        write_json(self.path, {"asked": self.asked, "clock": self.clock,
                               "begun": list(self.begun) if self.begun else None, "rungs": rungs})

    def seeds(self, rung: Rung, first: int) -> Sequence[int]:
        """Of a rung that comes after those done: fresh ones, so that nobody is carried on by luck."""
        start = first + sum(step.rung.seeds for step in self.steps)
        return range(start, start + rung.seeds)
