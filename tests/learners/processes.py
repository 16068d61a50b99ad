"""Small decision processes whose answers are known: clocks on chains of percepts, the grids of TempoRL's paper."""

from __future__ import annotations

from random import Random

from attnlab.testing import make

PERIODS, BINS = [1, 4, 8, 12], 6


def powers(step: list[list[float]], most: int = 12) -> list[list[list[float]]]:
    """step^0 ... step^most, by hand."""
    n = len(step)
    found = [[[float(i == j) for j in range(n)] for i in range(n)]]
    for _ in range(most):
        found.append([[sum(row[k] * step[k][j] for k in range(n)) for j in range(n)] for row in found[-1]])
    return found


RING = [[float(j == (i + 1) % BINS) for j in range(BINS)] for i in range(BINS)]  # a percept on, every cycle
WALK = [[0.0] * BINS for _ in range(BINS)]  # stays with 0.8, goes one up or down with 0.1, is thrown back at the ends
for _i in range(BINS):
    WALK[_i][_i] = 0.8
    WALK[_i][1 if _i == 0 else _i - 1] += 0.1
    WALK[_i][BINS - 2 if _i == BINS - 1 else _i + 1] += 0.1


def earn(period: int, after: int) -> float:
    """Eq 8's shape: long periods and low percepts pay."""
    return 0.5 * ((period - 1) / 11 + 1 - after / 5)


def optimal(step, reward, discount, cost=0.0):
    """Q*(percept, period) by value iteration: ``reward(p, x')``, ``discount(p)``."""
    reached = powers(step)
    q = [[0.0] * len(PERIODS) for _ in range(BINS)]
    for _ in range(2000):
        v = [max(row) for row in q]
        q = [[sum(reached[p][x][y] * (reward(p, y) - cost + discount(p) * v[y]) for y in range(BINS)) for p in PERIODS]
             for x in range(BINS)]
    return q


def drive(learner, step, reward, looks, seed=0, choose=None):
    """A clock on a chain of percepts for so many looks; periods at random unless ``choose(state)`` says otherwise."""
    draw = Random(seed)
    percept, action = 0, 0
    state = action * BINS + percept
    for _ in range(looks):
        action = draw.randrange(4) if choose is None else choose(state)
        path = [percept]
        for _ in range(PERIODS[action]):
            path.append(draw.choices(range(BINS), step[path[-1]])[0])
        after = action * BINS + path[-1]
        if learner.needs_between:
            learner.watched([state, *(action * BINS + x for x in path[1:])], [reward(1, x) for x in path[1:]], False)
        else:
            learner.update(state, action, reward(PERIODS[action], path[-1]), after, -1, PERIODS[action])
        percept, state = path[-1], after
    return learner


def clock(name, **settings):
    return make("learner", name, levels=("none",), **settings)


# S start, X goal (+1), . lava (-1): the grids of automl/TempoRL.
CLIFF = ("So......oX", "oo......oo", "oo......oo", "oooooooooo", "oooooooooo", "oooooooooo")
BRIDGE = ("So......oX", "oo......oo", "oooooooooo", "oooooooooo", "oo......oo", "oo......oo")
MOVES = ((-1, 0), (0, 1), (1, 0), (0, -1))


class Grid:
    """100 steps at most; a step into the border stays."""

    def __init__(self, rows):
        self.cells = "".join(rows)
        self.rows, self.columns = len(rows), len(rows[0])
        self.start = self.cells.index("S")

    def step(self, state, action):
        """(next state, reward, ended)."""
        y, x = divmod(state, self.columns)
        y = min(self.rows - 1, max(0, y + MOVES[action][0]))
        x = min(self.columns - 1, max(0, x + MOVES[action][1]))
        cell = self.cells[y * self.columns + x]
        return y * self.columns + x, {"X": 1.0, ".": -1.0}.get(cell, 0.0), cell in "X."


def best(values, draw):
    """The index of the largest, ties broken at random."""
    top = max(values)
    return draw.choice([i for i, value in enumerate(values) if value == top])


def learn_grid(grid, tables, episodes, seed, skips=(1, 2, 3, 4, 5, 6, 7), epsilon=0.1):
    """Epsilon-greedy with ``epsilon`` throughout, as in their runs "0.1-const". Returns (mean return of the greedy
    policy after every tenth episode, steps and decisions of the greedy policy at the end); skips=(1,) is plain
    Q-learning."""
    draw, returns = Random(seed), []
    for episode in range(episodes):
        state, ended, taken = grid.start, False, 0
        while not ended and taken < 100:
            action = draw.randrange(4) if draw.random() < epsilon else best(tables.behaviour[state], draw)
            j = draw.randrange(len(skips)) if draw.random() < epsilon else best(tables.skip[state][action], draw)
            path, rewards = [state], []
            while len(rewards) < skips[j] and not ended and taken < 100:
                state, reward, ended = grid.step(state, action)
                path.append(state)
                rewards.append(reward)
                taken += 1
            tables.path(path, action, rewards, ended)
        if episode % 10 == 9:
            returns.append(greedy(grid, tables, skips, draw)[2])
    steps, decisions, _ = greedy(grid, tables, skips, draw)
    return sum(returns) / len(returns), steps, decisions


def greedy(grid, tables, skips, draw):
    """(steps, decisions, return) of the greedy policy; of equal skips the longest, as in the paper's evaluation."""
    state, ended, taken, decisions, earned = grid.start, False, 0, 0, 0.0
    while not ended and taken < 100:
        row = tables.behaviour[state]
        action = best(row, draw)
        of_it = tables.skip[state][action]
        j = max(i for i, value in enumerate(of_it) if value == max(of_it))
        decisions += 1
        for _ in range(skips[j]):
            state, reward, ended = grid.step(state, action)
            taken, earned = taken + 1, earned + reward
            if ended or taken >= 100:
                break
    return taken, decisions, earned
