"""What kind of statement a multiverse makes of a comparison: robust, hanging on one factor, mixed, or noise.

The rules were written before any run that they judge, and are tried on planted multiverses in tests/report/:

* **told from chance**: the joint p of the mean effect, corrected for all comparisons (max-T), is at most ``CLEAR``.
* **holds at a level** of a factor: of the readings with this level nearly all (``NEARLY_ALL``) are on one side, and the
  joint p of their mean effect is at most ``CLEAR``. This p is not corrected; it never decides alone.
* **hangs on a factor**: the readings with one of its levels differ from all others (the largest contrast over all
  factors, levels and comparisons decides, at ``CLEAR``), and it holds at one level and at another not on that side.
  Of several such factors that with the largest share of the variance is named first.
* **robust**: hangs on nothing, is told from chance, and nearly all readings are on one side.
* **mixed**: told from chance and neither of these. **noise**: the rest.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
import numpy.typing as npt

from attnlab.stats.specification import Joint, Levels

Floats = npt.NDArray[np.float64]
CLEAR = 0.05  # the customary error, of all comparisons together
NEARLY_ALL = 0.9  # with 10 seeds chance alone turns one reading in ten at an effect of 0.4: Phi(-0.4 sqrt(10)) = 0.10


class Kind(StrEnum):
    ROBUST = "robust"
    HANGS = "hangs on a factor"
    MIXED = "mixed"
    NOISE = "noise"


@dataclass
class AtLevel:
    """The readings with a level: how many have a value and are on each side, and the joint p of their mean effect."""
    level: str
    values: int
    above: int
    below: int
    p: float

    def holds(self, side: float) -> bool:
        on = self.above if side > 0 else self.below
        return self.values > 0 and self.p <= CLEAR and on >= NEARLY_ALL * self.values


@dataclass
class Statement:
    """``side``: +1 as claimed, -1 the opposite, 0 neither, by the median; ``on_side`` of the readings that have a value
    are there. ``factors``: those it hangs on, the first moves most; ``levels`` of the first."""
    kind: Kind
    side: float
    on_side: int
    values: int
    factors: list[str]
    levels: list[AtLevel]


def state(effects: Floats, p_family: float, tests: Mapping[str, Levels], measure: int,
          factors: Mapping[str, Sequence[str]], shares: Mapping[str, float]) -> Statement:
    """The statement that ``effects`` (readings,) make, by the joint test, the tests of levels and shares of variance of
    this ``measure``."""
    has = ~np.isnan(effects)
    side = float(np.sign(np.median(effects[has]))) if has.any() else 0.0
    on_side, values = int((np.sign(effects[has]) == side).sum()), int(has.sum())
    split = {name: levels for name, test in tests.items()
             if test.differs[:, measure].min() <= CLEAR
             and _splits(levels := at_levels(effects, np.asarray(factors[name]), test, measure))}
    order = sorted(split, key=lambda name: (-shares[name], name))
    if order:
        return Statement(Kind.HANGS, side, on_side, values, order, split[order[0]])
    told = p_family <= CLEAR
    kind = Kind.NOISE if not told else Kind.ROBUST if side and on_side >= NEARLY_ALL * values else Kind.MIXED
    return Statement(kind, side, on_side, values, [], [])


def at_levels(effects: Floats, of: npt.NDArray[np.str_], test: Levels, measure: int) -> list[AtLevel]:
    """A factor's levels, each with its readings' sides."""
    return [AtLevel(level, int((~np.isnan(effects[of == level])).sum()), int((effects[of == level] > 0).sum()),
                    int((effects[of == level] < 0).sum()), float(test.p[i, measure]))
            for i, level in enumerate(test.names)]


def _splits(levels: Sequence[AtLevel]) -> bool:
    """Does it hold at one level, and at another not on that side?"""
    return any(one.holds(side) and any(other.values and not other.holds(side) for other in levels)
               for side in (1.0, -1.0) for one in levels)


def all_statements(effects: Floats, joint: Joint, tests: Mapping[str, Levels], factors: Mapping[str, Sequence[str]],
                   shares: Sequence[Mapping[str, float]]) -> list[Statement]:
    """Of every comparison: ``effects`` (readings, comparisons)."""
    return [state(effects[:, m], float(joint.p_family[m]), tests, m, factors, shares[m])
            for m in range(effects.shape[1])]
