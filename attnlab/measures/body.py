"""Energy, and the rhythm of eating and drinking."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from attnlab.measures.base import CannotMeasure, Measure, Phase
from attnlab.registry import register
from attnlab.settings import setting

if TYPE_CHECKING:
    import pandas as pd

    from attnlab.results.conditions import Runs


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


@register("measure", "above_well")
class AboveWell(Measure):
    """Share of the episodes (%) in which energy never falls below the reading's E_well (eq 11)."""
    unit = "%"
    bounds = (0.0, 100.0)

    @dataclass
    class Params:
        phase: Phase = setting("validation", "which episodes")

    def of(self, runs: Runs) -> dict[int, float]:
        well = runs.reading().energy_well
        rows = self.episodes(runs, self.params.phase)
        return self.means(rows.assign(above=100.0 * (rows["energy_min"] >= well)), "above")


@dataclass
class _Bouts:
    phase: Phase = setting("validation", "which episodes")
    least: int = setting(6, "bouts an episode needs to count", low=3)


def _bouts(runs: Runs, p: _Bouts) -> pd.DataFrame:
    """Episodes with enough bouts of eating and drinking (looks at food less than 60 cycles apart are one bout)."""
    rows = Measure.episodes(runs, p.phase)
    rows = rows[rows["bouts"] >= p.least]
    if not len(rows):
        raise CannotMeasure(f"no {p.phase} episode has {p.least} bouts of eating and drinking")
    return rows


@register("measure", "alternation")
class Alternation(Measure):
    """Share of bouts that follow one of the other kind, beyond the most that a random order has, N / 2(N - 1) of N
    bouts half of which are meals; in percent points, mean over the episodes with ``least`` bouts. nan for a seed
    without such an episode."""
    unit = "%"
    bounds = (-60.0, 50.0)
    Params = _Bouts

    def of(self, runs: Runs) -> dict[int, float]:
        rows = _bouts(runs, self.params)
        n = rows["bouts"]
        beyond = 100.0 * (rows["bout_switches"] / (n - 1) - n / (2 * (n - 1)))
        return {**dict.fromkeys(sorted(runs.runs), float("nan")), **self.means(rows.assign(beyond=beyond), "beyond")}


@register("measure", "bout_variation")
class BoutVariation(Measure):
    """Coefficient of variation (%) of the cycles from the start of a bout to that of the next, mean over the episodes
    with ``least`` bouts: 0 for a perfect rhythm. nan for a seed without such an episode."""
    unit = "%"
    bounds = (0.0, float("inf"))
    Params = _Bouts

    def of(self, runs: Runs) -> dict[int, float]:
        rows = _bouts(runs, self.params)
        varies = 100.0 * rows["bout_interval_sd"] / rows["bout_interval_mean"]
        return {**dict.fromkeys(sorted(runs.runs), float("nan")), **self.means(rows.assign(varies=varies), "varies")}
