"""Timing as an action on the disease simulator of its paper."""

from __future__ import annotations

from random import Random
from typing import Protocol

from attnlab.learners.chain import Chain, Matrix, zeros
from attnlab.testing.processes import Treatment, powers

EPSILON, SWEEPS = 0.1, 50  # as in configs.py and run_disease.sh of Timing-as-an-Action
LAST = 20  # episodes that tell what was learned; the paper's code reports the last one


class Model(Protocol):
    """Where treatments lead: an estimate for every delay."""

    def saw(self, state: int, action: int, delay: int, after: int) -> None: ...

    def renew(self) -> None: ...

    def after(self, action: int, delay: int) -> Matrix:
        """Chances of the state after so many steps; rows are states."""


class OneStep:
    """One matrix a treatment, from looks of all delays together: the chain of ``learner=timing``."""

    def __init__(self, process: Treatment):
        self._chains = [Chain(process.death, process.delays) for _ in process.chances]
        self._due = [False] * len(self._chains)

    def saw(self, state: int, action: int, delay: int, after: int) -> None:
        self._due[action] = self._chains[action].add(state, delay, after) or self._due[action]

    def renew(self) -> None:
        for action, due in enumerate(self._due):
            if due:
                self._chains[action].renew()
                self._due[action] = False

    def after(self, action: int, delay: int) -> Matrix:
        return self._chains[action].powers[delay]


class EachDelay:
    """The rival: a matrix for every treatment and delay, by counts; a row of which nothing was seen is uniform."""

    def __init__(self, process: Treatment):
        self._n, self._death = len(process.pays), process.death
        self._seen = [[zeros(self._n) for _ in range(max(process.delays) + 1)] for _ in process.chances]

    def saw(self, state: int, action: int, delay: int, after: int) -> None:
        self._seen[action][delay][state][after] += 1.0

    def renew(self) -> None:
        """Counts are what they are."""

    def after(self, action: int, delay: int) -> Matrix:
        if delay == 0:
            return powers(zeros(self._n), 0)[0]
        rows = []
        for state, row in enumerate(self._seen[action][delay]):
            whole = sum(row)
            rows.append([float(j == self._death) for j in range(self._n)] if state == self._death else
                        [n / whole for n in row] if whole else [1 / self._n] * self._n)
        return rows


Table = list[list[list[float]]]  # by state, treatment, place of the delay


def play_patients(process: Treatment, seed: int, episodes: int, way: str) -> dict[str, float]:
    """``way``: ``one_step`` and ``each_delay`` plan from what they estimate, ``model_free`` learns from what it earned
    by replaying all it saw, as theirs does. All are epsilon-greedy and think anew before every episode.

    ``return``: the mean discounted return of the last ``LAST`` training episodes; ``return_all``: of all; ``error``:
    of a model, how much its chances are off after every delay (the sum of absolute differences of a row, its mean
    over states, treatments and delays). What a state pays is known to the planners (ours: theirs fit it)."""
    draw = Random(seed)
    model: Model | None = OneStep(process) if way == "one_step" else EachDelay(process) if way == "each_delay" else None
    q: Table = [[[0.0] * len(process.delays) for _ in process.chances] for _ in process.pays]
    seen: list[tuple[int, int, int, float, int]] = []  # state, treatment, delay, earned, after
    returns = []
    for _ in range(episodes):
        if model is None:
            _replay(process, q, seen)
        else:
            model.renew()
            _plan(process, q, model)
        state, t, total = process.first(draw), 0, 0.0
        while state != process.death and t < process.horizon:
            action, i = _choose(q[state], draw)
            after, earned, steps = process.hold(state, action, process.delays[i], process.horizon - t, draw)
            seen.append((state, action, steps, earned, after))
            if model is not None:
                model.saw(state, action, steps, after)
            total += process.discount ** t * earned
            state, t = after, t + steps
        returns.append(total)
    told = {"return": sum(returns[-LAST:]) / len(returns[-LAST:]), "return_all": sum(returns) / len(returns)}
    return told if model is None else {**told, "error": _off(process, model)}


def _choose(values: list[list[float]], draw: Random) -> tuple[int, int]:
    """(treatment, place of the delay), epsilon-greedy, ties at random."""
    if draw.random() < EPSILON:
        return draw.randrange(len(values)), draw.randrange(len(values[0]))
    top = max(map(max, values))
    return draw.choice([(a, i) for a, row in enumerate(values) for i, value in enumerate(row) if value == top])


def _replay(process: Treatment, q: Table, seen: list[tuple[int, int, int, float, int]]) -> None:
    """Q of what was seen, in its order, is what it earned and what is thought of where it led."""
    for state, action, steps, earned, after in seen:
        best = max(map(max, q[after]))
        q[state][action][process.delays.index(steps)] = earned + process.discount ** steps * best


def _plan(process: Treatment, q: Table, model: Model) -> None:
    """Q(s,a,d) = -cost + sum_{k<d} gamma^k E[pay of the state k steps on] + gamma^d E[max Q of the one d steps on], by
    sweeps of value iteration; 0 in death."""
    g, living = process.discount, range(process.death)
    cases = []
    for action in range(len(process.chances)):
        paid = [-process.cost] * process.death
        for i, delay in enumerate(process.delays):
            before, reached = model.after(action, delay - 1), model.after(action, delay)
            paid = [paid[s] + g ** (delay - 1) * sum(c * pay for c, pay in zip(before[s], process.pays, strict=True))
                    for s in living]
            cases.append((action, i, list(paid), g ** delay, reached))
    for _ in range(SWEEPS):
        best = [max(map(max, rows)) for rows in q]
        for action, i, paid, later, reached in cases:
            for s in living:
                q[s][action][i] = paid[s] + later * sum(c * v for c, v in zip(reached[s], best, strict=True))


def _off(process: Treatment, model: Model) -> float:
    """The mean over living states, treatments and delays of the sum of absolute differences to the truth."""
    off = []
    for action, chances in enumerate(process.chances):
        truth = powers(chances, max(process.delays))
        for delay in process.delays:
            found = model.after(action, delay)
            off += [sum(abs(a - b) for a, b in zip(found[s], truth[delay][s], strict=True))
                    for s in range(process.death)]
    return sum(off) / len(off)
