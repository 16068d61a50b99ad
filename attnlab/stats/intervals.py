"""Intervals that decide: Student's t for means, exact ones for medians, and BCa to hold beside them.

All work on many samples at once: ``values`` of shape (..., n), the last axis over seeds. Ends are nan under two seeds.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from attnlab.stats.seeds import Interval, resampled
from attnlab.stats.tails import coin, normal_below, normal_quantile, t_above, t_quantile

Floats = npt.NDArray[np.float64]


class Ends(NamedTuple):
    """A value with the ends of its interval and the two-sided p of "it is the reference", arrays of one shape."""
    value: Floats
    low: Floats
    high: Floats
    p: Floats


def t_interval(values: npt.ArrayLike, reference: float = 0.0, confidence: float = 0.95) -> Ends:
    """Mean with Student's t interval, and the t test's p. Values that are all the same have an interval of no width."""
    x = np.asarray(values, float)
    n = x.shape[-1]
    mean = x.mean(axis=-1) if n else np.full(x.shape[:-1], np.nan)
    if n < 2:
        nothing = np.full(mean.shape, np.nan)
        return Ends(mean, nothing, nothing, nothing)
    error = x.std(axis=-1, ddof=1) / np.sqrt(n)
    error = np.where(error < 1e-12 * np.maximum(1.0, abs(x).max(axis=-1)), 0.0, error)
    reach = float(t_quantile((1 + confidence) / 2, n - 1)) * error
    shift = mean - reference
    with np.errstate(invalid="ignore", divide="ignore"):
        p = 2 * t_above(abs(shift) / error, n - 1)
    p = np.where(error > 0, p, np.where(abs(shift) < 1e-12, 1.0, 0.0))
    return Ends(mean, mean - reach, mean + reach, p)


def mean_interval(values: npt.ArrayLike, confidence: float = 0.95) -> Interval:
    """The mean of one sample of shape (n,) with its t interval; missing values are left out."""
    kept = np.asarray(values, float)
    value, low, high, _ = t_interval(kept[~np.isnan(kept)], confidence=confidence)
    return Interval(float(value), float(low), float(high))


def difference_interval(one: npt.ArrayLike, other: npt.ArrayLike, confidence: float = 0.95) -> Interval:
    """The mean of one sample less that of another that has nothing to do with it, with Welch's (1947) t interval;
    missing values are left out. Ends are nan where a sample has fewer than two values."""
    x, y = (kept[~np.isnan(kept)] for kept in (np.asarray(one, float), np.asarray(other, float)))
    if not x.size or not y.size:
        return Interval(float("nan"), float("nan"), float("nan"))
    apart = float(x.mean() - y.mean())
    if min(x.size, y.size) < 2:
        return Interval(apart, float("nan"), float("nan"))
    a, b = float(x.var(ddof=1)) / x.size, float(y.var(ddof=1)) / y.size
    if a + b == 0.0:
        return Interval(apart, apart, apart)
    freedom = (a + b) ** 2 / (a ** 2 / (x.size - 1) + b ** 2 / (y.size - 1))
    reach = float(t_quantile((1 + confidence) / 2, freedom)) * float(np.sqrt(a + b))
    return Interval(apart, apart - reach, apart + reach)


def median_interval(values: npt.ArrayLike, reference: float = 0.0, confidence: float = 0.95) -> Ends:
    """Median with the exact interval between two order statistics, and the sign test's p (twice the smaller tail).

    ``values`` may be inf: a time that was not reached before watching ended. With one end of watching for all, this is
    the median of Kaplan and Meier's (1958) curve. Ends are -inf and inf where n is too small for the confidence.
    """
    x = np.sort(np.asarray(values, float), axis=-1)
    n = x.shape[-1]
    middle = np.where(x[..., (n - 1) // 2] == x[..., n // 2], x[..., n // 2],  # inf - inf is nothing
                      (x[..., (n - 1) // 2] + x[..., n // 2]) / 2)
    tail = (1 - confidence) / 2
    place = int(np.searchsorted(coin(n), tail))  # the k-th smallest and largest with P(fewer) within the tail
    low = x[..., place - 1] if place >= 1 else np.full(middle.shape, -np.inf)
    high = x[..., n - place] if place >= 1 else np.full(middle.shape, np.inf)
    below, above = (x < reference).sum(axis=-1), (x > reference).sum(axis=-1)
    p = np.minimum(1.0, 2 * _at_most(np.minimum(below, above), below + above))
    return Ends(middle, low, high, p)


def _at_most(heads: npt.ArrayLike, tosses: npt.ArrayLike) -> Floats:
    """P(at most so many heads in so many tosses of a fair coin), in the arrays' shape."""
    k, n = np.asarray(heads), np.asarray(tosses)
    found = np.empty(n.shape)
    for of in np.unique(n):
        found[n == of] = coin(int(of))[k[n == of]]
    return found


def bca_interval(values: npt.ArrayLike, confidence: float = 0.95, resamples: int = 4000, seed: int = 0
                 ) -> tuple[float, float]:
    """Bias-corrected and accelerated bootstrap interval of a mean (Efron 1987) of one sample of shape (n,); (nan, nan)
    under two values. Seeded; values that are all the same have an interval of no width."""
    x = np.asarray(values, float)
    n = x.size
    if n < 2:
        return float("nan"), float("nan")
    mean = float(x.mean())
    if np.ptp(x) < 1e-12 * max(1.0, abs(x).max()):
        return mean, mean
    drawn = np.sort(x[resampled(n, resamples, seed)].mean(axis=1))
    below = (np.sum(drawn < mean) + np.sum(drawn == mean) / 2) / resamples
    bias = normal_quantile(np.clip(below, 1 / (resamples + 1), 1 - 1 / (resamples + 1)))
    away = (x.sum() - x) / (n - 1)  # means that leave one out
    away = away.mean() - away
    squares = float((away ** 2).sum())
    acceleration = float((away ** 3).sum()) / (6 * squares ** 1.5) if squares > 0 else 0.0
    z = bias + normal_quantile([(1 - confidence) / 2, (1 + confidence) / 2])
    low, high = np.quantile(drawn, normal_below(bias + z / (1 - acceleration * z)))
    return float(low), float(high)


@lru_cache(maxsize=64)
def _halves(n: int) -> tuple[npt.NDArray[np.int8], npt.NDArray[np.int8]]:
    """All sign patterns of the first and of the second half of n values."""
    def patterns(m: int) -> npt.NDArray[np.int8]:
        return (1 - 2 * ((np.arange(2 ** m)[:, None] >> np.arange(m)) & 1)).astype(np.int8)
    return patterns(n // 2), patterns(n - n // 2)


EXACT = 32  # up to this many values all sign patterns are counted


def sign_flip_p(values: npt.ArrayLike, reference: float = 0.0, draws: int = 10_000, seed: int = 0) -> float:
    """Two-sided p of "the mean is ``reference``" by flipping the signs of the deviations (Fisher's paired permutation
    test): exact up to 32 values, by meeting in the middle (Horowitz and Sahni 1974), else seeded draws. nan for fewer
    than two values."""
    x = np.asarray(values, float).ravel()
    x = x[~np.isnan(x)] - reference
    n = x.size
    if n < 2:
        return float("nan")
    seen = abs(float(x.sum()))
    least = seen - 1e-9 * max(1.0, seen)
    if n > EXACT:
        signs = np.random.default_rng([seed, n]).choice([-1.0, 1.0], (draws, n))
        return (int((abs(np.einsum("ij,j->i", signs, x)) >= least).sum()) + 1) / (draws + 1)
    first, second = _halves(n)
    a, b = np.einsum("ij,j->i", first, x[:n // 2]), np.sort(np.einsum("ij,j->i", second, x[n // 2:]))
    beyond = b.size - np.searchsorted(b, least - a, side="left") + np.searchsorted(b, -least - a, side="right")
    if least <= 0:
        return 1.0
    return float(beyond.sum() / (a.size * b.size))
