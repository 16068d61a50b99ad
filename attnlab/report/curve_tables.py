"""A multiverse as CSV: effects on claims, the curve of every contrast, its joint test, the verdicts of all readings."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from attnlab.claims.judge import Verdict
from attnlab.claims.roles import Combinations
from attnlab.report.multiverse import Curves, Multiverse
from attnlab.tables.csvs import csv_bytes


def effects_csv(found: Multiverse) -> bytes:
    """A row a claim and level: how much more often it holds than at the default."""
    return csv_bytes(("claim", "factor", "level", "default", "difference_of_shares"),
                ([*e[:4], f"{e.difference:.4f}"] for e in found.moved))


def curve_csv(found: Multiverse, curves: Curves) -> bytes:
    """A row a contrast and reading that has a value: the signed standardised effect with its interval, and its p
    corrected for all readings and contrasts."""
    rows = []
    for m, of in enumerate(curves.contrasts):
        for r in np.argsort(curves.effects[:, m], kind="stable"):
            if np.isnan(curves.effects[r, m]):
                continue
            numbers = (curves.effects[r, m], curves.low[r, m], curves.high[r, m], curves.joint.of_readings[r, m])
            rows.append([of.measure, of.claim, of.who, of.whom, found.names[r], *(f"{x:.5g}" for x in numbers),
                         *(levels[r] for levels in found.levels.values())])
    return csv_bytes(("measure", "claim", "role", "against", "reading", "effect_d", "low", "high", "p_family",
                 *found.levels), rows)


def joint_csv(found: Multiverse, curves: Curves) -> bytes:
    """A row a contrast: readings with a value, its median effect, clear readings, joint p, what kind of statement it
    is, and which factor has the largest share of the variance of its effects."""
    rows, j = [], curves.joint
    for m, of in enumerate(curves.contrasts):
        said, (mover, share) = curves.statements[m], curves.mover(m)
        numbers = (j.p[m], j.p_median[m], j.p_clear[m], j.p_family[m])
        levels = "; ".join(f"{at.level}: {at.above} of {at.values}" for at in said.levels)
        rows.append([of.measure, of.claim, of.who, of.whom, "lower" if of.sign < 0 else "higher", len(found.names),
                     j.values[m], curves.differences.shape[-1], f"{j.median[m]:.5g}",
                     int((curves.effects[:, m] > 0).sum()), j.clear[m], j.opposite[m],
                     *(f"{x:.5g}" for x in numbers), j.patterns, said.kind, of.told(said.side), said.on_side,
                     "; ".join(said.factors), levels, mover, f"{share:.4f}"])
    return csv_bytes(("measure", "claim", "role", "against", "claimed", "readings", "with_value", "seeds", "median_d",
                 "as_claimed", "clear_as_claimed", "clear_opposite", "p_joint", "p_median", "p_clear", "p_family",
                 "patterns", "statement", "side", "readings_on_side", "hangs_on", "as_claimed_by_level",
                 "moved_most_by", "its_share"), rows)


def shares_csv(curves: Curves) -> bytes:
    """A row a contrast and factor: share of the variance of the effects between the factor's levels."""
    return csv_bytes(("measure", "claim", "role", "against", "factor", "share_of_variance"),
                ([of.measure, of.claim, of.who, of.whom, name, f"{share:.4f}"]
                 for of, shares in zip(curves.contrasts, curves.shares, strict=True)
                 for name, share in shares.items()))


def combinations_csv(combinations: Combinations, judged: Mapping[str, Sequence[Verdict]]) -> bytes:
    """A row a combination: its settings, and the verdict on every claim."""
    first = next(iter(judged.values()), [])
    return csv_bytes(("combination", *next(iter(combinations.values()), {}), *(v.id for v in first)),
                ([name, *settings.values(), *(v.verdict for v in verdicts)]
                 for (name, verdicts), settings in zip(judged.items(), combinations.values(), strict=True)))
