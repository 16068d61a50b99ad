"""Energy, and the rhythm of eating and drinking."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Literal

from attnlab.measures.base import CannotMeasure, Measure, Phase
from attnlab.measures.needs import OF_THE_PAPER, falls
from attnlab.registry import register
from attnlab.settings import setting

if TYPE_CHECKING:
    import numpy as np
    import pandas as pd

    from attnlab.results.conditions import Runs


def consumed(rows: pd.DataFrame) -> tuple[np.ndarray, np.ndarray]:
    """(cycles of the meals, cycles of the drinks): where hunger and thirst fall."""
    for need in OF_THE_PAPER:
        if rows[need].isna().any():
            raise CannotMeasure(f"the robot has no {need}")
    return falls(rows, "hunger"), falls(rows, "thirst")


@register("measure", "energy_margin")
class EnergyMargin(Measure):
    """Energy above E_well (UoE): the episode's minimum, mean or maximum less the reading's threshold."""
    unit = "UoE"

    @dataclass
    class Params:
        of: Literal["min", "mean", "max"] = setting("min", "which of the episode's values")
        phase: Phase = setting("validation", "which episodes")

    def of(self, runs: Runs) -> dict[int, float]:
        well = runs.reading().energy_well
        values = self.mean_of(runs, f"energy_{self.params.of}", self.params.phase)
        return {seed: value - well for seed, value in values.items()}


@register("measure", "alternation")
class Alternation(Measure):
    """Share of neighbouring meals and drinks of the last recorded episode that differ in kind, beyond the share that
    the same ones have in a random order, 2nm / (n+m)(n+m-1), in percent points. A meal and a drink in one cycle count
    as different."""
    unit = "%"

    def of(self, runs: Runs) -> dict[int, float]:
        found = {}
        for seed, rows in self.last_cycles(runs).items():
            meals, drinks = consumed(rows)
            n, m = len(meals), len(drinks)
            if not n or not m:
                found[seed] = float("nan")
                continue
            order = sorted([(int(t), "meal") for t in meals] + [(int(t), "drink") for t in drinks])
            kinds = [kind for _, kind in order]
            differ = sum(a != b for a, b in pairwise(kinds)) / (n + m - 1)
            found[seed] = 100 * (differ - 2 * n * m / ((n + m) * (n + m - 1)))
        if all(value != value for value in found.values()):
            raise CannotMeasure("no recorded episode has both a meal and a drink")
        return found


@register("measure", "rhythm")
class Rhythm(Measure):
    """Share of the power of hunger - thirst that is in its spectral peak, in %, in the last recorded episode."""
    unit = "%"

    def of(self, runs: Runs) -> dict[int, float]:
        from attnlab.stats import rhythm
        found = {}
        for seed, rows in self.last_cycles(runs).items():
            consumed(rows)  # says which need is missing
            found[seed] = 100 * rhythm((rows["hunger"] - rows["thirst"]).to_numpy(float)).share
        return found


@register("measure", "meal_variation")
class MealVariation(Measure):
    """Coefficient of variation (%) of the cycles between one meal and the next, and one drink and the next, in the
    last recorded episode: 0 for a perfect rhythm. nan for a seed with fewer than three of both."""
    unit = "%"

    def of(self, runs: Runs) -> dict[int, float]:
        import numpy as np
        found = {}
        for seed, rows in self.last_cycles(runs).items():
            gaps = [np.diff(times) for times in consumed(rows) if len(times) > 2]
            found[seed] = 100 * float(np.mean([g.std(ddof=1) / g.mean() for g in gaps])) if gaps else float("nan")
        if all(value != value for value in found.values()):
            raise CannotMeasure("no recorded episode has three meals or three drinks")
        return found
