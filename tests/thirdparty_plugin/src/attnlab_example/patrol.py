"""PATROL: go round the arena."""

from dataclasses import dataclass

from attnlab.api import Behaviour, avoid_reward, register, setting


@register("behaviours", "patrol")
class Patrol(Behaviour):
    """Drives a wide arc. sigma is the nearest echo on the left (m). Draws nothing at random."""

    @dataclass
    class Params:
        turn_rad_s: float = setting(0.2, "of the arc, to the left", unit="rad/s")

    def percept(self, now):
        return min(self.sigma_high, *now.front_distances()[:3])

    def command(self, now, sigma):
        return self.reading.v_max_m_s, self.params.turn_rad_s

    def reward(self, sigma, period):
        return avoid_reward(period, sigma, 0.0, self.sigma_high)
