"""Survival, and when it converges."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from attnlab.errors import ConfigError, nearest
from attnlab.measures.base import Measure, Phase, window
from attnlab.measures.frames import Window, of_seeds, split, window_rows
from attnlab.measures.needs import UNIT
from attnlab.measures.once import once_a_study
from attnlab.registry import parts, register
from attnlab.settings import setting
from attnlab.tables.schema import SCHEMA

if TYPE_CHECKING:
    import numpy as np

    from attnlab.results.conditions import Conditions, Runs


@register("measure", "survival")
class Survival(Measure):
    """Survival time in % of the longest episode, mean over episodes (Fig 6)."""
    unit = "%"
    bounds = (0.0, 100.0)

    @dataclass
    class Params:
        phase: Phase = setting("validation", "which episodes")
        episodes: list[int] | None = setting(None, "[first, end) of them; all if left out")

        def __post_init__(self) -> None:
            window(self.episodes, "episodes")

    def of(self, runs: Runs) -> dict[int, float]:
        found = self.mean_of(runs, "survival", self.params.phase, self.params.episodes)
        return {seed: 100 * value for seed, value in found.items()}


@register("measure", "survival_convergence")
class SurvivalConvergence(Measure):
    """Training episodes before the first block whose mean survival is at a level and stays there; inf for a seed in
    which that does not happen within the window."""
    unit = "episodes"
    censored = True

    @dataclass
    class Params:
        block: int = setting(50, "length of a block", unit="episodes", low=1)
        level: float = setting(99.5, "survival that counts as converged", unit="%", low=0, high=100)
        episodes: list[int] = setting([0, 500], "[first, end) of the training episodes looked at")

        def __post_init__(self) -> None:
            window(self.episodes, "episodes")

    def __init__(self, params: Any, context: Any = None):
        super().__init__(params, context)
        self.bounds = (float(params.episodes[0]), float("inf"))

    def of(self, runs: Runs) -> dict[int, float]:
        from attnlab.stats import convergence_episode
        p = self.params
        curves = of_seeds(runs, _curves(runs.conditions, self.check_episodes(runs, "train", p.episodes)))
        return {seed: p.episodes[0] + convergence_episode(curve, p.block, p.level) for seed, curve in curves.items()}


@once_a_study
def _curves(conditions: Conditions, within: Window) -> dict[str, np.ndarray]:
    """Run -> survival (%) of each training episode of a window."""
    rows = window_rows(conditions, "episodes", "train", within).sort_values(["run", "episode"])
    return {run: 100 * group["survival"].to_numpy(float) for run, group in split(rows).items()}


@register("measure", "episode")
class Episode(Measure):
    """A number column of the table ``episodes``, mean over episodes: safety_mean, hunger_max, energy_min, meals..."""

    UNITS = {"survival": "1", "cycles": "mc", "active_cycles": "mc", "meals": "meals", "drinks": "drinks",
             "path_m": "m", "wanting_mean": "1", "turn_rad": "rad", "bouts": "1"}
    PREFIXES = {"safety": "1", "energy": "UoE"}

    @dataclass
    class Params:
        column: str = setting("survival", "name of the column")
        phase: Phase = setting("validation", "which episodes")
        episodes: list[int] | None = setting(None, "[first, end) of them; all if left out")

        def __post_init__(self) -> None:
            window(self.episodes, "episodes")

    def __init__(self, params: Any, context: Any = None):
        super().__init__(params, context)
        column = params.column
        of_a_need = UNIT if column.endswith(("_mean", "_max")) else ""  # also of one that a behaviour brings
        self.unit = self.UNITS.get(column) or self.PREFIXES.get(column.partition("_")[0]) or of_a_need
        if column == "survival" or column.startswith("safety_"):
            self.bounds = (0.0, 1.0)
        _check_column(column)

    def of(self, runs: Runs) -> dict[int, float]:
        from pandas.api.types import is_numeric_dtype
        self.check_episodes(runs, self.params.phase, self.params.episodes)
        rows, column = runs.conditions.frame("episodes"), self.params.column
        if column not in rows or not is_numeric_dtype(rows[column]):
            numbers = [name for name in rows.columns if is_numeric_dtype(rows[name])]
            raise ConfigError("measure.column", f"episodes has no number column '{column}'", nearest(column, numbers))
        return self.mean_of(runs, column, self.params.phase, self.params.episodes)


def _check_column(column: str) -> None:
    """Can a study have this number column: of the schema, a need's, or a probe's? Raises ConfigError."""
    known = [name for name, of in SCHEMA["episodes"].items() if of.type not in ("string", "bool")]
    probes = [name for spec in parts.values() if spec.group == "probe" and getattr(spec.cls, "table", "") == "episodes"
              for name in getattr(spec.cls, "columns", {})]
    if column not in (*known, *probes) and not column.endswith(("_mean", "_max")):
        raise ConfigError("column", f"episodes has no number column '{column}'", nearest(column, [*known, *probes]))
