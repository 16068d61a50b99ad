"""Tails and quantiles that decide: Student's t, the normal, the fair coin.

The first two are scipy.special's, number for number what scipy.stats makes of them without the second that its import
takes; the coin is counted.
"""

from __future__ import annotations

from functools import lru_cache
from itertools import accumulate
from math import comb
from typing import Any

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]


def t_above(x: npt.ArrayLike, freedom: npt.ArrayLike) -> Any:
    """P(T > x) of Student's t."""
    from scipy.special import stdtr
    return stdtr(freedom, -np.asarray(x, float))


def t_quantile(p: float, freedom: npt.ArrayLike) -> Any:
    """x with P(T < x) = p."""
    from scipy.special import stdtrit
    return stdtrit(freedom, p)


def normal_below(x: npt.ArrayLike) -> Any:
    """P(Z < x) of the standard normal."""
    from scipy.special import ndtr
    return ndtr(x)


def normal_quantile(p: npt.ArrayLike) -> Any:
    """x with P(Z < x) = p."""
    from scipy.special import ndtri
    return ndtri(p)


@lru_cache(maxsize=1024)
def coin(n: int) -> Floats:
    """P(at most k heads in n tosses of a fair coin) for k = 0..n, shape (n + 1,), each rounded once."""
    return np.array([below / 2 ** n for below in accumulate(comb(n, k) for k in range(n + 1))])
