"""EAT: satisfy hunger at the green cubes."""

from __future__ import annotations

from attnlab.behaviours.forage import Forage, ForageParams
from attnlab.registry import register


@register("behaviours", "eat")
class Eat(Forage):
    """Section "EAT" and eq (8) of Di Nocera et al. 2014; see :class:`~attnlab.behaviours.forage.Forage`."""
    Params = ForageParams
    need = "hunger"
    source = "food"
