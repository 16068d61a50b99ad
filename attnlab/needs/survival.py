"""Hunger, thirst and energy of the survival domain."""

from __future__ import annotations

from dataclasses import dataclass

from attnlab.needs.base import Body, Need, Needs
from attnlab.registry import register
from attnlab.settings import setting


@register("needs", "survival")
class Survival(Needs):
    """Eqs (5), (6), (10) of Di Nocera et al. 2014 with the amounts of Table 4. Draws nothing at random."""

    @dataclass
    class Params:
        cycle_energy: float = setting(1.0, "e_u: energy a cycle costs", unit="UoE", low=0)
        activation_energy: float = setting(1.0, "e_nb: energy an active behaviour costs", unit="UoE", low=0)

    params: Params

    def body(self, more: list[Need]) -> Body:
        r, p = self.reading, self.params
        deadly = r.need_max if r.need_death else None
        own = [Need(name, r.need_start, r.need_k, 0.0, deadly, feeds_energy=True) for name in ("hunger", "thirst")]
        return Body(own + more, r.energy_start, p.cycle_energy, p.activation_energy, r)
