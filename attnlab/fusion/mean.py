"""The mean of the held commands: the naive combination, for comparison."""

from __future__ import annotations

from attnlab.fusion.base import Fusion
from attnlab.registry import register


@register("fusion", "mean")
class Mean(Fusion):
    """Mean speed and mean turn of the held commands. Draws nothing at random."""

    def fuse(self, commands: list[tuple[float, float]]) -> tuple[float, float]:
        if not commands:
            return 0.0, 0.0
        r, n = self.reading, len(commands)
        v = w = 0.0
        for speed, turn in commands:
            v += speed
            w += turn
        v, w = v / n, w / n
        return min(r.v_max_m_s, max(0.0, v)), min(r.w_max_rad_s, max(-r.w_max_rad_s, w))
