"""The two simulators in closed loop: the same runs from the same seeds, and policies that change simulators."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable
from itertools import combinations
from random import Random
from typing import Any

import numpy as np

from attnlab.robot.episodes import play_run
from attnlab.robot.plan import RunPlan

Tables = dict[str, dict[str, list[Any]]]
Counts = Counter[Any]  # of bins
DIVERGED_M = 0.001
MOST_SPLITS = 2000


def run(config: dict[str, Any], tick: Callable[[], None]) -> Tables:
    """The tables of a run."""
    return play_run(RunPlan(config), progress=lambda *_: tick())[0]


def survival(tables: Tables, phase: str = "validation") -> list[float]:
    """Survival of each episode of a phase, 0-1."""
    episodes = tables["episodes"]
    return [s for s, p in zip(episodes["survival"], episodes["phase"], strict=True) if p == phase]


def divergence(one: Tables, two: Tables) -> dict[str, Any]:
    """Paired episodes of two runs with all cycles recorded: how far apart the robots get while both live.

    ``identical``: episodes of the same length whose paths differ by no more than DIVERGED_M; ``first``: how many come
    before the first that does not.
    """
    gaps, same = [], []
    for (a, length_a), (b, length_b) in zip(_paths(one), _paths(two), strict=True):
        n = min(length_a, length_b)
        gap = np.hypot(*(a[:n] - b[:n]).T).max()
        gaps.append(float(gap))
        same.append(bool(length_a == length_b and gap <= DIVERGED_M))
    return {"episodes": len(same), "identical": sum(same), "first": same.index(False) if False in same else len(same),
            "gaps_m": gaps}


def _paths(tables: Tables) -> Iterable[tuple[np.ndarray, int]]:
    cycles = tables["cycles"]
    places, start = np.column_stack([cycles["x_m"], cycles["y_m"]]), 0
    for n in tables["episodes"]["cycles"]:
        yield places[start:start + n], n
        start += n


def counts(tables: Tables, behaviours: Iterable[str]) -> dict[str, Counts]:
    """How often each percept and each period came up at an activation, and each cause of death, over all episodes."""
    cycles, found = tables["cycles"], {"deaths": Counter(tables["episodes"]["death"])}
    for what in ("percept", "period"):
        for behaviour in behaviours:
            active = zip(cycles[f"{behaviour}_active"], cycles[f"{behaviour}_{what}"], strict=True)
            found[f"{what}s_{behaviour}"] = Counter(value for on, value in active if on)
    return found


def exchangeable(one: list[dict[str, Counts]], two: list[dict[str, Counts]]) -> float:
    """p of the hypothesis that the runs in ``one`` and ``two`` (distributions by name) come from the same simulator.

    A permutation test over all ways to part the runs in two halves (2,000 drawn ones if there are more), its statistic
    the mean total variation across the halves less that within, summed over the distributions.
    """
    runs, half = [*one, *two], len(one)
    if half < 2:
        return 1.0
    apart = np.sum([[[total_variation(a[key], b[key]) for b in runs] for a in runs] for key in runs[0]], axis=0)
    n = len(runs)

    def statistic(chosen: Iterable[int]) -> float:
        mask = np.zeros(n, bool)
        mask[list(chosen)] = True
        across = apart[mask][:, ~mask].mean()
        within = [apart[m][:, m].sum() / (half * (half - 1)) for m in (mask, ~mask)]
        return float(across - sum(within) / 2)

    splits = [(0, *rest) for rest in combinations(range(1, n), half - 1)]  # a half and its complement count once
    if len(splits) > MOST_SPLITS:
        splits = Random(0).sample(splits, MOST_SPLITS)
    seen = statistic(range(half))
    return (1 + sum(statistic(split) >= seen - 1e-12 for split in splits)) / (1 + len(splits))


def total_variation(one: Counts, two: Counts) -> float:
    """Half the sum of absolute differences of two distributions: 0 the same, 1 nothing in common."""
    n, m = sum(one.values()), sum(two.values())
    if not n or not m:
        return 0.0 if n == m else 1.0
    return 0.5 * sum(abs(one[key] / n - two[key] / m) for key in one.keys() | two.keys())
