"""DRINK: satisfy thirst at the blue cubes."""

from __future__ import annotations

from attnlab.behaviours.forage import Forage, ForageParams
from attnlab.registry import register


@register("behaviours", "drink")
class Drink(Forage):
    """Section "DRINK" and eq (9) of Di Nocera et al. 2014; see :class:`~attnlab.behaviours.forage.Forage`."""
    Params = ForageParams
    need = "thirst"
    source = "water"
