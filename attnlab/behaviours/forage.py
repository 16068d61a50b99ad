"""What EAT and DRINK share: go to a coloured source when a need has grown, look for one otherwise."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

from attnlab.behaviours.base import Behaviour, BehaviourContext, Command, Senses
from attnlab.equations import need_reward
from attnlab.settings import setting
from attnlab.simulators.base import Blob
from attnlab.simulators.robot import RADIUS_M


@dataclass
class ForageParams:
    power: float = setting(150.0, "e_f or e_w of Table 4: what a meal gives", unit="UoE", above=0)
    turn_gain: float = setting(2.0, "turn towards a blob, per rad of its bearing", unit="1/s", above=0)
    search_turn_rad_s: float = setting(0.6, "turn towards a random direction while searching", unit="rad/s", above=0)
    search_cycles: int = setting(40, "cycles until another random direction is drawn", unit="mc", low=1)
    slow_m: float = setting(1.0, "slow down from this distance on, to rest at rest_m", unit="m", above=0)
    rest_m: float = setting(0.6, "rest at this distance, within reach", unit="m", above=RADIUS_M)


def tallest(blobs: list[Blob]) -> Blob:
    """The first of the tallest."""
    found = blobs[0]
    for blob in blobs:
        if blob.height_px > found.height_px:
            found = blob
    return found


class Forage(Behaviour):
    """sigma is the need itself; the motor schema heads for the tallest blob of the source's colour, its height being
    the distance proxy, and otherwise towards a random direction (from the behaviour's own stream).

    A meal: an activation that finds the source nearer than ``reading.food_reach_m``, once every
    ``reading.meal_interval_cycles``.
    """
    params: ForageParams
    need: str
    source: str

    def __init__(self, params: ForageParams, context: BehaviourContext):
        super().__init__(params, context)
        r = self.reading
        self.sigma_high = r.need_max
        self.sigma_low = r.need_min if r.percept_domain == "min_to_max" else 0.0
        self.charges, self.feels = (self.need, "energy"), (self.need,)
        self.start()

    def start(self) -> None:
        self._next_meal = 0
        self._search_until = -1
        self._direction = 0.0

    def percept(self, now: Senses) -> float:
        return min(self.sigma_high, max(self.sigma_low, now.need(self.need)))

    def released(self, now: Senses, sigma: float) -> bool:
        return now.need(self.need) >= self.reading.releaser_threshold

    def command(self, now: Senses, sigma: float) -> Command:
        seen = now.blobs(self.source)
        if not seen:
            return self._search(now)
        p, r = self.params, self.reading
        blob = tallest(seen)
        if blob.distance_m < r.food_reach_m and now.cycle >= self._next_meal:
            now.body.consume(self.need, p.power)
            now.body.larder.take(blob.solid, now.cycle)
            self._next_meal = now.cycle + r.meal_interval_cycles
        self._search_until = -1
        ahead = min(1.0, max(0.0, (blob.distance_m - p.rest_m) / (p.slow_m - p.rest_m)))
        return r.v_max_m_s * ahead, p.turn_gain * blob.bearing_rad

    def _search(self, now: Senses) -> Command:
        if now.cycle >= self._search_until:
            self._search_until = now.cycle + self.params.search_cycles
            self._direction = self.draw.uniform(-pi, pi)
        error = (self._direction - now.heading() + pi) % (2 * pi) - pi
        limit = self.params.search_turn_rad_s
        return self.reading.v_max_m_s, min(limit, max(-limit, error))

    def reward(self, sigma: float, period: float) -> float:
        return need_reward(period, sigma, self.sigma_high)
