"""Small decision processes whose answers are known: the toys of papers on when to look, and chains of percepts.

Layouts and numbers are those of the papers' public code and are cited at each; what is ours is said to be. Everything
is exact and pure Python; whatever is random takes its draws as an argument.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from random import Random
from typing import NamedTuple

Matrix = tuple[tuple[float, ...], ...]
MOVES = ((-1, 0), (0, 1), (1, 0), (0, -1))  # of a grid: up, right, down, left, as (rows, columns)


class Step(NamedTuple):
    """Where an action led, what it earned, and whether that is an end."""
    state: int
    reward: float
    ended: bool


@dataclass(frozen=True)
class Grid:
    """A deterministic grid: ``S`` start, ``X`` goal (+1, an end), ``.`` lava (-1, an end), ``o`` floor (0). A step into
    the border stays; an episode has ``most_steps`` at most. States are cells, row by row; actions are those of
    ``MOVES``."""
    rows: tuple[str, ...]
    most_steps: int = 100

    @property
    def cells(self) -> str:
        return "".join(self.rows)

    @property
    def states(self) -> int:
        return len(self.cells)

    @property
    def start(self) -> int:
        return self.cells.index("S")

    def step(self, state: int, action: int) -> Step:
        height, width = len(self.rows), len(self.rows[0])
        y, x = divmod(state, width)
        y = min(height - 1, max(0, y + MOVES[action][0]))
        x = min(width - 1, max(0, x + MOVES[action][1]))
        cell = self.rows[y][x]
        return Step(y * width + x, {"X": 1.0, ".": -1.0}.get(cell, 0.0), cell in "X.")

    def table(self) -> list[list[Step]]:
        """Every step by state and action, for who takes many."""
        return [[self.step(state, action) for action in range(len(MOVES))] for state in range(self.states)]

    def fewest(self, longest: int = 1) -> int | None:
        """The fewest decisions to the goal where each repeats a move up to ``longest`` times (1: the fewest steps).
        None if no way leads there."""
        reached, front, taken = {self.start}, {self.start}, 0
        while front:
            taken, found = taken + 1, set()
            for state in front:
                for action in range(len(MOVES)):
                    at = Step(state, 0.0, False)
                    for _ in range(longest):
                        at = self.step(at.state, action)
                        if at.ended:
                            break
                        found.add(at.state)
                    if at.reward > 0:
                        return taken
            front = found - reached
            reached |= found
        return None


# Biedenkapp et al. 2021 (ICML, PMLR 139:914, appendix D); github.com/automl/TempoRL, README.md and grid_envs.py.
CLIFF = Grid(("So......oX", "oo......oo", "oo......oo", "oooooooooo", "oooooooooo", "oooooooooo"))
BRIDGE = Grid(("So......oX", "oo......oo", "oooooooooo", "oooooooooo", "oo......oo", "oo......oo"))
ZIGZAG = Grid(("So..oooooo", "oo..oooooo", "oo..oo..oo", "oo..oo..oo", "oooooo..oo", "oooooo..oX"))


@dataclass(frozen=True)
class MeasuredChain:
    """A chain in which seeing the state has a price: it begins in state 0 and ends in the last one, every step earns
    ``step_reward`` or, into the end, ``goal_reward``, and a measurement costs ``cost``. Actions: 0 left, 1 right (a
    step beyond the first state stays); ``even_odd``: the other way round in every second state.

    Bellinger, Coles, Crowley & Tamblyn 2021 (Canadian AI); github.com/cbellinger27/CanAI2021_AMRL,
    source/gyms/chain_env/README.md. Without the noise of the even-odd chain."""
    states: int = 11
    goal_reward: float = 1.0
    step_reward: float = -0.01
    cost: float = 0.05
    even_odd: bool = False

    def step(self, state: int, action: int) -> Step:
        right = (action == 1) != (self.even_odd and state % 2 == 1)
        after = state + 1 if right else max(0, state - 1)
        ended = after == self.states - 1
        return Step(after, self.goal_reward if ended else self.step_reward, ended)


CHAIN = MeasuredChain()
EVEN_ODD = MeasuredChain(states=20, goal_reward=300.0, step_reward=-1.0, cost=10.0, even_odd=True)


@dataclass(frozen=True)
class Treatment:
    """A patient seen now and then: ``chances[a][s]`` of the next state under treatment a, ``pays[s]`` of each step that
    begins in s, the last state being death (an end). Who chooses a treatment and for how many of ``delays`` steps pays
    ``cost`` and sees the state at the end of them. ``begin``: chances of the first state; ``horizon``: steps at most.

    Zhou, Huang, Azizzadenesheli, Childers & Lipton 2024 (AISTATS, PMLR 238), the disease simulator;
    github.com/hlzhou/Timing-as-an-Action, gyms/sim_library.py (stronger_tradeoff) and run_disease.sh."""
    chances: tuple[Matrix, ...] = (((0.89, 0.1, 0.01), (0.15, 0.8, 0.05), (0.0, 0.0, 1.0)),
                                   ((0.1, 0.89, 0.01), (0.8, 0.15, 0.05), (0.0, 0.0, 1.0)))
    pays: tuple[float, ...] = (25.0, 5.0, 0.0)
    begin: tuple[float, ...] = (0.8, 0.2, 0.0)
    delays: tuple[int, ...] = tuple(range(1, 11))
    cost: float = 5.0
    discount: float = 0.99
    horizon: int = 50

    @property
    def death(self) -> int:
        return len(self.pays) - 1

    def first(self, draw: Random) -> int:
        return draw.choices(range(len(self.begin)), self.begin)[0]

    def hold(self, state: int, action: int, delay: int, left: int, draw: Random) -> tuple[int, float, int]:
        """(state, discounted reward less the cost, steps) of a treatment for ``delay`` steps or until death, of which
        ``left`` can be."""
        earned, steps = -self.cost, 0
        while steps < min(delay, left) and state != self.death:
            earned += self.discount ** steps * self.pays[state]
            state = draw.choices(range(len(self.pays)), self.chances[action][state])[0]
            steps += 1
        return state, earned, steps


DISEASE = Treatment()

# Ours: percepts that follow each other, for clocks. BINS of them; a clock's PERIODS are those of the paper.
PERIODS, BINS = (1, 4, 8, 12), 6
RING: Matrix = tuple(tuple(float(j == (i + 1) % BINS) for j in range(BINS)) for i in range(BINS))


def _walk() -> Matrix:
    """Stays with 0.8, goes one up or down with 0.1 each, is thrown back at the ends."""
    rows = [[0.0] * BINS for _ in range(BINS)]
    for i, row in enumerate(rows):
        row[i] = 0.8
        row[1 if i == 0 else i - 1] += 0.1
        row[BINS - 2 if i == BINS - 1 else i + 1] += 0.1
    return tuple(map(tuple, rows))


WALK: Matrix = _walk()


def powers(step: Sequence[Sequence[float]], most: int = max(PERIODS)) -> list[list[list[float]]]:
    """step^0 ... step^most."""
    n = len(step)
    found = [[[float(i == j) for j in range(n)] for i in range(n)]]
    for _ in range(most):
        found.append([[sum(row[k] * step[k][j] for k in range(n)) for j in range(n)] for row in found[-1]])
    return found


def earn(period: int, after: int) -> float:
    """The shape of eq 8's reward: long periods and low percepts pay, 0 to 1."""
    return 0.5 * ((period - 1) / (max(PERIODS) - 1) + 1 - after / (BINS - 1))


def optimal(step: Matrix, reward: Callable[[int, int], float], discount: Callable[[int], float], cost: float = 0.0,
            sweeps: int = 2000) -> list[list[float]]:
    """Q*(percept, period) of a clock on a chain of percepts, by value iteration: ``reward(p, x')`` for arriving at x'
    after p cycles, ``discount(p)`` of what comes then."""
    reached = powers(step)
    q = [[0.0] * len(PERIODS) for _ in step]
    for _ in range(sweeps):
        v = [max(row) for row in q]
        new = [[sum(reached[p][x][y] * (reward(p, y) - cost + discount(p) * v[y]) for y in range(len(step)))
                for p in PERIODS] for x in range(len(step))]
        moved = max(abs(a - b) for one, other in zip(q, new, strict=True) for a, b in zip(one, other, strict=True))
        q = new
        if moved < 1e-12:
            break
    return q


# Ours: a ring of three states and a trap, the last state; action 0 stays, 1 goes on, 2 back, 3 falls in from state 2.
TRAP_NEXT = ((0, 1, 2, 0), (1, 2, 0, 1), (2, 0, 1, 3))
TRAP_REWARD = ((0.1, 0.0, 0.3, 0.2), (0.0, 0.9, 0.2, 0.1), (0.3, 0.1, 0.0, -5.0))
