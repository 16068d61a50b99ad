"""Rewards summed over an episode (UoR), as in Fig 7 and Table 5."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

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
def sums(conditions: Conditions, phase: str, behaviour: str, columns: str, within: Window, survived: bool = False
         ) -> pd.DataFrame:
    """(run, episode, value) of all runs, in this order: ``columns`` of ``behaviours`` (reward, or reward+penalty)
    summed over those named. ``survived``: of the episodes that no death ended."""
    rows = window_rows(conditions, "behaviours", phase, within)
    if behaviour != "all":
        rows = rows[rows["behaviour"].isin(behaviour.split("+"))]
    if survived:
        lived = phase_rows(conditions, "episodes", phase)
        rows = rows.merge(lived.loc[lived["death"] == "none", ["run", "episode"]], on=["run", "episode"])
    value = rows[columns.split("+")].sum(axis=1)
    return rows.assign(value=value).groupby(["run", "episode"], observed=True)["value"].sum().reset_index()


@once_a_study
def _means(conditions: Conditions, phase: str, behaviour: str, columns: str, within: Window, survived: bool
           ) -> dict[str, float]:
    return means(sums(conditions, phase, behaviour, columns, within, survived), "value")


@once_a_study
def _curves(conditions: Conditions, behaviour: str, columns: str, within: Window) -> dict[str, np.ndarray]:
    """Run -> reward of each training episode of a window."""
    found = split(sums(conditions, "train", behaviour, columns, within))
    return {run: rows["value"].to_numpy(float) for run, rows in found.items()}


def _checked(runs: Runs, phase: str, behaviour: str, within: list[int] | None = None) -> Window:
    """Raise CannotMeasure unless there are these episodes and these behaviours."""
    window = Measure.check_episodes(runs, phase, within, table="behaviours")
    known = behaviours_of(runs, phase)
    missing = sorted(set(behaviour.split("+")) - known) if behaviour != "all" else []
    if missing:
        raise CannotMeasure(f"there is no behaviour {', '.join(missing)} (there are {', '.join(sorted(known))})")
    return window


def mean_sums(runs: Runs, phase: str, behaviour: str, columns: str, within: list[int] | None = None,
              survived: bool = False) -> dict[int, float]:
    """Seed -> ``columns`` of ``behaviours`` summed over the behaviours named, mean over episodes; nan for a seed none
    of whose episodes counts."""
    found = of_seeds(runs, _means(runs.conditions, phase, behaviour, columns,
                                  _checked(runs, phase, behaviour, within), survived))
    return {seed: found.get(seed, float("nan")) for seed in sorted(runs.runs)}


@dataclass
class _Paid:
    """Which reward is meant."""
    behaviour: str = setting("all", BEHAVIOUR)
    extrinsic: bool = setting(False, "without the intrinsic part of eq 4")
    penalties: bool = setting(True, "with the penalty of a death, as eqs 7-9 have it")

    @property
    def columns(self) -> str:
        return ("reward_extrinsic" if self.extrinsic else "reward") + "+penalty" * self.penalties


@register("measure", "reward")
class Reward(Measure):
    """Cumulative reward of an episode, mean over episodes, or over those that no death ended (``survived``)."""
    unit = "UoR"

    @dataclass
    class Params(_Paid):
        phase: Phase = setting("validation", "which episodes")
        episodes: list[int] | None = setting(None, "[first, end) of them; all if left out")
        survived: bool = setting(False, "only episodes that no death ended")

        def __post_init__(self) -> None:
            window(self.episodes, "episodes")

    def of(self, runs: Runs) -> dict[int, float]:
        p = self.params
        return mean_sums(runs, p.phase, p.behaviour, p.columns, p.episodes, p.survived)


@register("measure", "reward_rise")
class RewardRise(Measure):
    """Mean reward of late training episodes less that of early ones."""
    unit = "UoR"

    @dataclass
    class Params(_Paid):
        early: list[int] = setting([0, 200], "[first, end) of the early training episodes")
        late: list[int] = setting([400, 500], "[first, end) of the late training episodes")

        def __post_init__(self) -> None:
            window(self.early, "early")
            window(self.late, "late")

    def of(self, runs: Runs) -> dict[int, float]:
        p = self.params
        late = mean_sums(runs, "train", p.behaviour, p.columns, p.late)
        early = mean_sums(runs, "train", p.behaviour, p.columns, p.early)
        return {seed: late[seed] - early[seed] for seed in late if seed in early}


@register("measure", "reward_convergence")
class RewardConvergence(Measure):
    """Training episodes before the first block of which the reward stays near its own end level.

    The end level is the mean of the last ``end`` training episodes of the window; a block is near it at ``share`` of
    it or above. inf for a seed in which that does not happen within the window.
    """
    unit = "episodes"
    censored = True

    @dataclass
    class Params(_Paid):
        block: int = setting(50, "length of a block", unit="episodes", low=1)
        share: float = setting(0.9, "of the end level", above=0, high=1)
        end: int = setting(100, "episodes that make the end level", unit="episodes", low=1)
        episodes: list[int] = setting([0, 500], "[first, end) of the training episodes looked at")

        def __post_init__(self) -> None:
            window(self.episodes, "episodes")

    def __init__(self, params: Any, context: Any = None):
        super().__init__(params, context)
        self.bounds = (float(params.episodes[0]), float("inf"))

    def of(self, runs: Runs) -> dict[int, float]:
        from attnlab.stats import convergence_episode
        p, found = self.params, {}
        curves = _curves(runs.conditions, p.behaviour, p.columns, _checked(runs, "train", p.behaviour, p.episodes))
        for seed, values in of_seeds(runs, curves).items():
            end = values[-p.end:].mean()
            found[seed] = p.episodes[0] + convergence_episode(values, p.block, end - (1 - p.share) * abs(end))
        return found
