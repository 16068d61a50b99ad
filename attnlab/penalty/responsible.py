"""The behaviour in charge of what killed the robot is penalised."""

from __future__ import annotations

from collections.abc import Sequence

from attnlab.behaviours.base import Behaviour
from attnlab.penalty.base import Penalty
from attnlab.registry import register


@register("penalty", "responsible")
class Responsible(Penalty):
    """AVOID for a crash, EAT for hunger, DRINK for thirst: those whose ``charges`` name the cause. The reading of eqs
    (7)-(9) of Di Nocera et al. 2014 under which the non-curious robot is sound. Draws nothing at random."""

    def shares(self, cause: str, behaviours: Sequence[Behaviour]) -> list[float]:
        return [1.0 if cause in behaviour.charges else 0.0 for behaviour in behaviours]
