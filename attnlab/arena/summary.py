"""What the rows say: means with intervals, equal looks, the front, ranks at every price."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, pairwise
from typing import Any

import numpy as np

from attnlab.arena.board import Row
from attnlab.stats import holm, t_interval
from attnlab.stats.seeds import resampled

PRICES = (0.0, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0, 1.5, 2.0)
FIXED = ("always_on", "fixed_1", "fixed_4", "fixed_8", "fixed_12")
STEADY = "(steady "  # how clocks of any mean period are called: held against, no competitors
LEAST = 6  # units, below which nothing is called clear
SURE = 0.05  # the chance of calling any way of a place clear that is not
RESAMPLES = 1000
Point = tuple[float, float]  # (looks, harm)
Ends = tuple[float, float, float]  # mean, and the ends of its 95 % interval over units


@dataclass(frozen=True)
class Standing:
    """A way in a place. ``saved``: harm of a fixed clock of equal looks, less the way's own, paired by unit; None for
    fixed clocks themselves and where no fixed clock looks as often. ``p``: of "it saves nothing" by the paired t test;
    ``holm``: the same, corrected for all ways of the place. ``front``: is its mean on the Pareto front; ``often``: in
    what share of resampled sets of units it is."""
    way: str
    between: bool
    units: int
    looks: Ends
    harm: Ends
    saved: Ends | None
    p: float | None
    front: bool
    often: float
    detail: Mapping[str, float]
    holm: float | None = None

    @property
    def competes(self) -> bool:
        """Not a clock that is only held against, nor who knows the future."""
        return not self.way.startswith("(")

    @property
    def verdict(self) -> str:
        """Against fixed clocks of equal looks, in a word."""
        if self.saved is None or self.units < LEAST:
            return ""
        if self.holm is None or not self.holm < SURE:
            return "not clear"
        return "better" if self.saved[0] > 0 else "worse"


def interval(values: Sequence[float]) -> Ends:
    """Mean and its 95 % t interval; no width for fewer than two."""
    value, low, high, _ = t_interval(values)
    return (float(value), float(low), float(high)) if len(values) > 1 else (float(value),) * 3


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
    """The ways in one place, by harm. ``curves``: fixed clocks by unit, for logs; in worlds the fixed and steady ways
    are they."""
    of_way: dict[str, dict[str, Row]] = {}
    for row in rows:
        of_way.setdefault(row.way, {})[row.unit] = row
    if curves is None:
        curves = {unit: [(mine[unit].looks, mine[unit].harm) for way, mine in of_way.items()
                         if (way in FIXED or way.startswith(STEADY)) and unit in mine]
                  for unit in {row.unit for row in rows}}
    often, found = on_front(of_way), []
    means = {way: (float(np.mean([r.looks for r in of_way[way].values()])),
                   float(np.mean([r.harm for r in of_way[way].values()]))) for way in often}
    for way, mine in of_way.items():
        pairs = [(at_equal_looks(curves.get(unit, ()), row.looks), row.harm) for unit, row in mine.items()]
        differences = [fixed - own for fixed, own in pairs if fixed is not None]
        compared = len(differences) == len(pairs) and way not in FIXED and way in often
        front = way in means and not any(beats(other, means[way]) for other in means.values())
        keys = next(iter(mine.values())).detail
        detail = {key: float(np.mean([row.detail.get(key, 0.0) for row in mine.values()])) for key in keys}
        found.append(Standing(way, any(row.between for row in mine.values()), len(mine),
                              interval([row.looks for row in mine.values()]),
                              interval([row.harm for row in mine.values()]),
                              interval(differences) if compared else None,
                              float(t_interval(differences).p) if compared and len(pairs) > 1 else None,
                              front, often.get(way, 0.0), detail))
    family = {s.way: s.p for s in found if s.p is not None}
    corrected = dict(zip(family, holm(list(family.values())).tolist(), strict=True)) if family else {}
    return sorted((replace(s, holm=corrected.get(s.way)) for s in found), key=lambda s: (s.harm[0], s.way))


def beats(one: Point, other: Point) -> bool:
    """No more looks and no more harm, and less of one."""
    return one[0] <= other[0] and one[1] <= other[1] and one != other


def on_front(of_way: Mapping[str, Mapping[str, Row]]) -> dict[str, float]:
    """Of each way that competes: the share of resampled sets of units in which no other has fewer looks and less harm.
    A way that is not known in a unit does without it."""
    ways = [way for way in of_way if not way.startswith("(")]
    units = sorted({unit for way in ways for unit in of_way[way]})
    if not ways:
        return {}
    drawn = resampled(len(units), RESAMPLES, 0)
    means = np.empty((2, len(ways), RESAMPLES))
    for i, way in enumerate(ways):
        rows = [of_way[way].get(unit) for unit in units]
        known = np.array([row is not None for row in rows])
        for k, values in enumerate(([row.looks if row else 0.0 for row in rows],
                                    [row.harm if row else 0.0 for row in rows])):
            counted = known[drawn].sum(axis=1)
            whole = float(np.mean(np.array(values)[known]))
            means[k, i] = np.where(counted > 0, np.array(values)[drawn].sum(axis=1) / np.maximum(counted, 1), whole)
    looks, harm = means
    no_worse = (looks[:, None] <= looks[None]) & (harm[:, None] <= harm[None])  # [one, other]
    less = (looks[:, None] < looks[None]) | (harm[:, None] < harm[None])
    beaten = (no_worse & less).any(axis=0)
    return dict(zip(ways, (~beaten).mean(axis=1).tolist(), strict=True))


def score(standing: Standing, price: float) -> float:
    """Harm plus price times looks."""
    return standing.harm[0] + price * standing.looks[0]


def order(found: Sequence[Standing], price: float) -> list[str]:
    """The ways that compete, the best score first."""
    return [s.way for s in sorted(found, key=lambda s: (score(s, price), s.way)) if s.competes]


def ranks(found: Sequence[Standing], prices: Sequence[float] = PRICES) -> dict[str, list[int]]:
    """Place of each way (1 the best) at each price."""
    orders = [order(found, price) for price in prices]
    return {way: [of.index(way) + 1 for of in orders] for way in orders[0]}


def kept(found: Sequence[Standing], price: float, other: float) -> float:
    """Share of the pairs of ways that are in the same order at both prices."""
    one, two = order(found, price), order(found, other)
    pairs = list(combinations(one, 2))
    return sum(two.index(a) < two.index(b) for a, b in pairs) / len(pairs) if pairs else 1.0


def leaders(found: Sequence[Standing], most: float = 2.0) -> list[tuple[float, float, str]]:
    """Who is first at which price: (from, to, way), at prices from 0 to ``most`` in steps of a hundredth."""
    spans: list[tuple[float, float, str]] = []
    for step in range(round(most * 100) + 1):
        price = step / 100
        first = order(found, price)[0]
        spans = ([*spans[:-1], (spans[-1][0], price, first)] if spans and spans[-1][2] == first
                 else [*spans, (price, price, first)])
    return spans


def as_data(found: Sequence[Standing]) -> list[dict[str, Any]]:
    """Plain data for the page."""
    return [{"way": s.way, "between": s.between, "units": s.units, "looks": s.looks, "harm": s.harm, "saved": s.saved,
             "holm": s.holm, "verdict": s.verdict, "front": s.front, "often": s.often, "detail": dict(s.detail)}
            for s in found]
