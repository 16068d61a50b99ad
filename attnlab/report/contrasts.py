"""What is compared in every reading of a multiverse: each signed comparison of a claims file, against every control."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from attnlab.claims.files import Claims
from attnlab.claims.judge import Cache
from attnlab.claims.parts import PAIRED
from attnlab.claims.roles import Combinations
from attnlab.measures.base import CannotMeasure, Measure
from attnlab.results.conditions import Conditions

Floats = npt.NDArray[np.float64]


class Contrast(NamedTuple):
    """A measure of two roles, signed so that above 0 is what the ``claim`` says: ``sign`` is -1 where it says lower.
    ``node``: the measure with its settings; ``order``: is only the sign of a seed's difference taken?"""
    claim: str
    part: int
    measure: str
    role: str
    against: str
    who: str
    whom: str
    sign: float
    node: str
    order: bool

    @property
    def title(self) -> str:
        return f"{self.measure}, {self.who} against {self.whom}"

    def told(self, side: float) -> str:
        """What it means that the effect is on this side."""
        if not side:
            return "neither higher nor lower"
        word = ("later", "earlier") if self.order else ("higher", "lower")
        return word[0] if side * self.sign > 0 else word[1]


def contrasts(claims: Claims) -> list[Contrast]:
    """Every paired comparison that has a side, each once, those that the claims make first; then the same against all
    other roles."""
    found: dict[tuple[Any, ...], Contrast] = {}
    for more in (False, True):
        for key, claim in claims.claims.items():
            for i, part in enumerate(claim.parts):
                if part.test not in PAIRED or (part.direction == "about" and part.test != "not_lower"):
                    continue
                others = [role for role in claims.roles if role not in (part.role, part.against)]
                sign = -1.0 if part.direction in ("lower", "at_most") else 1.0
                node, order = repr(part.node), part.test == "order"
                for against in others if more else [part.against]:
                    of = tuple(sorted(part.node.items(), key=str))
                    found.setdefault((repr(of), part.role, against, order), Contrast(
                        key, i, in_words(part.node), part.role, against, claims.roles[part.role].label,
                        claims.roles[against].label, sign, node, order))
    return list(found.values())


def in_words(node: Mapping[str, Any]) -> str:
    """A measure with its settings, e.g. 'reward (eat, extrinsic)'."""
    settings = dict(node)
    name = str(settings.pop("name"))
    said = str(settings.pop("column", name) if name == "episode" else name).replace("_", " ")
    more = []
    for key, value in settings.items():
        if key == "phase":
            more.append({"train": "in training", "validation": "in validation"}.get(str(value), str(value)))
        elif key == "episodes" and isinstance(value, list):
            more.append(f"episodes {value[0]} to {value[1] - 1}")
        elif value is True:
            more.append(key.replace("_", " "))
        elif value is not False and not isinstance(value, list):
            more.append(str(value) if key in ("behaviour", "level") else f"{key.replace('_', ' ')} {value}")
    return f"{said} ({', '.join(more)})" if more else said


def differences(claims: Claims, conditions: Conditions, combinations: Combinations, measured: Mapping[str, Cache],
                wanted: list[Contrast]) -> Floats:
    """(readings, contrasts, seeds) over all seeds that any reading has, signed as claimed; nan where there is none.
    ``measured``: of each reading what the verdicts took; a reading of which they took nothing has no values."""
    rows = []
    for name, settings in combinations.items():
        taken = _Taken(claims, conditions, settings, dict(measured[name]))
        rows.append([taken.differences(contrast) if measured[name] else {} for contrast in wanted])
    seeds = sorted({seed for row in rows for of in row for seed in of})
    found = np.full((len(rows), len(wanted), len(seeds)), np.nan)
    place = {seed: i for i, seed in enumerate(seeds)}
    for r, row in enumerate(rows):
        for c, of in enumerate(row):
            for seed, value in of.items():
                found[r, c, place[seed]] = wanted[c].sign * value
    return np.where(np.isfinite(found), found, np.nan)


class _Taken:
    """Values of the roles of one reading: those that are there, and others when they are asked for."""

    def __init__(self, claims: Claims, conditions: Conditions, settings: Mapping[str, str], cache: Cache):
        self.claims, self.conditions, self.settings, self.cache = claims, conditions, settings, cache

    def differences(self, of: Contrast) -> dict[int, float]:
        """Seed -> value of the role less that of the other, or the sign of it in %."""
        measure = self.claims.measures[of.claim][of.part]
        ours, theirs = self._values(of.role, of.node, measure), self._values(of.against, of.node, measure)
        both = sorted(seed for seed in set(ours) & set(theirs) if ours[seed] == ours[seed]
                      and theirs[seed] == theirs[seed])
        if of.order:
            return {seed: 100.0 * float((ours[seed] > theirs[seed]) - (ours[seed] < theirs[seed])) for seed in both}
        return {seed: ours[seed] - theirs[seed] for seed in both}

    def _values(self, role: str, node: str, measure: Measure) -> Mapping[int, float]:
        if (role, node) not in self.cache:
            runs, _ = self.conditions.matching(self.claims.roles[role].where, self.settings)
            try:
                self.cache[role, node] = measure.of(runs) if runs.runs else {}
            except CannotMeasure as cannot:
                self.cache[role, node] = cannot
        taken = self.cache[role, node]
        return {} if isinstance(taken, CannotMeasure) else taken
