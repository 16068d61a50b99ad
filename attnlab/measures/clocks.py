"""How often behaviours are active, and whether at the same time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from attnlab.measures.base import Measure, Phase
from attnlab.measures.rewards import BEHAVIOUR, behaviours_of, mean_sums
from attnlab.registry import register
from attnlab.settings import setting

if TYPE_CHECKING:
    from attnlab.results.conditions import Runs



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

    @dataclass
    class Params:
        behaviour: str = setting("all", BEHAVIOUR)
        phase: Phase = setting("validation", "which episodes")

    def of(self, runs: Runs) -> dict[int, float]:
        p = self.params
        acts = mean_sums(runs, p.phase, p.behaviour, "activations")
        cycles = self.mean_of(runs, "cycles", p.phase)
        names = len(behaviours_of(runs, p.phase) if p.behaviour == "all" else p.behaviour.split("+"))
        return {seed: 100 * (1 - acts[seed] / (names * cycles[seed])) for seed in acts}


@register("measure", "overlap")
class Overlap(Measure):
    """(sum - union) / sum of the activations of all behaviours in %: 0 if never two are active in one cycle."""
    unit = "%"

    @dataclass
    class Params:
        phase: Phase = setting("validation", "which episodes")

    def of(self, runs: Runs) -> dict[int, float]:
        from attnlab.stats import overlap_ratio
        acts = mean_sums(runs, self.params.phase, "all", "activations")
        union = self.mean_of(runs, "active_cycles", self.params.phase)
        return {seed: 100 * overlap_ratio(acts[seed], union[seed]) for seed in acts}


@register("measure", "overlap_excess")
class OverlapExcess(Measure):
    """Overlap of the last recorded episode less the mean of its random-phase null, in percent points.

    Below 0: behaviours make room for each other; above 0: they fire together more than by chance. Draws the random
    phases with a fixed seed.
    """
    unit = "%"

    def of(self, runs: Runs) -> dict[int, float]:
        from attnlab.stats import overlap_null, overlap_ratio
        found = {}
        for seed, rows in self.last_cycles(runs).items():
            columns = [name for name in rows.columns if name.endswith("_active") and rows[name].notna().all()]
            active = rows[columns].to_numpy(bool)
            seen = overlap_ratio(int(active.sum()), int(active.any(axis=1).sum()))
            found[seed] = 100 * (seen - float(overlap_null(active, 200, seed).mean()))
        return found
