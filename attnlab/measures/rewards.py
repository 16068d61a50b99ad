"""Rewards summed over an episode (UoR), as in Fig 7 and Table 5."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from attnlab.measures.base import PHASES, CannotMeasure, Measure, window
from attnlab.registry import register
from attnlab.settings import setting

if TYPE_CHECKING:
    import pandas as pd

BEHAVIOUR = "a behaviour, several joined by + (eat+drink), or all"


def summed(runs, phase: str, behaviour: str, column: str, within: list[int] | None = None) -> pd.DataFrame:
    """(seed, episode, value): ``column`` of ``behaviours`` summed over the behaviours named."""
    rows = Measure.episodes(runs, phase, within, table="behaviours")
    if behaviour != "all":
        names, known = behaviour.split("+"), set(rows["behaviour"])
        missing = sorted(set(names) - known)
        if missing:
            raise CannotMeasure(f"there is no behaviour {', '.join(missing)} (there are {', '.join(sorted(known))})")
        rows = rows[rows["behaviour"].isin(names)]
    return rows.groupby(["seed", "episode"], as_index=False)[column].sum().rename(columns={column: "value"})


@register("measure", "reward")
class Reward(Measure):
    """Cumulative reward of an episode, penalties included, mean over episodes."""
    unit = "UoR"

    @dataclass
    class Params:
        behaviour: str = setting("all", BEHAVIOUR)
        phase: str = setting("validation", "which episodes", choices=PHASES)
        episodes: list[int] | None = setting(None, "[first, end) of them; all if left out")
        extrinsic: bool = setting(False, "without the intrinsic part of eq 4")

        def __post_init__(self):
            window(self.episodes, "episodes")

    def of(self, runs):
        p = self.params
        column = "reward_extrinsic" if p.extrinsic else "reward"
        return self.means(summed(runs, p.phase, p.behaviour, column, p.episodes), "value")


@register("measure", "reward_rise")
class RewardRise(Measure):
    """Mean reward of late training episodes less that of early ones."""
    unit = "UoR"

    @dataclass
    class Params:
        behaviour: str = setting("all", BEHAVIOUR)
        early: list[int] = setting([0, 200], "[first, end) of the early training episodes")
        late: list[int] = setting([400, 500], "[first, end) of the late training episodes")

        def __post_init__(self):
            window(self.early, "early")
            window(self.late, "late")

    def of(self, runs):
        p = self.params
        late = self.means(summed(runs, "train", p.behaviour, "reward", p.late), "value")
        early = self.means(summed(runs, "train", p.behaviour, "reward", p.early), "value")
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

        def __post_init__(self):
            window(self.episodes, "episodes")

    def of(self, runs):
        from attnlab.stats import convergence_episode
        p, found = self.params, {}
        rows = summed(runs, "train", p.behaviour, "reward", p.episodes).sort_values(["seed", "episode"])
        for seed, group in rows.groupby("seed"):
            values = group["value"].to_numpy()
            end = values[-p.end:].mean()
            found[int(seed)] = p.episodes[0] + convergence_episode(values, p.block, end - (1 - p.share) * abs(end))
        return found
