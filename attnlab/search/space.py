"""All combinations of how the paper's open points may be read, and how one is bred from two."""

from __future__ import annotations

import math
import string
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from attnlab.errors import ConfigError
from attnlab.launch.multiverse import DEFAULT, Factors, balanced, load_factors, overrides_of
from attnlab.reading import Reading
from attnlab.settings import build

Row = tuple[int, ...]  # a reading: for each point the number of its level, 0 as ``inferred`` has it
DIGITS = string.digits + string.ascii_lowercase
TRIES = 1000  # at a reading that is new and may be


@dataclass(frozen=True)
class Space:
    """``points``: point -> level -> settings."""
    points: Factors

    @classmethod
    def of(cls, name: str = DEFAULT) -> Space:
        """That of a file of open points, by its name or path. Raises ConfigError."""
        return cls(load_factors(name))

    @cached_property
    def levels(self) -> list[int]:
        """How many levels each point has."""
        return [len(of) for of in self.points.values()]

    @property
    def size(self) -> int:
        """How many combinations there are."""
        return math.prod(self.levels)

    def settings(self, row: Row) -> dict[str, Any]:
        """A reading as settings of a run."""
        return overrides_of(self.points, self.told(row))

    def told(self, row: Row) -> dict[str, str]:
        """A reading in words: point -> level."""
        return {point: list(of)[level] for (point, of), level in zip(self.points.items(), row, strict=True)}

    def may_be(self, row: Row) -> bool:
        """Is it a reading? Levels of two points may contradict each other."""
        try:
            build(Reading, {name.removeprefix("reading."): value for name, value in self.settings(row).items()
                            if name.startswith("reading.")}, "reading")
        except ConfigError:
            return False
        return True

    def first(self, count: int, seed: int) -> list[Row]:
        """``count`` different readings whose levels, and pairs of levels, are as even as found, in any order."""
        table = balanced(self.levels, max(2, min(count, self.size)), seed)
        found = {row: None for row in map(_row, table) if self.may_be(row)}
        rng = np.random.default_rng([seed, 1])
        for _ in range(TRIES):
            if len(found) >= min(count, self.size):
                break
            row = _row(rng.integers(0, self.levels))
            if self.may_be(row):
                found.setdefault(row)
        return list(found)[:count]

    def child(self, one: Row, other: Row, rng: np.random.Generator) -> Row:
        """Each level from one of two parents, and about one of them changed."""
        row = [levels[rng.integers(2)] for levels in zip(one, other, strict=True)]
        for place in np.flatnonzero(rng.random(len(row)) < 1 / len(row)):
            row[place] = int((row[place] + rng.integers(1, self.levels[place])) % self.levels[place])
        return tuple(row)

    def bred(self, parents: Sequence[Row], count: int, there: Sequence[Row], rng: np.random.Generator) -> list[Row]:
        """``count`` readings that are none of ``there``, from parents in order of their worth: of two drawn, the better
        is taken. Fewer if the space has no more."""
        known, found = set(there), list[Row]()
        for _ in range(TRIES + 10 * count):
            if len(found) == count or not parents:
                break
            one, other = (parents[min(rng.integers(0, len(parents), 2))] for _ in range(2))
            row = self.child(one, other, rng)
            if row not in known and self.may_be(row):
                known.add(row)
                found.append(row)
        return found


def _row(levels: np.ndarray) -> Row:
    return tuple(int(level) for level in levels)


def code(row: Row) -> str:
    """A reading as digits, one a point in the order of the file; a level above 9 as a letter."""
    return "".join(DIGITS[level] for level in row)


def row_of(text: str) -> Row:
    """The reading that :func:`code` wrote."""
    return tuple(map(DIGITS.index, text))
