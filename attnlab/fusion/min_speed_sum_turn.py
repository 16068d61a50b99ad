"""The slowest held speed, the sum of the held turns."""

from __future__ import annotations

from attnlab.fusion.base import Fusion
from attnlab.registry import register


@register("fusion", "min_speed_sum_turn")
class MinSpeedSumTurn(Fusion):
    """The paper says only that the outputs are combined; this is the order of the machine cycle that keeps a robot
    alive whatever it learns: who wants to stop stops it, and all turns count. Draws nothing at random."""

    def fuse(self, commands: list[tuple[float, float]]) -> tuple[float, float]:
        if not commands:
            return 0.0, 0.0
        v, w = self.reading.v_max_m_s, 0.0
        for speed, turn in commands:
            if speed < v:
                v = speed
            w += turn
        limit = self.reading.w_max_rad_s
        return max(0.0, v), limit if w > limit else -limit if w < -limit else w
