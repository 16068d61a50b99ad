"""Inference over a specification curve: one study under many readings of what is open (Simonsohn et al. 2020).

The readings are a fixed design, so there is no interval over them. Random are the seeds, and a seed is the same robot,
world and start poses in every reading. If nothing sets two conditions apart they may change places within a seed, in
all readings at once: that keeps how the readings hang together, and is the joint test.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
EXACT = 4096  # sign patterns counted one by one, up to 12 seeds; more are drawn


@dataclass
class Joint:
    """Of each measure, shape (measures,): the median over readings of the standardised effect, how many readings have a
    clear effect on the claimed and on the other side, the two-sided p of that median, and the p corrected for the
    number of measures (max-T). ``of_readings`` (readings, measures): p of one reading, corrected for their number."""
    median: Floats
    clear: Floats
    opposite: Floats
    p: Floats
    p_family: Floats
    of_readings: Floats
    patterns: int
    exact: bool


def standardised(differences: Floats) -> Floats:
    """Mean over standard deviation over the last axis (seeds), nan left out; 0 where nothing differs or is there."""
    there = ~np.isnan(differences)
    filled = np.where(there, differences, 0.0)
    return _standard(filled.sum(axis=-1), (filled ** 2).sum(axis=-1), there.sum(axis=-1))


def _standard(total: Floats, squares: Floats, count: npt.NDArray[np.int64]) -> Floats:
    """The same from sums, sums of squares and numbers of values, of any shape."""
    mean = total / np.maximum(count, 1)
    spread = np.sqrt(np.maximum(squares - count * mean ** 2, 0.0) / np.maximum(count - 1, 1))
    found: Floats = np.divide(mean, spread, out=np.zeros(np.broadcast(mean, spread).shape),
                              where=(spread > 1e-12 * np.abs(mean)) & (count > 1))
    return found


def joint_test(differences: npt.ArrayLike, confidence: float = 0.95, draws: int = EXACT, seed: int = 0) -> Joint:
    """``differences``: (readings, measures, seeds) of treatment - control, signed so that above 0 is what was claimed;
    nan where a seed has no value.

    Exchanging the labels of a seed turns its sign in every reading and for every measure. All 2^seeds patterns are
    counted where they are few, else ``draws`` of them are drawn (the unchanged one always among them).
    """
    from scipy.stats import t as student
    x = np.asarray(differences, float)
    measures, n = x.shape[1:]
    there = ~np.isnan(x)
    count = there.sum(axis=-1)
    filled = np.where(there, x, 0.0)
    squares = (filled ** 2).sum(axis=-1)
    signs, exact = _patterns(n, draws, seed)

    def effects(of: Floats) -> Floats:
        """Standardised effects of a block of patterns, shape (patterns, readings, measures)."""
        return _standard(np.einsum("ps,rms->prm", of, filled), squares, count)
    medians, biggest = np.empty((len(signs), measures)), np.empty((len(signs), measures))
    for first in range(0, len(signs), 128):
        d = effects(signs[first:first + 128])
        medians[first:first + 128] = np.median(d, axis=1)
        biggest[first:first + 128] = np.abs(d * np.sqrt(count)).max(axis=1)
    seen = effects(np.ones((1, n)))[0]
    median = np.median(seen, axis=0)
    spread = medians.std(axis=0)
    scale = np.where(spread > 0, spread, 1.0)
    t = seen * np.sqrt(count)
    bound = student.ppf((1 + confidence) / 2, np.maximum(count - 1, 1))
    family = np.abs(medians / scale).max(axis=1)
    return Joint(median, (t > bound).sum(axis=0).astype(float), (t < -bound).sum(axis=0).astype(float),
                 _share(np.abs(medians), np.abs(median)), _share(family[:, None], np.abs(median / scale)),
                 np.stack([_share(biggest, np.abs(row)) for row in t]), len(signs), exact)


def _patterns(n: int, draws: int, seed: int) -> tuple[Floats, bool]:
    if 2 ** n <= draws:
        return (1 - 2 * ((np.arange(2 ** n)[:, None] >> np.arange(n)) & 1)).astype(np.float64), True
    drawn = np.random.default_rng([seed, n]).choice([-1.0, 1.0], (draws, n))
    drawn[0] = 1.0
    return drawn, False


def _share(null: Floats, seen: Floats) -> Floats:
    """Share of the patterns, the seen one among them, that are as large, for each column."""
    found: Floats = (null >= seen - 1e-9 * np.maximum(1.0, seen)).mean(axis=0)
    return found


def variance_shares(effects: npt.ArrayLike, factors: Mapping[str, Sequence[str]]) -> dict[str, float]:
    """Share of the variance of ``effects`` (readings,) that lies between the levels of each factor (eta squared).

    Of a balanced design the shares add up with the rest, "other": interactions of factors, and chance."""
    y = np.asarray(effects, float)
    total = float(((y - y.mean()) ** 2).sum())
    found = {}
    for name, levels in factors.items():
        of = np.asarray(levels)
        between = sum(float((of == level).sum()) * (y[of == level].mean() - y.mean()) ** 2 for level in set(levels))
        found[name] = float(between / total) if total > 0 else 0.0
    found["other"] = max(0.0, 1.0 - sum(found.values()))
    return found
