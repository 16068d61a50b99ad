"""Survival, and when it converges."""

from __future__ import annotations

from dataclasses import dataclass

from attnlab.measures.base import PHASES, Measure, window
from attnlab.registry import register
from attnlab.settings import setting


@register("measure", "survival")
class Survival(Measure):
    """Survival time in % of the longest episode, mean over episodes (Fig 6)."""
    unit = "%"

    @dataclass
    class Params:
        phase: str = setting("validation", "which episodes", choices=PHASES)
        episodes: list[int] | None = setting(None, "[first, end) of them; all if left out")

        def __post_init__(self):
            window(self.episodes, "episodes")

    def of(self, runs):
        rows = self.episodes(runs, self.params.phase, self.params.episodes)
        return {seed: 100 * value for seed, value in self.means(rows, "survival").items()}


@register("measure", "survival_convergence")
class SurvivalConvergence(Measure):
    """Training episodes before the first block whose mean survival is at a level and stays there.

    The length of the window if that never happens, so "never" compares as "late".
    """
    unit = "episodes"

    @dataclass
    class Params:
        block: int = setting(50, "length of a block", unit="episodes", low=1)
        level: float = setting(99.5, "survival that counts as converged", unit="%", low=0, high=100)
        episodes: list[int] = setting([0, 500], "[first, end) of the training episodes looked at")

        def __post_init__(self):
            window(self.episodes, "episodes")

    def of(self, runs):
        from attnlab.stats import convergence_episode
        p = self.params
        rows = self.episodes(runs, "train", p.episodes).sort_values("episode")
        return {int(seed): p.episodes[0] + convergence_episode(100 * group["survival"].to_numpy(), p.block, p.level)
                for seed, group in rows.groupby("seed")}


@register("measure", "episode")
class Episode(Measure):
    """A number column of the table ``episodes``, mean over episodes: safety_mean, hunger_max, energy_min, meals..."""

    UNITS = {"survival": "1", "cycles": "mc", "active_cycles": "mc", "meals": "meals", "drinks": "drinks",
             "path_m": "m", "wanting_mean": "1"}

    @dataclass
    class Params:
        column: str = setting("survival", "name of the column")
        phase: str = setting("validation", "which episodes", choices=PHASES)
        episodes: list[int] | None = setting(None, "[first, end) of them; all if left out")

        def __post_init__(self):
            window(self.episodes, "episodes")

    def __init__(self, params, context=None):
        super().__init__(params, context)
        column = params.column
        prefix = {"safety": "1", "energy": "UoE", "hunger": "UoE", "thirst": "UoE"}.get(column.partition("_")[0])
        self.unit = self.UNITS.get(column) or prefix or ""

    def of(self, runs):
        from pandas.api.types import is_numeric_dtype

        from attnlab.errors import ConfigError, nearest
        rows, column = self.episodes(runs, self.params.phase, self.params.episodes), self.params.column
        numbers = [name for name in rows.columns if is_numeric_dtype(rows[name])]
        if column not in numbers:
            raise ConfigError("measure.column", f"episodes has no number column '{column}'", nearest(column, numbers))
        return self.means(rows, column)
