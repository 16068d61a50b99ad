"""Rewards summed over an episode (UoR), as in Fig 7 and Table 5."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from attnlab.measures.base import CannotMeasure, Measure, Phase, window
from attnlab.measures.frames import Window, means, of_seeds, phase_rows, split, window_rows
from attnlab.measures.once import once_a_study
from attnlab.registry import register
from attnlab.settings import setting

if TYPE_CHECKING:
    import numpy as np
    import pandas as pd

    from attnlab.results.conditions import Conditions, Runs

BEHAVIOUR = "a behaviour, several joined by + (eat+drink), or all"


@once_a_study
def _behaviours(conditions: Conditions, phase: str) -> dict[str, set[str]]:
    """Run -> its behaviours."""
    pairs = phase_rows(conditions, "behaviours", phase)[["run", "behaviour"]].drop_duplicates()
    found: dict[str, set[str]] = {}
    for run, name in pairs.itertuples(index=False):
        found.setdefault(run, set()).add(name)
    return found


def behaviours_of(runs: Runs, phase: str) -> set[str]:
    """Names of the behaviours that any of these runs has."""
    return set().union(*of_seeds(runs, _behaviours(runs.conditions, phase)).values())


@once_a_study
def sums(conditions: Conditions, phase: str, behaviour: str, column: str, within: Window) -> pd.DataFrame:
    """(run, episode, value) of all runs, in this order: ``column`` of ``behaviours`` summed over those named."""
    rows = window_rows(conditions, "behaviours", phase, within)
    if behaviour != "all":
        rows = rows[rows["behaviour"].isin(behaviour.split("+"))]
    return rows.groupby(["run", "episode"], observed=True)[column].sum().rename("value").reset_index()


@once_a_study
def _means(conditions: Conditions, phase: str, behaviour: str, column: str, within: Window) -> dict[str, float]:
    return means(sums(conditions, phase, behaviour, column, within), "value")


@once_a_study
def _curves(conditions: Conditions, behaviour: str, within: Window) -> dict[str, np.ndarray]:
    """Run -> reward of each training episode of a window."""
    found = split(sums(conditions, "train", behaviour, "reward", within))
    return {run: rows["value"].to_numpy(float) for run, rows in found.items()}


def _checked(runs: Runs, phase: str, behaviour: str, within: list[int] | None = None) -> Window:
    """Raise CannotMeasure unless there are these episodes and these behaviours."""
    window = Measure.check_episodes(runs, phase, within, table="behaviours")
    known = behaviours_of(runs, phase)
    missing = sorted(set(behaviour.split("+")) - known) if behaviour != "all" else []
    if missing:
        raise CannotMeasure(f"there is no behaviour {', '.join(missing)} (there are {', '.join(sorted(known))})")
    return window


def mean_sums(runs: Runs, phase: str, behaviour: str, column: str, within: list[int] | None = None) -> dict[int, float]:
    """Seed -> ``column`` of ``behaviours`` summed over the behaviours named, mean over episodes."""
    window = _checked(runs, phase, behaviour, within)
    return of_seeds(runs, _means(runs.conditions, phase, behaviour, column, window))


@register("measure", "reward")
class Reward(Measure):
    """Cumulative reward of an episode, penalties included, mean over episodes."""
    unit = "UoR"

    @dataclass
    class Params:
        behaviour: str = setting("all", BEHAVIOUR)
        phase: Phase = setting("validation", "which episodes")
        episodes: list[int] | None = setting(None, "[first, end) of them; all if left out")
        extrinsic: bool = setting(False, "without the intrinsic part of eq 4")

        def __post_init__(self) -> None:
            window(self.episodes, "episodes")

    def of(self, runs: Runs) -> dict[int, float]:
        p = self.params
        column = "reward_extrinsic" if p.extrinsic else "reward"
        return mean_sums(runs, p.phase, p.behaviour, column, p.episodes)


@register("measure", "reward_rise")
class RewardRise(Measure):
    """Mean reward of late training episodes less that of early ones."""
    unit = "UoR"

    @dataclass
    class Params:
        behaviour: str = setting("all", BEHAVIOUR)
        early: list[int] = setting([0, 200], "[first, end) of the early training episodes")
        late: list[int] = setting([400, 500], "[first, end) of the late training episodes")

        def __post_init__(self) -> None:
            window(self.early, "early")
            window(self.late, "late")

    def of(self, runs: Runs) -> dict[int, float]:
        p = self.params
        late = mean_sums(runs, "train", p.behaviour, "reward", p.late)
        early = mean_sums(runs, "train", p.behaviour, "reward", p.early)
        return {seed: late[seed] - early[seed] for seed in late if seed in early}


@register("measure", "reward_convergence")
class RewardConvergence(Measure):
    """Training episodes before the first block of which the reward stays near its own end level.

    The end level is the mean of the last ``end`` training episodes of the window; a block is near it at ``share`` of
    it or above. The length of the window if that never happens.
    """
    unit = "episodes"

    @dataclass
    class Params:
        behaviour: str = setting("all", BEHAVIOUR)
        block: int = setting(50, "length of a block", unit="episodes", low=1)
        share: float = setting(0.9, "of the end level", above=0, high=1)
        end: int = setting(100, "episodes that make the end level", unit="episodes", low=1)
        episodes: list[int] = setting([0, 500], "[first, end) of the training episodes looked at")

        def __post_init__(self) -> None:
            window(self.episodes, "episodes")

    def of(self, runs: Runs) -> dict[int, float]:
        from attnlab.stats import convergence_episode
        p, found = self.params, {}
        curves = _curves(runs.conditions, p.behaviour, _checked(runs, "train", p.behaviour, p.episodes))
        for seed, values in of_seeds(runs, curves).items():
            end = values[-p.end:].mean()
            found[seed] = p.episodes[0] + convergence_episode(values, p.block, end - (1 - p.share) * abs(end))
        return found
