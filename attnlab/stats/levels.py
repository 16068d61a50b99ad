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


def _contrast(distance: Floats, level: Ints, seeds: int) -> Floats:
    """For each seed: mean distance of its tables to other seeds' tables of other levels, less that of the same level.

    ``distance``: (seeds * levels, same), ``level``: the level of each table.
    """
    of_seed = np.repeat(np.arange(seeds), len(level) // seeds)
    others = of_seed[:, None] != of_seed[None, :]
    same = level[:, None] == level[None, :]
    usable = others & ~np.isnan(distance)
    filled = np.where(usable, distance, 0.0)
    values = np.full(seeds, np.nan)
    for seed in range(seeds):
        mine = of_seed == seed
        between, within = (usable & ~same)[mine], (usable & same)[mine]
        if between.any() and within.any():
            values[seed] = filled[mine][between].mean() - filled[mine][within].mean()
    return values


def level_contrast(tables: Ints) -> Floats:
    """Between-level less within-level distance of each seed, shape (seeds,), from ``tables`` (seeds, levels, cells)."""
    seeds, levels, cells = tables.shape
    return _contrast(distances(tables.reshape(seeds * levels, cells)), np.tile(np.arange(levels), seeds), seeds)


def level_null(tables: Ints, draws: int = 1000, seed: int = 0) -> Floats:
    """Means of :func:`level_contrast` over seeds with the levels of every seed exchanged at random, shape (draws,)."""
    seeds, levels, cells = tables.shape
    distance = distances(tables.reshape(seeds * levels, cells))
    rng = np.random.default_rng(seed)
    orders = rng.permuted(np.tile(np.arange(levels), (draws, seeds, 1)), axis=2).reshape(draws, -1)
    return np.array([np.nanmean(_contrast(distance, order, seeds)) for order in orders])
