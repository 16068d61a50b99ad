"""What is measured along episodes and along cycles: convergence, overlap of activations."""

from __future__ import annotations

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

    ``episodes``: one number each. inf if that never happens; nan for no episodes.
    """
    values = np.asarray(episodes, float)
    if not values.size:
        return float("nan")
    below = np.flatnonzero(block_means(values, block) < level)
    if not below.size:
        return 0.0
    reached = float((below[-1] + 1) * block)
    return reached if reached < values.size else float("inf")


def overlap_ratio(activations: float, active_cycles: float) -> float:
    """(sum - union) / sum: the share of activations that fall into a cycle in which somebody else was active before
    them. 0 if no two coincide. nan without activations."""
    return (activations - active_cycles) / activations if activations else float("nan")


def chance_overlap(activations: npt.ArrayLike, cycles: float) -> float:
    """Overlap ratio expected of trains with these ``activations`` (n,) in ``cycles``, each turned around the episode by
    its own random amount, which keeps its rhythm and destroys its timing against the others.

    A cycle then holds train b with chance a_b / n, whatever the others do: the union is n (1 - prod(1 - a_b / n)).
    """
    acts = np.asarray(activations, float)
    return overlap_ratio(float(acts.sum()), float(cycles * (1 - np.prod(1 - acts / cycles))))
