"""TempoRL on the grids of its paper."""

from __future__ import annotations

from collections.abc import Sequence
from random import Random

from attnlab.learners.tempo_rl import TempoTables
from attnlab.testing.processes import Grid, Step

ALPHA, DISCOUNT = 0.5, 0.99  # as in run_tabular_experiments.py of automl/TempoRL
SKIPS = (1, 2, 3, 4, 5, 6, 7)


def best(values: list[float], draw: Random) -> int:
    """The index of the largest, ties broken at random."""
    top = max(values)
    if values.count(top) == 1:
        return values.index(top)
    return draw.choice([i for i, value in enumerate(values) if value == top])


def schedule(kind: str, episode: int, episodes: int) -> float:
    """Epsilon of an episode: ``constant`` 0.1, or ``linear`` from 1 to 0."""
    return 0.1 if kind == "constant" else 1.0 - episode / max(1, episodes - 1)


def play_grid(grid: Grid, seed: int, episodes: int, skips: Sequence[int] = SKIPS, kind: str = "constant"
              ) -> dict[str, float]:
    """``area``: the mean over episodes of (return + 1) / 2 of the greedy policy after each, which they call normalised
    area under the reward curve; ``decisions``: the mean of how many it took. skips=(1,) is Q-learning."""
    draw, steps = Random(seed), grid.table()
    tables = TempoTables(grid.states, len(steps[0]), skips, ALPHA, DISCOUNT)
    area, decided = 0.0, 0
    for episode in range(episodes):
        _learn(grid, steps, tables, schedule(kind, episode, episodes), draw)
        earned, decisions = greedy(grid, steps, tables, draw)
        area += (earned + 1) / 2
        decided += decisions
    return {"area": area / episodes, "decisions": decided / episodes}


def _learn(grid: Grid, steps: list[list[Step]], tables: TempoTables, epsilon: float, draw: Random) -> None:
    """One epsilon-greedy episode. One that is cut off after ``most_steps`` is no end: what was reached keeps its
    value."""
    state, ended, taken, skips = grid.start, False, 0, tables.skips
    while not ended and taken < grid.most_steps:
        row = tables.behaviour[state]
        action = draw.randrange(len(row)) if draw.random() < epsilon else best(row, draw)
        j = draw.randrange(len(skips)) if draw.random() < epsilon else best(tables.skip[state][action], draw)
        path: list[int] = [state]
        rewards: list[float] = []
        while len(rewards) < skips[j] and not ended and taken < grid.most_steps:
            state, reward, ended = steps[state][action]
            path.append(state)
            rewards.append(reward)
            taken += 1
        tables.path(path, action, rewards, ended)


def greedy(grid: Grid, steps: list[list[Step]], tables: TempoTables, draw: Random) -> tuple[float, int]:
    """(return, decisions) of the greedy policy; of equal skips the longest, as in their evaluation."""
    state, ended, taken, decisions, earned = grid.start, False, 0, 0, 0.0
    while not ended and taken < grid.most_steps:
        action = best(tables.behaviour[state], draw)
        values = tables.skip[state][action]
        top = max(values)
        length = max(skip for skip, value in zip(tables.skips, values, strict=True) if value == top)
        decisions += 1
        while length and not ended and taken < grid.most_steps:
            state, reward, ended = steps[state][action]
            earned, taken, length = earned + reward, taken + 1, length - 1
    return earned, decisions
