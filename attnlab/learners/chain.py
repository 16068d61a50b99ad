"""A Markov chain of percepts, estimated from looks any number of cycles apart. Shared by learners that plan."""

from __future__ import annotations

from collections.abc import Sequence

Matrix = list[list[float]]
STAY, PRIOR = 0.1, 0.001  # transitions of each percept to itself and to each, as if seen: no chance is ever quite 0
GROWTH = 1.1  # the estimate is renewed when there are this many times the looks there were


def zeros(size: int) -> Matrix:
    """A square matrix of nothing."""
    return [[0.0] * size for _ in range(size)]


def multiply(one: Matrix, other: Matrix, product: Matrix) -> None:
    """The matrix product into ``product``; sums from left to right, so that every Python gives the same bits."""
    for j in range(len(one)):
        column = [row[j] for row in other]
        for i, row in enumerate(one):
            value = 0.0
            for k, x in enumerate(column):
                value += row[k] * x
            product[i][j] = value


def transpose(matrix: Matrix, into: Matrix) -> None:
    """The columns as rows."""
    for i, row in enumerate(matrix):
        for j, value in enumerate(row):
            into[j][i] = value


class Chain:
    """P, the chances of the percepts (and of death, the last state, in which a chain stays) one cycle later.

    ``seen[k][i][j]``: looks at i that were followed by j after the k-th period. :meth:`renew` is one step of
    expectation maximisation of the chance of all that was seen, the percepts between looks being what is not known; a
    period needs no parameters of its own, because its chances are P^p, ``powers[p]``.
    """

    def __init__(self, percepts: int, periods: Sequence[int]):
        self.size, self.death, self.periods = percepts + 1, percepts, list(periods)
        self.seen = [[[0] * self.size for _ in range(self.size)] for _ in periods]
        self.looks, self._due = 0, 1.0
        stay, drift = 0.5, 0.5 / 3
        self.step = [[stay + drift if i == j else drift if abs(i - j) == 1 else 0.0 for j in range(self.size)]
                     for i in range(self.size)]
        self.powers = [[[float(i == j) for j in range(self.size)] for i in range(self.size)]
                       for _ in range(1 + max(periods))]
        self._odds, self._counts, self._share, self._one, self._other = (zeros(self.size) for _ in range(5))
        for row in self.step:
            for j in range(self.size):
                row[j] += 1e-3
        self._ready()

    def add(self, percept: int, cycles: int, after: int) -> bool:
        """A look at ``after`` (``death``: the robot died), ``cycles`` after one at ``percept``. True if it is time to
        renew, which is rarer the more was seen."""
        for k, period in enumerate(self.periods):
            if period == cycles:
                self.seen[k][percept][after] += 1
                self.looks += 1
        return self.looks >= self._due

    def renew(self) -> None:
        """A better P from all that was seen."""
        self._due = self.looks * GROWTH
        for i, row in enumerate(self._counts):
            for j in range(self.size):
                row[j] = STAY + PRIOR if i == j else PRIOR
        for k, period in enumerate(self.periods):
            if self._have_odds(k, self.powers[period]):
                for before in range(period):
                    self._expect(self.powers[before], self.powers[period - 1 - before])
        for i, row in enumerate(self._counts):
            for j, count in enumerate(row):
                self.step[i][j] = count
        self._ready()

    def _have_odds(self, k: int, reached: Matrix) -> bool:
        """How much more often each pair was seen after the k-th period than foreseen; False if none was seen."""
        found = False
        for i, row in enumerate(self.seen[k]):
            for j, n in enumerate(row):
                odd = n / reached[i][j] if n and reached[i][j] > 0 else 0.0
                self._odds[i][j] = odd
                found = found or odd > 0.0
        return found

    def _expect(self, before: Matrix, after: Matrix) -> None:
        """Count each transition as often as it is expected between two looks, that many cycles from both."""
        transpose(before, self._one)
        multiply(self._one, self._odds, self._other)
        transpose(after, self._one)
        multiply(self._other, self._one, self._share)
        for i, row in enumerate(self._share):
            for j, share in enumerate(row):
                self._counts[i][j] += self.step[i][j] * share

    def _ready(self) -> None:
        """Rows that sum to 1, death without return, and the powers of it."""
        for i, row in enumerate(self.step):
            whole = 0.0
            for value in row:
                whole += value
            for j in range(self.size):
                row[j] = row[j] / whole if i < self.death else 1.0 if j == self.death else 0.0
        for p in range(1, len(self.powers)):
            multiply(self.powers[p - 1], self.step, self.powers[p])
