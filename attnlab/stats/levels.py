"""A permutation test on tables of choices: do the levels of a factor differ more than the seeds of one level?"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]


def distances(tables: Ints) -> Floats:
    """Share of cells that differ between any two of ``tables`` (n, cells), of the cells both have (not 0): (n, n),
    nan where they share no cell."""
    known = tables != 0
    both = known[:, None, :] & known[None, :, :]
    differ = both & (tables[:, None, :] != tables[None, :, :])
    count = both.sum(axis=2)
    with np.errstate(invalid="ignore", divide="ignore"):
        shares: Floats = differ.sum(axis=2) / count
    return shares


def _contrasts(distance: Floats, levels: Ints, seeds: int) -> Floats:
    """For each seed: mean distance of its tables to other seeds' tables of other levels, less that of the same level;
    nan for a seed without either. Shape (draws, seeds).

    ``distance``: (seeds * levels, same), ``levels`` (draws, seeds * levels): the level of each table in each draw.
    """
    of_seed = np.repeat(np.arange(seeds), distance.shape[0] // seeds)
    usable = (of_seed[:, None] != of_seed[None, :]) & ~np.isnan(distance)
    filled = np.where(usable, distance, 0.0)

    def within(amounts: Floats) -> Floats:
        """Amounts between a seed's tables and those of others of the same level."""
        total = np.zeros(levels.shape)
        for level in np.unique(levels):
            mine = (levels == level).astype(float)
            total += mine * (mine @ amounts)
        summed: Floats = total.reshape(len(levels), seeds, -1).sum(axis=2)
        return summed
    counts = usable.astype(float)
    same, number = within(filled), within(counts)
    all_same, all_number = (a.sum(axis=1).reshape(seeds, -1).sum(axis=1) for a in (filled, counts))
    with np.errstate(invalid="ignore", divide="ignore"):
        contrasts: Floats = (all_same - same) / (all_number - number) - same / number
    return contrasts


def level_contrast(tables: Ints) -> Floats:
    """Between-level less within-level distance of each seed, shape (seeds,), from ``tables`` (seeds, levels, cells)."""
    seeds, levels, cells = tables.shape
    distance = distances(tables.reshape(seeds * levels, cells))
    found: npt.NDArray[np.float64] = _contrasts(distance, np.tile(np.arange(levels), seeds)[None, :], seeds)[0]
    return found


def level_null(tables: Ints, draws: int = 1000, seed: int = 0) -> Floats:
    """Means of :func:`level_contrast` over seeds with the levels of every seed exchanged at random, shape (draws,)."""
    seeds, levels, cells = tables.shape
    distance = distances(tables.reshape(seeds * levels, cells))
    rng = np.random.default_rng(seed)
    orders = rng.permuted(np.tile(np.arange(levels), (draws, seeds, 1)), axis=2).reshape(draws, -1)
    found: npt.NDArray[np.float64] = np.nanmean(_contrasts(distance, orders, seeds), axis=1)
    return found
