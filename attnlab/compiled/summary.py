"""What is said of an episode when it has ended, from its columns, compiled: what :mod:`attnlab.robot.series` says in
numpy, to the last bit, in one go and without Python. The same for all compositions of parts."""

from __future__ import annotations

from math import inf, isfinite, isnan, pi, sqrt
from typing import Any

import numpy as np

from attnlab.compiled import methods  # noqa: F401  equations are compiled when they are called
from attnlab.equations import safety
from attnlab.kernels.compile import compiled, inner
from attnlab.tables.code import package_hash

ENERGY, WANTING, SAFETY, HELD, PATH, TURN, NEEDS = 0, 3, 4, 7, 10, 11, 12  # places in ``found``; a need has two
SERIES = 6  # rows of scratch
SIGNATURE = ("boolean(float64[:, ::1], int64, float64[:, ::1], int64, float64[:, :, ::1], int64[::1], "
             "float64[:, ::1], float64[:, ::1], float64[:, ::1], int64, float64, float64, boolean, boolean, float64, "
             "int64[:, ::1], int64[:, ::1], float64[:, ::1], float64[::1], float64[:, ::1])")


@inner
def block(values: Any, start: int, n: int) -> float:
    """The sum of at most 128 values: eight sums side by side, and then what is left."""
    if n < 8:
        found = 0.0
        for i in range(start, start + n):
            found += values[i]
        return found
    a, b, c, d, e, f, g, h = (values[start], values[start + 1], values[start + 2], values[start + 3],
                              values[start + 4], values[start + 5], values[start + 6], values[start + 7])
    end = start + n - n % 8
    for i in range(start + 8, end, 8):
        a, b, c, d = a + values[i], b + values[i + 1], c + values[i + 2], d + values[i + 3]
        e, f, g, h = e + values[i + 4], f + values[i + 5], g + values[i + 6], h + values[i + 7]
    found = ((a + b) + (c + d)) + ((e + f) + (g + h))
    for i in range(end, start + n):
        found += values[i]
    return found


@inner
def pairwise(values: Any, n: int) -> float:
    """The sum of n values in the order in which numpy adds them: halves, down to blocks. (numba does not keep functions
    that call themselves.)"""
    todo, sums, depth, held = np.empty((64, 2), np.int64), np.empty(64), 1, 0
    todo[0, 0], todo[0, 1] = 0, n
    while depth > 0:
        depth -= 1
        start, count = todo[depth, 0], todo[depth, 1]
        if count < 0:
            held -= 1
            sums[held - 1] += sums[held]
        elif count <= 128:
            sums[held] = block(values, start, count)
            held += 1
        else:
            half = count // 2 - count // 2 % 8
            todo[depth, 1] = -1  # add both, when they are there
            todo[depth + 1, 0], todo[depth + 1, 1] = start + half, count - half
            todo[depth + 2, 0], todo[depth + 2, 1] = start, half
            depth += 3
    return sums[0]


@inner
def mean_least_most(values: Any, n: int, found: Any, at: int) -> None:
    """Three numbers of a series."""
    least = most = values[0]
    for i in range(1, n):
        value = values[i]
        if value < least or isnan(value):
            least = value
        if value > most or isnan(value):
            most = value
    found[at], found[at + 1], found[at + 2] = pairwise(values, n) / n, least, most


@inner
def fill(values: Any, start: int, end: int, value: float) -> None:
    for i in range(start, end):
        values[i] = value


@inner
def in_order(looks: Any, count: int, column: int, counts: int) -> float:
    """The sum of a column from the first look to the last, of those whose column ``counts`` is a number."""
    found, first = 0.0, True
    for i in range(count):
        if not isnan(looks[i, counts]):
            found, first = looks[i, column] if first else found + looks[i, column], False
    return found


@inner
def log_is_fine(looks: Any, count: int, end: int, bounds: Any) -> bool:
    """What :func:`attnlab.robot.guards.check_log` and :func:`attnlab.robot.identities.check_clock` ask."""
    low, high, levels, slack = bounds[0], bounds[1], bounds[2], 1e-9
    for i in range(count):
        cycle, sigma, level, period = looks[i, 0], looks[i, 1], looks[i, 3], looks[i, 4]
        wanting, liking = looks[i, 5], looks[i, 6]
        if not (low <= sigma <= high and -slack <= wanting <= 1.0 + slack and -slack <= liking <= 1.0 + slack
                and 0 <= level < levels and (i == 0 or isfinite(looks[i, 8]))):
            return False
        if cycle + period != looks[i + 1, 0] if i + 1 < count else not cycle < end <= cycle + period:
            return False
    return count > 0 and looks[0, 0] == 0.0


@inner
def balances(moments: Any, count: int, needs: Any, e_u: float, e_nb: float) -> bool:
    """What :func:`attnlab.robot.identities.check_balance` asks."""
    growth, before = 0.0, 0.0
    for k in range(len(needs)):
        growth += needs[k, 2] * needs[k, 3]
    for j in range(count):
        now = 0.0
        for k in range(len(needs)):
            if needs[k, 3] != 0.0:
                now += moments[j, 3 + k]
        now += moments[j, 2]
        if j > 0:
            expected = -e_u * (moments[j, 0] - moments[j - 1, 0]) + (growth - e_nb) * moments[j, 1]
            if not abs(now - before - expected) <= 0.9e-6 + 0.9e-9 * abs(expected):  # a little stricter: who is asked
                return False                                                         # then decides
        before = now
    return True


def _summary(code: str) -> Any:
    """The function, of this code: numba looks at its own file alone to see whether what it keeps is old."""
    def summary(trace, n, moments, m, looks, rows, needs, boxes, bounds, guard, e_u, e_nb, balanced, check, cell_m,
                visits, fell, scratch, found, acts):
        if check:
            for a in range(len(rows)):
                if not log_is_fine(looks[a], rows[a], n, bounds[a]):
                    return False
            if balanced and not balances(moments, m, needs, e_u, e_nb):
                return False
        energy, wanting, safe = scratch[0], scratch[1], scratch[2]
        held, steps, turns = scratch[3], scratch[4], scratch[5]
        for i in range(n):
            dx, dy = trace[i + 1, 0] - trace[i, 0], trace[i + 1, 1] - trace[i, 1]
            steps[i] = sqrt(dx * dx + dy * dy)
            turns[i] = abs((trace[i + 1, 2] - trace[i, 2] + pi) % (2 * pi) - pi)
            x = min(max(int(trace[i + 1, 0] / cell_m), 0), visits.shape[0] - 1)
            y = min(max(int(trace[i + 1, 1] / cell_m), 0), visits.shape[1] - 1)
            visits[x, y] += 1
        found[PATH], found[TURN] = pairwise(steps, n), pairwise(turns, n)
        for j in range(1, m):
            end = int(moments[j, 0])
            for i in range(int(moments[j - 1, 0]), end):
                energy[i] = moments[j, 2] + e_u * (end - i - 1)
        mean_least_most(energy, n, found, ENERGY)
        for a in range(len(rows)):
            for row in range(rows[a]):
                begins, ends = int(looks[a, row, 0]), int(looks[a, row + 1, 0]) if row + 1 < rows[a] else n
                if a == 0:
                    fill(wanting, begins, ends, looks[a, row, 5])
                if a == guard:
                    period, high, shortest, longest = looks[a, row, 4], bounds[a, 3], bounds[a, 4], bounds[a, 5]
                    fill(held, begins, ends, safety(looks[a, row, 1], high, period, shortest, longest))
                    fill(safe, begins, ends, safety(1.0, 1.0, period, shortest, longest))
            log, count, released = looks[a], rows[a], 0
            for row in range(count):
                released += log[row, 7] != 0.0
            acts[a, 0], acts[a, 1] = count, released
            acts[a, 2], acts[a, 3] = in_order(log, count, 8, 8), in_order(log, count, 9, 8)
            acts[a, 4], acts[a, 5] = in_order(log, count, 6, 0) / count, in_order(log, count, 4, 0) / count
        found[WANTING] = pairwise(wanting, n) / n
        if guard >= 0:
            high = bounds[guard, 3]
            for i in range(n):
                nearest = inf
                for b in range(len(boxes)):
                    c, s = boxes[b, 2], boxes[b, 3]
                    dx, dy = trace[i + 1, 0] - boxes[b, 0], trace[i + 1, 1] - boxes[b, 1]
                    along = max(abs(c * dx + s * dy) - boxes[b, 4], 0.0)
                    across = max(abs(-s * dx + c * dy) - boxes[b, 5], 0.0)
                    nearest = min(nearest, along * along + across * across)
                safe[i] = min(sqrt(nearest), high) / high * safe[i]
            mean_least_most(safe, n, found, SAFETY)
            mean_least_most(held, n, found, HELD)
        for k in range(len(needs)):
            before, falls, need = needs[k, 1], 0, scratch[0]
            for j in range(1, m):
                end = int(moments[j, 0])
                for i in range(int(moments[j - 1, 0]), end):
                    need[i] = moments[j, 3 + k] - needs[k, 0] * (end - i - 1)
            for i in range(n):
                if need[i] - before < 0:
                    fell[k, 1 + falls] = i
                    falls += 1
                before = need[i]
            fell[k, 0] = falls
            mean_least_most(need, n, steps, 0)
            found[NEEDS + 2 * k], found[NEEDS + 2 * k + 1] = steps[0], steps[2]
        return code != ""
    return summary


summary = compiled(SIGNATURE, nogil=True)(_summary(package_hash()))
