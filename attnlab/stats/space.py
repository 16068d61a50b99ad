"""Where a robot has been: coverage, evenness of visits."""

from __future__ import annotations

from math import log

import numpy as np
import numpy.typing as npt


def coverage(x_cells: npt.ArrayLike, y_cells: npt.ArrayLike, shape: tuple[int, int]) -> float:
    """Share of the ``shape`` = (cells along x, cells along y) floor whose cells were visited by the centre (0-1)."""
    return float(np.unique(np.asarray(x_cells) * shape[1] + np.asarray(y_cells)).size / (shape[0] * shape[1]))


def footprint_cells(visits: npt.ArrayLike, radius_m: float, cell_m: float) -> npt.NDArray[np.bool_]:
    """Cells touched by a round footprint of ``radius_m`` around the visited cells' middles; booleans like ``visits``
    of shape (cells along x, cells along y)."""
    reach = int(np.ceil(radius_m / cell_m))
    around = range(-reach, reach + 1)
    visited: npt.NDArray[np.bool_] = np.pad(np.asarray(visits) > 0, reach)
    nx, ny = np.shape(visits)
    touched = np.zeros((nx, ny), bool)
    for i, j in ((i, j) for i in around for j in around if (i * i + j * j) ** 0.5 * cell_m <= radius_m + 1e-9):
        touched |= visited[reach + i:reach + i + nx, reach + j:reach + j + ny]
    return touched


def entropy_bits(visits: npt.ArrayLike) -> float:
    """Shannon entropy of a visit map in bits: log2(n) if n cells are visited equally often, 0 if only one is."""
    from scipy.special import entr
    counts = np.asarray(visits, float).ravel()
    return float(entr(counts / counts.sum()).sum() / log(2)) if counts.sum() > 0 else float("nan")


def gini(visits: npt.ArrayLike) -> float:
    """Gini coefficient of visits over all cells given, unvisited ones too: 0 if all are equal, towards 1 if one has
    everything."""
    counts = np.sort(np.asarray(visits, float).ravel())
    n, total = counts.size, counts.sum()
    if total <= 0:
        return float("nan")
    return float(2 * (np.arange(1, n + 1) * counts).sum() / (n * total) - (n + 1) / n)
