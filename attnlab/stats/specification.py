"""Inference over a specification curve: one study under many readings of what is open (Simonsohn et al. 2020).

The readings are a fixed design, so there is no interval over them. Random are the seeds, and a seed is the same robot,
world and start poses in every reading. If nothing sets two conditions apart they may change places within a seed, in
all readings at once: that keeps how the readings hang together, and is the joint test.

Under exchange the score z = sum(x) / sqrt(sum(x^2)) over the seeds has variance 1, for signs change its numerator
alone; the standardised effect is a function of it. A reading that has no value has no score, and counts nowhere.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from attnlab.arithmetic import total
from attnlab.stats.tails import t_quantile

Floats = npt.NDArray[np.float64]
EXACT = 4096  # sign patterns counted one by one, up to 12 seeds; more are drawn
BLOCK = 256  # patterns at a time
LEAST_VALUES = 2  # seeds that a reading must have for a measure, to have a standard deviation
LIMIT = 3.0  # standard deviations; an effect beyond (t above 9 with 10 seeds) counts as this in means and variances


@dataclass
class Joint:
    """Of each measure, shape (measures,): in how many readings it has a ``value``; the median over readings of the
    standardised effect; how many have a clear effect on the claimed and on the other side. Two-sided p of the three
    statistics of Simonsohn et al.: ``p`` of the mean effect (each within ``LIMIT``), ``p_median``, ``p_clear`` of the
    readings clear on one side less those on the other; ``p_family``: of the mean, corrected for the number of measures
    (max-T). ``of_readings`` (readings, measures): p of one reading, corrected for all readings and measures, nan
    without value."""
    values: npt.NDArray[np.int64]
    median: Floats
    clear: npt.NDArray[np.int64]
    opposite: npt.NDArray[np.int64]
    p: Floats
    p_median: Floats
    p_clear: Floats
    p_family: Floats
    of_readings: Floats
    patterns: int
    exact: bool


@dataclass
class Levels:
    """Of one factor: its ``names``, and of shape (levels, measures) ``p``: of the mean effect over the readings with a
    level; ``differs``: that the level's readings score as all others do, corrected for all factors, levels and
    measures."""
    names: list[str]
    p: Floats
    differs: Floats


def standardised(differences: npt.ArrayLike) -> Floats:
    """Mean over standard deviation over the last axis (seeds), nan left out: 0 where nothing differs, infinite where
    all seeds differ by the same, nan where fewer than two seeds have a value."""
    x = np.asarray(differences, float)
    there = ~np.isnan(x)
    count = there.sum(axis=-1)
    mean = np.where(there, x, 0.0).sum(axis=-1) / np.maximum(count, 1)
    squares = (np.where(there, x - mean[..., None], 0.0) ** 2).sum(axis=-1)
    spread = np.sqrt(squares / np.maximum(count - 1, 1))
    spread = np.where(spread > 1e-12 * np.abs(mean), spread, 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        found = np.where(mean == 0.0, 0.0, mean / spread)
    return np.where(count >= LEAST_VALUES, found, np.nan)


def joint_test(differences: npt.ArrayLike, confidence: float = 0.95, draws: int = EXACT, seed: int = 0) -> Joint:
    """``differences``: (readings, measures, seeds) of treatment - control, signed so that above 0 is what was claimed;
    nan where a seed has no value.

    Exchanging the labels of a seed turns its sign in every reading and for every measure. All 2^seeds patterns are
    counted where they are few, else ``draws`` of them are drawn (the unchanged one always among them).
    """
    x = np.asarray(differences, float)
    scores, has = _scores(x)
    count, bound = (~np.isnan(x)).sum(axis=-1), clear_from(x, confidence)
    signs, patterns, exact = _patterns(x.shape[-1], draws, seed)
    effects = standardised(x)
    means = np.zeros((len(signs), x.shape[1]))
    p_median, p_clear = np.ones(x.shape[1]), np.ones(x.shape[1])
    median = np.full(x.shape[1], np.nan)
    for m in np.flatnonzero(has.any(axis=0)):
        d = _effects(scores[has[:, m], m], count[has[:, m], m], signs)
        clear = np.where(np.abs(d) > bound[has[:, m], m], np.sign(d), 0.0)
        means[:, m], median[m] = d.mean(axis=1), np.median(effects[has[:, m], m])
        p_median[m], p_clear[m] = _share(np.median(d, axis=1)), _share(clear.sum(axis=1))
    spread = means.std(axis=0)
    family = np.abs(means / np.where(spread > 0, spread, 1.0))
    _, one = _exchange(scores.reshape(-1, x.shape[-1]), signs)
    return Joint(has.sum(axis=0), median, (effects > bound).sum(axis=0), (effects < -bound).sum(axis=0),
                 np.array([_share(of) for of in means.T]), p_median, p_clear,
                 np.array([_share(family.max(axis=1), seen) for seen in family[0]]),
                 np.where(has, one.reshape(has.shape), np.nan), patterns, exact)


def clear_from(x: Floats, confidence: float = 0.95) -> Floats:
    """How large a standardised effect must be for its t interval to leave 0 out, by the seeds that have a value."""
    count = (~np.isnan(x)).sum(axis=-1)
    reach = t_quantile((1 + confidence) / 2, np.maximum(count - 1, 1)) / np.sqrt(np.maximum(count, 1))
    return np.where(count >= LEAST_VALUES, reach, np.nan)


def levels_test(differences: npt.ArrayLike, factors: Mapping[str, Sequence[str]], draws: int = EXACT, seed: int = 0
                ) -> dict[str, Levels]:
    """What sets the readings with one level of a factor apart from all others, by factor (``differences`` as of
    :func:`joint_test`; ``factors``: level of each reading).

    If an effect is the same in all readings, what a seed adds to the contrast of a level with the others has no side,
    and its sign may be turned; of all these contrasts the largest decides what is told from chance.
    """
    x = np.asarray(differences, float)
    scores, has = _scores(x)
    there = ~np.isnan(x) & has[..., None]
    size = scores * np.sqrt(there.sum(axis=-1))[..., None]  # x over its root mean square in a reading
    signs, *_ = _patterns(x.shape[-1], draws, seed)
    names = [(factor, level) for factor, of in factors.items() for level in dict.fromkeys(of)]
    mine = np.array([[own == level for own in factors[factor]] for factor, level in names], float)

    def mean(of: Floats, count: Floats) -> Floats:
        found: Floats = np.divide(of, count, out=np.full(of.shape, np.nan), where=count > 0)
        return found
    here, counts = np.tensordot(mine, size, 1), np.tensordot(mine, there.astype(float), 1)
    contrast = mean(here, counts) - mean(size.sum(axis=0) - here, there.sum(axis=0) - counts)
    shape = contrast.shape[:2]
    _, differs = _exchange(np.nan_to_num(contrast).reshape(-1, x.shape[-1]), signs)
    alone = np.ones(shape)
    for m in np.flatnonzero(has.any(axis=0)):
        d = _effects(scores[has[:, m], m], there[has[:, m], m].sum(axis=-1), signs)
        alone[:, m] = [_share(of) for of in (d @ mine[:, has[:, m]].T).T]
    found = {}
    for factor in factors:
        rows = [i for i, name in enumerate(names) if name[0] == factor]
        found[factor] = Levels([names[i][1] for i in rows], alone[rows], differs.reshape(shape)[rows])
    return found


def _scores(x: Floats) -> tuple[Floats, npt.NDArray[np.bool_]]:
    """What each seed adds to the score of a reading and measure, 0 where it has no value; and which have a score."""
    there = ~np.isnan(x)
    filled = np.where(there, x, 0.0)
    biggest = np.abs(filled).max(axis=-1, keepdims=True, initial=0.0)
    filled = np.divide(filled, biggest, out=np.zeros(x.shape), where=biggest > 0)  # so that no square underflows
    size = np.sqrt((filled ** 2).sum(axis=-1, keepdims=True))
    has = there.sum(axis=-1) >= LEAST_VALUES
    found = np.divide(filled, size, out=np.zeros(x.shape), where=(size > 0) & has[..., None])
    return found, has


def _patterns(n: int, draws: int, seed: int) -> tuple[Floats, int, bool]:
    """(signs by pattern and seed, number of patterns, are they all?). A pattern and its reverse are as large as each
    other, so that of all patterns those that leave the first seed alone say everything."""
    if 2 ** n <= draws:
        half = 1 - 2 * ((np.arange(2 ** max(n - 1, 0))[:, None] << 1 >> np.arange(n)) & 1)
        return half.astype(np.float64), 2 ** n, True
    drawn = np.random.default_rng([seed, n]).choice([-1.0, 1.0], (draws, n))
    drawn[0] = 1.0
    return drawn, draws, False


def _exchange(rows: Floats, signs: Floats) -> tuple[Floats, Floats]:
    """For rows (tests, seeds) that are to be summed: two-sided p of each sum, and p corrected for the number of rows,
    by the largest sum in units of its standard deviation under exchange. A row of zeros has p 1."""
    size = np.sqrt((rows ** 2).sum(axis=1, keepdims=True))
    unit = np.divide(rows, size, out=np.zeros(rows.shape), where=size > 1e-12 * max(float(size.max(initial=0)), 1e-300))
    bound = np.abs(unit.sum(axis=1)) - 1e-9
    hits, biggest = np.zeros(len(rows)), np.zeros(len(signs))
    for first in range(0, len(signs), BLOCK):
        sums = np.abs(signs[first:first + BLOCK] @ unit.T)
        hits += (sums >= bound).sum(axis=0)
        biggest[first:first + BLOCK] = sums.max(axis=1, initial=0.0)
    family = 1.0 - np.searchsorted(np.sort(biggest), bound) / len(signs)
    return hits / len(signs), family


def _effects(scores: Floats, count: npt.NDArray[np.int64], signs: Floats) -> Floats:
    """Standardised effects under each pattern, shape (patterns, readings), within ``LIMIT``: with r = z / sqrt(n) it is
    r / sqrt(1 - r^2) sqrt((n - 1) / n)."""
    r = signs @ scores.T / np.sqrt(count)
    return np.clip(r / np.sqrt(np.maximum(1.0 - r * r, 1e-12)) * np.sqrt((count - 1) / count), -LIMIT, LIMIT)


def _share(of_patterns: Floats, seen: float | None = None) -> float:
    """Share of the patterns, the unchanged one first among them, that are as large as it (or as ``seen``)."""
    size = np.abs(of_patterns)
    bound = size[0] if seen is None else seen
    return float((size >= bound - 1e-9 * max(1.0, bound)).mean())


def variance_shares(effects: npt.ArrayLike, factors: Mapping[str, Sequence[str]]) -> dict[str, float]:
    """Share of the variance of ``effects`` (readings,) that lies between the levels of each factor (eta squared).

    Readings without an effect are left out; one beyond ``LIMIT`` counts as that. Of a balanced design the shares add up
    with the rest, "other": interactions of factors, and chance."""
    y = np.clip(np.asarray(effects, float), -LIMIT, LIMIT)
    has = ~np.isnan(y)
    y = y[has]
    squares = float(((y - y.mean()) ** 2).sum()) if len(y) else 0.0
    found = {}
    for name, levels in factors.items():
        of = np.asarray(levels)[has]
        between = total(float((of == level).sum() * (y[of == level].mean() - y.mean()) ** 2)
                        for level in dict.fromkeys(of.tolist()))
        found[name] = between / squares if squares > 0 else 0.0
    found["other"] = max(0.0, 1.0 - total(found.values()))
    return found
