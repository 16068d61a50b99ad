"""A body that spends energy and wants nothing."""

from __future__ import annotations

from attnlab.needs.base import Body, Need, Needs
from attnlab.needs.survival import Survival
from attnlab.registry import register


@register("needs", "energy_only")
class EnergyOnly(Needs):
    """Eq (10) of Di Nocera et al. 2014 without hunger and thirst; needs that behaviours bring come on top. For tasks
    that are not about survival, such as GIVE. Draws nothing at random."""
    Params = Survival.Params
    params: Survival.Params

    def body(self, more: list[Need]) -> Body:
        return Body(more, self.reading.energy_start, self.params.cycle_energy, self.params.activation_energy,
                    self.reading)
