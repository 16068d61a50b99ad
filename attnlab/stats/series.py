"""What is measured along episodes and along cycles: convergence, rhythm, overlap of activations."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt


def block_means(episodes: npt.ArrayLike, block: int) -> npt.NDArray[np.float64]:
    """Means of consecutive blocks of ``block`` episodes; a last block of less than half a block is left out."""
    values = np.asarray(episodes, float)
    edges = range(0, len(values), block)
    parts = [values[i:i + block] for i in edges]
    if len(parts) > 1 and 2 * len(parts[-1]) < block:
        parts.pop()
    return np.array([part.mean() for part in parts])


def convergence_episode(episodes: npt.ArrayLike, block: int, level: float) -> float:
    """Episodes before the first block whose mean is at ``level`` or above and after which no block falls below it.

    ``episodes``: one number each. The number of episodes if that never happens; nan for no episodes.
    """
    values = np.asarray(episodes, float)
    if not values.size:
        return float("nan")
    below = np.flatnonzero(block_means(values, block) < level)
    if not below.size:
        return 0.0
    return float(min((below[-1] + 1) * block, values.size))


class Rhythm(NamedTuple):
    """``share`` of the power in the spectral peak (0-1) and the peak's ``period`` in cycles."""
    share: float
    period: float


def rhythm(signal: npt.ArrayLike) -> Rhythm:
    """The peak of the periodogram of a detrended signal (scipy.signal): a sine has share near 1, noise near 0.

    The power of the peak's two neighbours counts, for a peak may lie between two frequencies. (0, nan) for a constant.
    """
    from scipy.signal import periodogram
    values = np.asarray(signal, float)
    if values.size < 8 or np.ptp(values) < 1e-9:
        return Rhythm(0.0, float("nan"))
    frequency, power = periodogram(values, window="hann", detrend="linear")
    total = power[1:].sum()
    if total <= 0:
        return Rhythm(0.0, float("nan"))
    peak = 1 + int(power[1:].argmax())
    return Rhythm(float(power[max(1, peak - 1):peak + 2].sum() / total), float(1 / frequency[peak]))


def overlap_ratio(activations: float, active_cycles: float) -> float:
    """(sum - union) / sum: the share of activations that fall into a cycle in which somebody else was active before
    them. 0 if no two coincide. nan without activations."""
    return (activations - active_cycles) / activations if activations else float("nan")


def overlap_null(active: npt.ArrayLike, draws: int = 200, seed: int = 0) -> npt.NDArray[np.float64]:
    """Overlap ratios, shape (draws,), of the same activation trains at random phases.

    ``active``: booleans of shape (cycles, behaviours). Each train is turned around the episode by its own random
    amount, which keeps its rhythm and destroys its timing against the others.
    """
    trains = np.asarray(active, bool)
    n, behaviours = trains.shape
    rng = np.random.default_rng(seed)
    at = [np.flatnonzero(trains[:, b]) for b in range(behaviours)]
    total = sum(train.size for train in at)
    if not total:
        return np.full(draws, np.nan)
    hit = np.zeros((draws, n), bool)
    for train, shifts in zip(at, rng.integers(0, n, (draws, behaviours)).T, strict=True):
        hit[np.arange(draws)[:, None], (train + shifts[:, None]) % n] = True
    share: npt.NDArray[np.float64] = (total - hit.sum(axis=1)) / total
    return share
