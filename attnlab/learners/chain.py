"""A Markov chain of percepts, estimated from looks any number of cycles apart. Shared by learners that plan."""

from __future__ import annotations

from collections.abc import Sequence

Matrix = list[list[float]]
STAY, PRIOR = 0.1, 0.001  # transitions of each percept to itself and to each, as if seen: no chance is ever quite 0
GROWTH = 1.1  # the estimate is renewed when there are this many times the looks there were


def product(one: Matrix, other: Matrix) -> Matrix:
    """The matrix product; sums from left to right, so that every Python gives the same bits."""
    columns = list(zip(*other, strict=True))
    found = []
    for row in one:
        new = []
        for column in columns:
            value = 0.0
            for a, b in zip(row, column, strict=True):
                value += a * b
            new.append(value)
        found.append(new)
    return found


class Chain:
    """P, the chances of the percepts (and of death, the last state, in which a chain stays) one cycle later.

    ``seen[p][i][j]``: looks at i that were followed by j after p cycles. :meth:`renew` is one step of expectation
    maximisation of the chance of all that was seen, the percepts between looks being what is not known; a period needs
    no parameters of its own, because its chances are P^p.
    """

    def __init__(self, percepts: int, periods: Sequence[int]):
        self.size = percepts + 1
        self.seen = {p: [[0] * self.size for _ in range(self.size)] for p in periods}
        self.looks, self._due = 0, 1.0
        stay, drift = 0.5, 0.5 / 3
        self.step = [[stay + drift if i == j else drift if abs(i - j) == 1 else 0.0 for j in range(self.size)]
                     for i in range(self.size)]
        self.step = [self._normal([x + 1e-3 for x in row], i) for i, row in enumerate(self.step)]
        self.powers = self._powers()

    def add(self, percept: int, cycles: int, after: int | None) -> bool:
        """A look at ``after`` (None: the robot died), ``cycles`` after one at ``percept``. True if it is time to
        renew, which is rarer the more was seen."""
        if cycles in self.seen:
            self.seen[cycles][percept][self.size - 1 if after is None else after] += 1
            self.looks += 1
        return self.looks >= self._due

    def renew(self) -> None:
        """A better P from all that was seen."""
        self._due = self.looks * GROWTH
        counts = [[STAY + PRIOR if i == j else PRIOR for j in range(self.size)] for i in range(self.size)]
        for p, seen in self.seen.items():
            reached = self.powers[p]
            odds = [[n / reached[i][j] if n and reached[i][j] > 0 else 0.0 for j, n in enumerate(row)]
                    for i, row in enumerate(seen)]
            if not any(map(any, odds)):
                continue
            for k in range(p):
                before = [list(column) for column in zip(*self.powers[k], strict=True)]
                after = [list(column) for column in zip(*self.powers[p - 1 - k], strict=True)]
                share = product(product(before, odds), after)
                for i in range(self.size):
                    for j in range(self.size):
                        counts[i][j] += self.step[i][j] * share[i][j]
        self.step = [self._normal(row, i) for i, row in enumerate(counts)]
        self.powers = self._powers()

    def _normal(self, row: list[float], i: int) -> list[float]:
        if i == self.size - 1:
            return [0.0] * i + [1.0]
        total = 0.0
        for value in row:
            total += value
        return [value / total for value in row]

    def _powers(self) -> list[Matrix]:
        """P^0 to P^(longest period)."""
        found: list[Matrix] = [[[float(i == j) for j in range(self.size)] for i in range(self.size)]]
        for _ in range(max(self.seen)):
            found.append(product(found[-1], self.step))
        return found
