"""What the rows say: means with intervals, equal looks, the front, ranks at every price."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import sqrt
from typing import Any

from attnlab.arena.board import Row

PRICES = (0.0, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0, 1.5, 2.0)
FIXED = {"always_on": 1, "fixed_4": 4, "fixed_8": 8, "fixed_12": 12}
LEAST = 6  # units, below which nothing is called clear
Point = tuple[float, float]  # (looks, harm)


@dataclass(frozen=True)
class Standing:
    """A way in a place. ``looks``, ``harm``: (mean, half width of the 95 % interval over units); ``saved``: harm of a
    fixed clock of equal looks, less the way's own, paired by unit, the same form; None for fixed clocks themselves."""
    way: str
    between: bool
    units: int
    looks: Point
    harm: Point
    saved: Point | None
    front: bool
    detail: Mapping[str, float]

    @property
    def verdict(self) -> str:
        """Against fixed clocks of equal looks, in a word."""
        if self.saved is None or self.units < LEAST:
            return ""
        value, half = self.saved
        return "better" if value - half > 0 else "worse" if value + half < 0 else "not clear"


def interval(values: Sequence[float]) -> Point:
    """(mean, half width of its 95 % t interval); no width for fewer than two."""
    from scipy.stats import t
    n = len(values)
    mean = sum(values) / n
    if n < 2:
        return mean, 0.0
    spread = sqrt(sum((v - mean) ** 2 for v in values) / (n - 1))
    return mean, float(t.ppf(0.975, n - 1)) * spread / sqrt(n)


def at_equal_looks(curve: Sequence[Point], looks: float) -> float | None:
    """Harm of fixed clocks that look this often, between the two nearest of them; None outside of what they span."""
    points = sorted(curve)
    if not points or not points[0][0] <= looks <= points[-1][0]:
        return None
    for (a, harm_a), (b, harm_b) in pairwise(points):
        if looks <= b:
            return harm_b if b == a else harm_a + (harm_b - harm_a) * (looks - a) / (b - a)
    return points[-1][1]


def standings(rows: Sequence[Row], curves: Mapping[str, Sequence[Point]] | None = None) -> list[Standing]:
    """The ways in one place, by harm. ``curves``: fixed clocks by unit, for logs; in worlds the fixed ways are they."""
    of_way: dict[str, dict[str, Row]] = {}
    for row in rows:
        of_way.setdefault(row.way, {})[row.unit] = row
    if curves is None:
        units = {row.unit for row in rows}
        curves = {unit: [(mine[unit].looks, mine[unit].harm) for way, mine in of_way.items()
                         if way in FIXED and unit in mine] for unit in units}
    means = {way: (interval([r.looks for r in mine.values()]), interval([r.harm for r in mine.values()]))
             for way, mine in of_way.items()}
    able = {way: means[way] for way in means if not way.startswith("(")}
    found = []
    for way, mine in of_way.items():
        looks, harm = means[way]
        pairs = [(at_equal_looks(curves.get(unit, ()), row.looks), row.harm) for unit, row in mine.items()]
        differences = [fixed - own for fixed, own in pairs if fixed is not None]
        saved = interval(differences) if len(differences) == len(pairs) and way not in FIXED else None
        front = way in able and not any(a[0] <= looks[0] and b[0] <= harm[0] and (a[0], b[0]) != (looks[0], harm[0])
                                        for a, b in able.values())
        keys = next(iter(mine.values())).detail
        detail = {key: sum(row.detail.get(key, 0.0) for row in mine.values()) / len(mine) for key in keys}
        found.append(Standing(way, any(row.between for row in mine.values()), len(mine), looks, harm, saved, front,
                              detail))
    return sorted(found, key=lambda s: (s.harm[0], s.way))


def score(standing: Standing, price: float) -> float:
    """Harm plus price times looks."""
    return standing.harm[0] + price * standing.looks[0]


def ranks(found: Sequence[Standing], prices: Sequence[float] = PRICES) -> dict[str, list[int]]:
    """Place of each way (1 the best) at each price; who knows the future is left out."""
    able = [s for s in found if not s.way.startswith("(")]
    places: dict[str, list[int]] = {s.way: [] for s in able}
    for price in prices:
        for place, s in enumerate(sorted(able, key=lambda s: (score(s, price), s.way)), start=1):
            places[s.way].append(place)
    return places


def words(place: str, found: Sequence[Standing], price: float) -> str:
    """What is sure in one place, in plain words."""
    able = [s for s in found if not s.way.startswith("(")]
    best = min(able, key=lambda s: (score(s, price), s.way))
    compared = [s for s in able if s.verdict]
    better = [s.way for s in compared if s.verdict == "better"]
    worse = [s.way for s in compared if s.verdict == "worse"]
    text = (f"{place}: at a price of {price:g} a look the best score is {best.way}'s, with {100 * best.looks[0]:.0f} "
            f"looks in 100 cycles and a harm of {100 * best.harm[0]:.1f} %. ")
    if not compared:
        return text + "Too few seeds or blocks to say who beats a fixed clock."
    return text + (f"Of {len(compared)} ways that can be held against fixed clocks of equal looks, {len(better)} are "
                   f"clearly better{named(better)} and {len(worse)} clearly worse{named(worse)}; each comparison on "
                   "its own, at 95 %.")


def named(ways: Sequence[str]) -> str:
    """Their names in brackets; nothing for none."""
    return f" ({', '.join(ways)})" if ways else ""


def as_data(found: Sequence[Standing]) -> list[dict[str, Any]]:
    """Plain data for the page."""
    return [{"way": s.way, "between": s.between, "units": s.units, "looks": s.looks, "harm": s.harm, "saved": s.saved,
             "verdict": s.verdict, "front": s.front, "detail": dict(s.detail)} for s in found]
