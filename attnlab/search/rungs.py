"""Successive halving with breeding: the ladder, whatever it is that scores a reading."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from attnlab.errors import ConfigError
from attnlab.search.space import Row, Space

KEPT = 0.5  # share of a rung's places that go to the best of the rung before; the others are bred from them
PARENTS = 0.25  # share of a rung that is bred from
UNSOUND = -math.inf
MOST = {"readings": 100_000, "seeds": 100, "episodes": 100_000}


class Rung(NamedTuple):
    """``readings`` tried with ``seeds`` each, over ``episodes`` of training."""
    readings: int
    seeds: int
    episodes: int

    def __str__(self) -> str:
        return ":".join(map(str, self))


class Step(NamedTuple):
    """A rung that was done: its readings, and what each is worth (``UNSOUND`` for one that cannot be meant)."""
    rung: Rung
    scores: dict[Row, float]

    @property
    def best(self) -> list[Row]:
        """Sound readings, the best first; of equals the one that came first."""
        return sorted((row for row, score in self.scores.items() if score > UNSOUND), key=lambda row: -self.scores[row])


Score = Callable[[int, Rung, Sequence[Row]], Mapping[Row, float]]
Ladder = Callable[[int], "Rung | None"]  # place -> the rung there, None above the last


def parse(text: str) -> list[Rung]:
    """``400:2:120,100:4:250`` as rungs. Raises ConfigError."""
    found = []
    for word in text.split(","):
        numbers = word.strip().split(":")
        if len(numbers) != 3 or not all(number.isdecimal() for number in numbers):
            raise ConfigError("--rungs", f"'{word}' is no rung", "As in 400:2:120,100:4:250"
                              ": readings, seeds, training episodes")
        rung = Rung(*map(int, numbers))
        for (name, most), low, value in zip(MOST.items(), (2, 1, 5), rung, strict=True):
            if not low <= value <= most:
                raise ConfigError("--rungs", f"'{word}' has {value} {name}, must be from {low} to {most}")
        found.append(rung)
    return found


def climb(space: Space, ladder: Ladder, seed: int, score: Score, done: Sequence[Step] = ()) -> Iterator[Step]:
    """The rungs, one after the other, those that were ``done`` before first. What a rung tries follows from ``seed``
    and from the scores before it alone. Raises ConfigError if nothing sound is left."""
    steps = list(done)
    yield from steps
    while rung := ladder(place := len(steps)):
        rows = proposed(space, rung, steps[-1], np.random.default_rng([seed, place])) if steps else \
            space.first(rung.readings, seed)
        found = score(place, rung, rows)
        steps.append(Step(rung, {row: found[row] for row in rows}))
        if not steps[-1].best:
            raise ConfigError("--rungs", f"none of the {len(rows)} readings of rung {place + 1} is sound",
                              "More readings, or longer lives")
        yield steps[-1]


def proposed(space: Space, rung: Rung, before: Step, rng: np.random.Generator) -> list[Row]:
    """What a rung tries: the best of the one before, and what is bred from them."""
    best = before.best
    kept = best[:math.ceil(KEPT * rung.readings)]
    parents = best[:max(2, math.ceil(PARENTS * len(before.scores)))]
    bred = space.bred(parents, rung.readings - len(kept), list(before.scores), rng)
    return [*kept, *bred, *best[len(kept):]][:rung.readings]


def fixed(rungs: Sequence[Rung]) -> Ladder:
    """A ladder of these rungs."""
    return lambda place: rungs[place] if place < len(rungs) else None
