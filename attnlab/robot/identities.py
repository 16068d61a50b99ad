"""Identities that hold whatever the robot does; checked for every cycle of a run unless ``check_identities=false``."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np


class IdentityError(AssertionError):
    """The bookkeeping of a run contradicts the equations: a bug, never a result."""


def check_balance(balance: np.ndarray, e_u: float, e_nb: float, growth: float, active: np.ndarray,
                  cycles: np.ndarray) -> None:
    """E plus the needs that feed it changes by -e_u a cycle and (growth - e_nb) an active behaviour, whatever is eaten.

    ``balance``: that sum (UoE) at the start and after each of n stretches, shape (n + 1,); ``active`` behaviours at the
    beginning of each stretch and the ``cycles`` it took, shape (n,). ``growth`` is the sum of k over those needs (2k in
    the paper).
    """
    changed, expected = np.diff(balance), -e_u * cycles + (growth - e_nb) * active
    wrong = np.flatnonzero(~np.isclose(changed, expected, rtol=1e-9, atol=1e-6))
    if wrong.size:
        i = wrong[0]
        raise IdentityError(f"energy + needs changed by {changed[i]} over {cycles[i]} cycles, should be {expected[i]}")


def check_clock(cycles_of: Sequence[int] | np.ndarray, periods: Sequence[int] | np.ndarray, end: int) -> None:
    """Periods granted sum to the episode's cycles, but for what is left of the last one.

    ``cycles_of``: when the behaviour was active; ``periods``: what was granted then; ``end``: cycles of the episode.
    """
    fired, granted = np.asarray(cycles_of), np.asarray(periods)
    wrong = np.flatnonzero(fired[:-1] + granted[:-1] != fired[1:])
    if wrong.size:
        i = wrong[0]
        raise IdentityError(f"a period of {granted[i]} granted at cycle {fired[i]} ended at {fired[i + 1]}")
    if len(fired) and not fired[-1] < end <= fired[-1] + granted[-1]:
        raise IdentityError(f"the last period, {granted[-1]} granted at cycle {fired[-1]}, does not hold the end at "
                            f"{end}")
    if len(fired) and fired[0] != 0:
        raise IdentityError(f"the first activation was at cycle {cycles_of[0]}, not 0")


def check_safety(mean: float, cycles: int, activations: int, longest: int, shortest: int) -> None:
    """Safety averaged over an episode cannot exceed (p_max - N/A) / (p_max - p_min)."""
    if longest == shortest or not activations:
        return
    bound = (longest - cycles / activations) / (longest - shortest)
    if mean > bound + 1e-9:
        raise IdentityError(f"mean safety {mean} is above its bound {bound}")
