"""Identities that hold whatever the robot does; checked on every cycle of a run unless ``check_identities=false``."""

from __future__ import annotations

from collections.abc import Sequence
from math import isclose


class IdentityError(AssertionError):
    """The bookkeeping of a run contradicts the equations: a bug, never a result."""


def check_balance(before: float, after: float, e_u: float, e_nb: float, growth: float, active: int,
                  cycles: int) -> None:
    """E plus the needs that feed it changes by -e_u a cycle and (growth - e_nb) an active behaviour, whatever is eaten.

    ``before`` and ``after`` are those sums in UoE; ``growth`` is the sum of k over those needs (2k in the paper).
    """
    expected = -e_u * cycles + (growth - e_nb) * active
    if not isclose(after - before, expected, rel_tol=1e-9, abs_tol=1e-6):
        raise IdentityError(f"energy + needs changed by {after - before} over {cycles} cycles, should be {expected}")


def check_clock(cycles_of: Sequence[int], periods: Sequence[int], end: int) -> None:
    """Periods granted sum to the episode's cycles, but for what is left of the last one.

    ``cycles_of``: when the behaviour was active; ``periods``: what was granted then; ``end``: cycles of the episode.
    """
    for i, (cycle, period) in enumerate(zip(cycles_of, periods, strict=True)):
        following = cycles_of[i + 1] if i + 1 < len(cycles_of) else None
        if following is not None and cycle + period != following:
            raise IdentityError(f"a period of {period} granted at cycle {cycle} ended at {following}")
        if following is None and not cycle < end <= cycle + period:
            raise IdentityError(f"the last period, {period} granted at cycle {cycle}, does not hold the end at {end}")
    if cycles_of and cycles_of[0] != 0:
        raise IdentityError(f"the first activation was at cycle {cycles_of[0]}, not 0")


def check_safety(mean: float, cycles: int, activations: int, longest: int, shortest: int) -> None:
    """Safety averaged over an episode cannot exceed (p_max - N/A) / (p_max - p_min)."""
    if longest == shortest or not activations:
        return
    bound = (longest - cycles / activations) / (longest - shortest)
    if mean > bound + 1e-9:
        raise IdentityError(f"mean safety {mean} is above its bound {bound}")
