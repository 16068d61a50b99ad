"""Sums and lengths that are the same bits on every Python and in compiled code.

The builtin ``sum`` of floats compensates from Python 3.12 on, and ``math.hypot`` and ``math.dist`` have algorithms of
their own in CPython: what reaches a table uses these instead.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import sqrt


def total(values: Iterable[float]) -> float:
    """The sum from left to right, each step rounded; 0.0 of nothing."""
    found = 0.0
    for value in values:
        found += value
    return found


def length(x: float, y: float) -> float:
    """Of the vector (x, y). Lengths here are metres, so that no square overflows."""
    return sqrt(x * x + y * y)


def distance(one: Sequence[float], other: Sequence[float]) -> float:
    """Between two points of as many coordinates."""
    found = 0.0
    for i, a in enumerate(one):
        found += (a - other[i]) * (a - other[i])
    return sqrt(found)
