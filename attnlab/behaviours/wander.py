"""WANDER: go somewhere, for no reason."""

from dataclasses import dataclass
from math import pi

from attnlab.behaviours.base import Behaviour, Command, Senses
from attnlab.equations import avoid_reward
from attnlab.registry import register
from attnlab.settings import setting


@register("behaviours", "wander")
class Wander(Behaviour):
    """Heads for a random direction and for another one after a while (Brooks 1986). sigma is the free way ahead, the
    least of the four foremost sonars (m, from the centre); the reward has the form of eq (7). Not in the paper. Draws a
    number (stream ``behaviour/wander``) for each direction."""
    sigma_high = 2.0

    @dataclass
    class Params:
        turn_rad_s: float = setting(0.6, "largest turn towards the direction", unit="rad/s", above=0)
        keep_cycles: int = setting(60, "cycles until another direction is drawn", unit="mc", low=1)

    params: Params

    def start(self) -> None:
        self._until, self._direction = -1, 0.0

    def percept(self, now: Senses) -> float:
        ahead = min(now.front_distances()[2:6])
        return min(self.sigma_high, ahead)

    def command(self, now: Senses, sigma: float) -> Command:
        if now.cycle >= self._until:
            self._until, self._direction = now.cycle + self.params.keep_cycles, self.draw.uniform(-pi, pi)
        error = (self._direction - now.heading() + pi) % (2 * pi) - pi
        return self.reading.v_max_m_s, min(self.params.turn_rad_s, max(-self.params.turn_rad_s, error))

    def reward(self, sigma: float, period: float) -> float:
        return avoid_reward(period, sigma, 0.0, self.sigma_high)
