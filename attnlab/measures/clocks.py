"""How often behaviours are active, and whether at the same time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from attnlab.measures.base import Measure, Phase
from attnlab.measures.frames import of_seeds, phase_rows
from attnlab.measures.once import once_a_study
from attnlab.measures.rewards import BEHAVIOUR, behaviours_of, mean_sums
from attnlab.registry import register
from attnlab.settings import setting

if TYPE_CHECKING:
    from attnlab.results.conditions import Conditions, Runs


@register("measure", "activations")
class Activations(Measure):
    """Activations an episode, mean over episodes; ``minus`` subtracts those of other behaviours."""
    unit = "activations"

    @dataclass
    class Params:
        behaviour: str = setting("all", BEHAVIOUR)
        minus: str | None = setting(None, "a behaviour, or several joined by +, to subtract")
        phase: Phase = setting("validation", "which episodes")

    def of(self, runs: Runs) -> dict[int, float]:
        p = self.params
        found = mean_sums(runs, p.phase, p.behaviour, "activations")
        if p.minus:
            less = mean_sums(runs, p.phase, p.minus, "activations")
            found = {seed: found[seed] - less[seed] for seed in found if seed in less}
        return found


@register("measure", "activation_saving")
class ActivationSaving(Measure):
    """How many activations fewer than one every cycle, in %: 100 (1 - activations / cycles), for each behaviour."""
    unit = "%"
    bounds = (0.0, 100.0)

    @dataclass
    class Params:
        behaviour: str = setting("all", BEHAVIOUR)
        phase: Phase = setting("validation", "which episodes")

    def of(self, runs: Runs) -> dict[int, float]:
        p = self.params
        acts = mean_sums(runs, p.phase, p.behaviour, "activations")
        cycles = self.mean_of(runs, "cycles", p.phase)
        names = len(behaviours_of(runs, p.phase) if p.behaviour == "all" else p.behaviour.split("+"))
        return {seed: 100 * (1 - acts[seed] / (names * cycles.get(seed, float("nan")))) for seed in acts}


@register("measure", "overlap")
class Overlap(Measure):
    """(sum - union) / sum of the activations of all behaviours in %: 0 if never two are active in one cycle."""
    unit = "%"
    bounds = (0.0, 100.0)

    @dataclass
    class Params:
        phase: Phase = setting("validation", "which episodes")

    def of(self, runs: Runs) -> dict[int, float]:
        from attnlab.stats import overlap_ratio
        acts = mean_sums(runs, self.params.phase, "all", "activations")
        union = self.mean_of(runs, "active_cycles", self.params.phase)
        return {seed: 100 * overlap_ratio(acts[seed], union.get(seed, float("nan"))) for seed in acts}


@register("measure", "overlap_excess")
class OverlapExcess(Measure):
    """Overlap less what the same activations have at random phases, in percent points, mean over episodes.

    Below 0: behaviours make room for each other; above 0: they fire together more than by chance. An episode without
    an activation has none.
    """
    unit = "%"
    bounds = (-100.0, 100.0)

    @dataclass
    class Params:
        phase: Phase = setting("validation", "which episodes")

    def of(self, runs: Runs) -> dict[int, float]:
        self.check_episodes(runs, self.params.phase, table="behaviours")
        return of_seeds(runs, _excess(runs.conditions, self.params.phase))


@once_a_study
def _excess(conditions: Conditions, phase: str) -> dict[str, float]:
    """Run -> mean excess of overlap (%)."""
    import numpy as np
    of = phase_rows(conditions, "behaviours", phase)
    each = of.groupby(["run", "episode", "behaviour"], observed=True)["activations"].sum().unstack(fill_value=0)
    rows = phase_rows(conditions, "episodes", phase).set_index(["run", "episode"]).loc[each.index]
    acts, cycles = each.to_numpy(float), rows["cycles"].to_numpy(float)
    total = acts.sum(axis=1)
    chance = cycles * (1 - np.prod(1 - acts / cycles[:, None], axis=1))
    with np.errstate(invalid="ignore", divide="ignore"):  # chance_overlap, for all episodes at once
        excess = 100 * (chance - rows["active_cycles"].to_numpy(float)) / total
    return {str(run): float(value) for run, value in rows.assign(excess=excess)["excess"].groupby(
        level="run", observed=True).mean().items()}
