"""From samples to findings, for one study or for thousands of planted ones at once.

A sample has shape (studies, seeds). docs/claims.md has these rules in words.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from attnlab.claims.findings import RANK, Finding
from attnlab.claims.parts import Part, Rules
from attnlab.stats import Ends, holm, median_interval, t_interval

Codes = npt.NDArray[np.int64]  # ranks of findings, the worst being 0
Floats = npt.NDArray[np.float64]

CONTRADICTED, UNTESTABLE, NOT, DIRECTION, COMPATIBLE, REPRODUCED = (RANK[f] for f in (
    Finding.CONTRADICTED, Finding.UNTESTABLE, Finding.NOT, Finding.DIRECTION, Finding.COMPATIBLE, Finding.REPRODUCED))


def turn(part: Part) -> float:
    """Where the comparison would be neither here nor there: the margin, the number alone, or the reference."""
    if part.test == "not_lower":
        return -(part.margin or 0.0)
    return part.number if part.direction == "about" and part.number is not None else part.reference


def interval(part: Part, sample: npt.ArrayLike, rules: Rules) -> Ends:
    """Value, interval, and the p of "it is where the claim would turn", each of shape (studies,)."""
    of = median_interval if part.test == "median" else t_interval
    x = np.asarray(sample, float)
    if part.test != "not_lower" and part.direction == "about" and part.number is not None:
        # against the nearer end of the tolerance
        ends = [of(x, part.number + side * (part.known or 0.0), rules.confidence) for side in (-1, 1)]
        above = ends[0].value > part.number
        return ends[0]._replace(p=np.where(above, ends[1].p, ends[0].p))
    return of(x, turn(part), rules.confidence)


def grade(part: Part, d: Ends) -> Codes:
    """The finding of one comparison, alone, shape (studies,)."""
    low, high = np.atleast_1d(d.low), np.atleast_1d(d.high)
    if part.test == "not_lower":
        margin = part.margin or 0.0
        return np.select([low >= -margin, high < -margin], [REPRODUCED, CONTRADICTED], NOT)
    within, touches = np.zeros(low.shape, bool), np.zeros(low.shape, bool)
    if part.number is not None and part.known is not None:
        first, last = part.number - part.known, part.number + part.known
        within, touches = (low >= first) & (high <= last), (low <= last) & (high >= first)
        if part.direction == "about":
            return np.select([within, ~touches], [REPRODUCED, CONTRADICTED], NOT)
    holds, opposite = sides(part, low, high)
    return np.select([holds & within, holds & touches, holds, opposite], [REPRODUCED, COMPATIBLE, DIRECTION,
                                                                          CONTRADICTED], NOT)


def sides(part: Part, low: Floats, high: Floats) -> tuple[npt.NDArray[np.bool_], npt.NDArray[np.bool_]]:
    """Is the whole interval on the claimed side of the reference, is it on the other?"""
    r = part.reference
    return {"higher": (low > r, high < r), "lower": (high < r, low > r),
            "at_least": (low >= r, high < r), "at_most": (high <= r, low > r)}[part.direction]


def together(parts: Sequence[Part], codes: Sequence[Codes], p: Sequence[Floats], seeds: int, rules: Rules
             ) -> tuple[Codes, list[Codes]]:
    """(finding of the claim, findings of its counting ``parts``), each of shape (studies,).

    A comparison contradicts if its p survives Holm's correction over the claim's comparisons, and, where there are
    several, if there are ``contradict_seeds``. The claim fares as its worst comparison; one without a number says
    nothing about how near a number is, so that the others decide that.
    """
    stack = np.stack([np.atleast_1d(of) for of in codes])
    adjusted = holm(np.stack([np.atleast_1d(of) for of in p]))
    kept = adjusted < 1 - rules.confidence
    if len(parts) > 1 and seeds < rules.contradict_seeds:
        kept = np.zeros_like(kept)
    stack = np.where((stack == CONTRADICTED) & ~kept, NOT, stack)
    sized = [part.number is not None or part.test == "not_lower" for part in parts]
    rated = stack.copy()
    if any(sized):
        rated[~np.array(sized)] = np.where(rated[~np.array(sized)] == DIRECTION, REPRODUCED, rated[~np.array(sized)])
    return rated.min(axis=0), list(stack)

