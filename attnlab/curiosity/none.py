"""No curiosity: the robot of Di Nocera et al. 2012, called NCR in 2014."""

from __future__ import annotations

from typing import Any

from attnlab import equations
from attnlab.curiosity.base import HH, LH, LOW, NONE, CuriosityContext
from attnlab.curiosity.litman import Litman
from attnlab.curiosity.window import Window
from attnlab.registry import register


@register("curiosity", "none")
class NoCuriosity(Litman):
    """The reward is the extrinsic one alone and the state knows no curiosity (``reading.non_curious=plain``).

    With ``same_states`` the state keeps the three levels of the curious robot and only the reward is without
    curiosity: the ablation that tells the larger table from the intrinsic reward. Liking is still computed, so that
    it can be reported. Draws nothing at random.
    """

    def __init__(self, params: Any, context: CuriosityContext):
        super().__init__(params, context)
        self._plain = self.reading.non_curious == "plain"
        self.levels = (NONE,) if self._plain else (LOW, LH, HH)

    def wanting(self, memory: Window, energy: float) -> float:
        return 0.0 if self._plain else equations.wanting(energy, self.reading.energy_well, self.reading.energy_max)

    def level(self, wanting: float, liking: float) -> int:
        return 0 if self._plain or wanting <= self.high_wanting else 2 if liking > self.high_liking else 1

    def mix(self, extrinsic: float, liking: float, wanting: float) -> float:
        return extrinsic
