"""Which pairs of claims exclude each other: proved by arithmetic, or a witness in which both hold.

A claim that holds has the means of its measures on the claimed side: linear inequalities. With the bookkeeping that any
reading keeps they have a solution or none; none proves the pair impossible, and a smallest set of rows that has none is
the reason. A witness is a study of numbers, seed by seed, that keeps to the bookkeeping of a whole reading too and is
judged by the rules of the claims themselves. Where there is neither, nothing is decided.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from attnlab.audit.bookkeeping import BLOCK, Row, bounds, constructed, necessary, quantity
from attnlab.claims import rules as decide
from attnlab.claims.files import Claims
from attnlab.claims.findings import WORST_FIRST
from attnlab.claims.judge import compared
from attnlab.claims.parts import PAIRED, Part
from attnlab.stats.levels import level_contrast, level_null

IMPOSSIBLE, POSSIBLE, UNDECIDED = "impossible", "possible", "not decidable"
ALL, SEEN = "all", "hold in "
SEEDS = 20
ACTIVATIONS = (364, 443, 600)  # an episode, of Table 5's robots, and more
ROOM = 1e-6  # a solution with less is none that a rule could tell
DRAWS = 2000


class Pair(NamedTuple):
    """``reason``: the rows that exclude each other, or where both hold."""
    one: str
    other: str
    outcome: str
    reason: str


def pairs(claims: Claims, seen: Mapping[str, Sequence[str]] | None = None) -> list[Pair]:
    """Every pair, then all claims at once (``ALL``). ``seen``: study -> claims that hold in it."""
    found = [Pair(*keys, *prove(claims, keys, seen or {})) for keys in itertools.combinations(claims.claims, 2)]
    return [*found, Pair(ALL, "", *prove(claims, list(claims.claims), seen or {}))]


def prove(claims: Claims, keys: Sequence[str], seen: Mapping[str, Sequence[str]]) -> tuple[str, str]:
    """(outcome, reason) of claims that are to hold together."""
    rows = [row for key in keys for row in claimed(claims, key)]
    always = [row for role in claims.roles for row in necessary(role)] + list(_bounded(claims, keys))
    if _room(rows, always) is None:
        return IMPOSSIBLE, "; ".join(dict.fromkeys(
            (f"{row.claim}: " if row.claim else "") + row.why for row in _conflict(rows, always)))
    study = next((name for name, there in seen.items() if set(keys) <= set(there)), None)
    if study is not None:
        return POSSIBLE, f"{SEEN}{study}"
    for acts in itertools.product(ACTIVATIONS, repeat=2):
        more = [row for role in claims.roles for row in constructed(role, acts[role != "treatment"])]
        found = _room(rows, [*always, *more])
        if found is not None and all(holds(claims, key, found) for key in keys):
            return POSSIBLE, f"constructed: {_told(claims, keys, found)}"
    return UNDECIDED, "nothing excludes them, and in no study that was constructed do they hold"


def claimed(claims: Claims, key: str) -> list[Row]:
    """What the means must be if a claim holds; ``room`` is the variable that says by how much."""
    found = []
    for part in (part for part in claims.claims[key].parts if part.counts):
        ours, theirs = (f"{quantity(part)} of {role}" for role in (part.role, part.against))
        terms = {ours: 1.0, theirs: -1.0} if part.test in PAIRED else {ours: 1.0}
        said = f"{quantity(part)} of {claims.roles[part.role].label}" + (
            f" less that of {claims.roles[part.against].label}" if part.test in PAIRED else "")
        low, high = _sides(part)
        scale = 4.0 * BLOCK if part.test == "order" else part.known or abs(part.number or 0.0) or part.margin or 1.0
        if low is not None:
            found.append(Row({**{k: -f for k, f in terms.items()}, "room": scale / 2}, -low, f"{said} >= {low:g}", key))
        if high is not None:
            found.append(Row({**terms, "room": scale / 2}, high, f"{said} <= {high:g}", key))
    return found


def _sides(part: Part) -> tuple[float | None, float | None]:
    """Between what a mean is, if the comparison holds."""
    if part.test == "permutation":
        return 0.0, None
    if part.test == "not_lower":
        return -(part.margin or 0.0), None
    if part.direction == "about":
        number, known = part.number or 0.0, part.known or 0.0
        return number - known, number + known
    return (part.reference, None) if part.direction in ("higher", "at_least") else (None, part.reference)


def _bounded(claims: Claims, keys: Iterable[str]) -> Iterable[Row]:
    for key in keys:
        for part, measure in zip(claims.claims[key].parts, claims.measures[key], strict=True):
            low, high = bounds(measure)
            for role in part.roles:
                name = f"{quantity(part)} of {role}"
                if np.isfinite(low):
                    yield Row({name: -1}, -low, f"{quantity(part)} is {low:g} or more")
                if np.isfinite(high):
                    yield Row({name: 1}, high, f"{quantity(part)} is {high:g} or less")


def _room(rows: Sequence[Row], always: Sequence[Row]) -> dict[str, float] | None:
    """A solution that keeps from the claims' edges as far as may be; None if there is none that leaves any room."""
    from scipy.optimize import linprog
    every = [*rows, *always]
    names = list(dict.fromkeys(["room", *(name for row in every for name in row.terms)]))
    place = {name: i for i, name in enumerate(names)}
    a = np.zeros((len(every), len(names)))
    for i, row in enumerate(every):
        for name, factor in row.terms.items():
            a[i, place[name]] = factor
    cost = np.zeros(len(names))
    cost[0] = -1.0
    done = linprog(cost, A_ub=a, b_ub=[row.most for row in every], bounds=[(0, 1), *[(None, None)] * (len(names) - 1)])
    if done.status != 0 or done.x[0] <= ROOM:
        return None
    return dict(zip(names, map(float, done.x), strict=True))


def _conflict(rows: Sequence[Row], always: Sequence[Row]) -> list[Row]:
    """Rows that have no solution together, and would if any were left out."""
    kept = [*rows, *always]
    for row in list(kept):
        fewer = [other for other in kept if other is not row]
        if _room(fewer, []) is None:
            kept = fewer
    return kept


def holds(claims: Claims, key: str, means: Mapping[str, float]) -> bool:
    """Does the claim hold in a study of ``SEEDS`` seeds around these means, by its own rules?"""
    parts = [part for part in claims.claims[key].parts if part.counts]
    codes, p = [], []
    for part in parts:
        if part.test == "permutation":
            chance = _levels_p(claims.rules.seed)
            codes.append(np.array([decide.DIRECTION if chance < 1 - claims.rules.confidence else decide.NOT]))
            p.append(np.array([chance]))
            continue
        x = np.array(list(compared(part, {role: _seeds(part, role, means) for role in part.roles}).values()))
        d = decide.interval(part, x, claims.rules)
        codes.append(decide.grade(part, d))
        p.append(np.atleast_1d(d.p))
    return WORST_FIRST[int(decide.together(parts, codes, p, SEEDS, claims.rules)[0][0])].holds


def _seeds(part: Part, role: str, means: Mapping[str, float]) -> dict[int, float]:
    """Seed -> value, so near its mean that every seed keeps to what the mean keeps to; times are ends of blocks."""
    value = means[f"{quantity(part)} of {role}"]
    if part.unit == "episodes" and part.test in ("median", "order"):
        return dict.fromkeys(range(SEEDS), float(BLOCK * round(value / BLOCK)))
    near = 1e-9 * max(1.0, abs(value)) * (role == "treatment")
    return {seed: value + near * (-1) ** seed for seed in range(SEEDS)}


def _levels_p(seed: int) -> float:
    """p of the permutation test for robots that all take 4 with a new percept and 1 with a known one, as C11 has it."""
    tables = np.tile(np.array([4, 1])[None, :, None], (SEEDS, 1, 6))
    null = level_null(tables, DRAWS, seed)
    return float((np.sum(null >= level_contrast(tables).mean() - 1e-9) + 1) / (null.size + 1))


def _told(claims: Claims, keys: Sequence[str], means: Mapping[str, float]) -> str:
    """The numbers of a witness, of the measures of these claims."""
    found = {}
    for part in (part for key in keys for part in claims.claims[key].parts if part.counts):
        values = {role: _seeds(part, role, means) for role in part.roles}
        found[quantity(part)] = " ".join(f"{claims.roles[role].label} {of[0]:.4g}" for role, of in values.items())
    return ", ".join(f"{name} {numbers}" for name, numbers in found.items())
