"""Every behaviour is penalised."""

from __future__ import annotations

from collections.abc import Sequence

from attnlab.behaviours.base import Behaviour
from attnlab.penalty.base import Penalty
from attnlab.registry import register


@register("penalty", "all")
class All(Penalty):
    """Eqs (7)-(9) of Di Nocera et al. 2014 to the letter: "-1500 if crash" in each of them, whatever killed the robot.
    Draws nothing at random."""

    def shares(self, cause: str, behaviours: Sequence[Behaviour]) -> list[float]:
        return [1.0] * len(behaviours)
