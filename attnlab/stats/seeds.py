"""Statistics over seeds: means, seeded bootstrap intervals, paired differences, effect sizes, tests."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]

RESAMPLES = 2000


class Interval(NamedTuple):
    """An estimate with the ends of its interval; the ends are nan when there are fewer than two seeds."""
    value: float
    low: float
    high: float


def mean(values: npt.ArrayLike) -> float:
    """The mean of what is not missing; nan for nothing."""
    kept = _kept(values)
    return float(kept.mean()) if kept.size else float("nan")


def iqm(values: npt.ArrayLike) -> float:
    """Interquartile mean: the mean of the middle half (Agarwal et al. 2021), scipy's 25 % trimmed mean."""
    kept = _kept(values)
    return float(_middle(kept).mean()) if kept.size else float("nan")


def _middle(values: Floats) -> Floats:
    """The values of the last axis without the lowest and the highest quarter (rounded down)."""
    n = values.shape[-1]
    return np.partition(values, (n // 4, n - n // 4 - 1))[..., n // 4:n - n // 4]


@lru_cache(maxsize=64)
def resampled(n: int, resamples: int, seed: int) -> npt.NDArray[np.int64]:
    """Indices of bootstrap samples, shape (resamples, n)."""
    return np.random.default_rng([seed, n]).integers(0, n, (resamples, n))


def bootstrap_interval(values: npt.ArrayLike, statistic: str = "mean", confidence: float = 0.95,
                       resamples: int = RESAMPLES, seed: int = 0) -> Interval:
    """Percentile bootstrap interval of the ``mean`` or ``iqm`` over seeds; missing values are left out."""
    kept = _kept(values)
    value = iqm(kept) if statistic == "iqm" else mean(kept)
    if kept.size < 2:
        return Interval(value, float("nan"), float("nan"))
    samples = kept[resampled(kept.size, resamples, seed)]
    drawn = (_middle(samples) if statistic == "iqm" else samples).mean(axis=1)
    tail = (1 - confidence) / 2
    low, high = np.quantile(drawn, [tail, 1 - tail])
    return Interval(value, float(low), float(high))


def bootstrap_band(values: npt.ArrayLike, confidence: float = 0.95, resamples: int = RESAMPLES,
                   seed: int = 0) -> tuple[Floats, Floats, Floats]:
    """(mean, low, high), each of shape (x,), of ``values`` with shape (seeds, x): whole seeds are drawn, so that a band
    keeps a seed's curve together. A cell nobody has is nan; low and high are nan where fewer than two seeds are."""
    values = np.asarray(values, float)
    present = ~np.isnan(values)
    count = present.sum(axis=0)
    filled = np.where(present, values, 0.0)
    with np.errstate(invalid="ignore", divide="ignore"):
        centre = filled.sum(axis=0) / count
    nothing = np.full(values.shape[1], np.nan)
    n = values.shape[0]
    if n < 2:
        return centre, nothing, nothing.copy()
    weights = np.zeros((resamples, n))
    np.add.at(weights, (np.arange(resamples)[:, None], resampled(n, resamples, seed)), 1.0)
    with np.errstate(invalid="ignore", divide="ignore"):
        drawn = np.einsum("rs,sx->rx", weights, filled) / np.einsum("rs,sx->rx", weights, present.astype(float))
    tail = (1 - confidence) / 2
    low, high = nothing.copy(), nothing.copy()
    some = count >= 2
    if some.any():
        quantile = np.nanquantile if np.isnan(drawn[:, some]).any() else np.quantile  # the same, several times faster
        low[some], high[some] = quantile(drawn[:, some], [tail, 1 - tail], axis=0)
    return centre, low, high


def paired(treatment: dict[int, float], control: dict[int, float]) -> Floats:
    """Differences treatment - control of the seeds that both have, in the order of the seeds; missing ones left out."""
    seeds = sorted(set(treatment) & set(control))
    return _kept([treatment[seed] - control[seed] for seed in seeds])


def effect_size(values: npt.ArrayLike, reference: float = 0.0) -> float:
    """Cohen's d of (paired) values against a reference: (mean - reference) / standard deviation (n - 1).

    nan for fewer than two values; infinite if all are the same and differ from the reference.
    """
    kept = _kept(values)
    if kept.size < 2:
        return float("nan")
    shift, spread = kept.mean() - reference, kept.std(ddof=1)
    if spread < 1e-12 * max(1.0, abs(kept).max()):
        return 0.0 if abs(shift) < 1e-12 else float(np.copysign(np.inf, shift))
    return float(shift / spread)


def improvement(treatment: npt.ArrayLike, control: npt.ArrayLike) -> float:
    """Probability of improvement: that a treatment run beats a control run, ties half (Mann-Whitney U / nm)."""
    a, b = _kept(treatment)[:, None], _kept(control)
    return float((a > b).mean() + (a == b).mean() / 2) if a.size and b.size else float("nan")


def holm(p_values: npt.ArrayLike) -> Floats:
    """Holm's (1979) step-down correction along the first axis; nan (no test) stays nan and is not counted."""
    p = np.asarray(p_values, float)
    known = ~np.isnan(p)
    order = np.argsort(np.where(known, p, np.inf), axis=0, kind="stable")
    rank = np.arange(len(p)).reshape(-1, *[1] * (p.ndim - 1))
    left = np.maximum(known.sum(axis=0) - rank, 1)
    steps = np.minimum(1.0, left * np.take_along_axis(p, order, axis=0))
    adjusted: Floats = np.empty_like(p)
    np.put_along_axis(adjusted, order, np.fmax.accumulate(steps, axis=0), axis=0)
    return np.where(known, adjusted, np.nan)


def _kept(values: npt.ArrayLike) -> Floats:
    array = np.asarray(values, float).ravel()
    kept: Floats = array[~np.isnan(array)]
    return kept
