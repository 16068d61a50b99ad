"""AVOID: keep away from whatever the frontal sonars hear."""

from __future__ import annotations

from dataclasses import dataclass

from attnlab.behaviours.base import Behaviour, BehaviourContext, Command, Senses
from attnlab.equations import avoid_reward
from attnlab.registry import register
from attnlab.settings import setting
from attnlab.simulators.robot import FRONT, SONARS


@register("behaviours", "avoid")
class Avoid(Behaviour):
    """Section "AVOID" and eq (7) of Di Nocera et al. 2014.

    sigma is the minimum of the 8 frontal sonars (m, from the centre). Speed falls linearly with it
    (``reading.speed_law``); the turn is the sum over the active sonars of theta_max times a weight, high for frontal
    sonars and low for lateral ones, away from the side of the echo. In a corner the two sides cancel and the robot
    would turn to and fro: once blocked, it keeps to the side it chose until its way is free (``reading.turn_rule``).
    Draws nothing at random.
    """
    charges = ("crash",)

    @dataclass
    class Params:
        gain_rad_s: float = setting(0.8, "theta_max: turn of one sonar of weight 1", unit="rad/s", above=0)
        active_margin_m: float = setting(0.3, "a sonar is active when it hears something nearer to the centre than "
                                         "this beyond where danger begins (0.35 m; 0.2 m beyond the safety distance "
                                         "where that kills)", unit="m", low=0)
        blocked_margin_m: float = setting(0.2, "the way is blocked when one of the four foremost sonars hears "
                                          "something nearer than this beyond the same", unit="m", low=0)
        weights: list[float] = setting([0.2, 0.5, 0.8, 1.0], "of the sonars at 90, 50, 30, 10 degrees", low=0)

    params: Params

    def __init__(self, params: Params, context: BehaviourContext):
        super().__init__(params, context)
        r = self.reading
        self.sigma_high = r.avoid_sigma_max_m
        self.sigma_low = r.avoid_sigma_min_m if r.percept_domain == "min_to_max" else 0.0
        # An echo on the left (positive angle) turns the robot to the right.
        half = list(params.weights)
        self._turns = [(-1.0 if SONARS[i][2] > 0 else 1.0) * weight * params.gain_rad_s
                       for i, weight in zip(FRONT, half + half[::-1], strict=True)]
        self._active_m = r.danger_m + params.active_margin_m
        self._blocked_m = r.danger_m + params.blocked_margin_m
        self._stop_m = r.stop_m if r.speed_law == "stopping" else 0.0
        self._side = 0.0

    def start(self) -> None:
        self._side = 0.0

    def percept(self, now: Senses) -> float:
        return min(self.sigma_high, max(self.sigma_low, min(now.front_distances())))

    def command(self, now: Senses, sigma: float) -> Command:
        r = self.reading
        heard = now.front_distances()
        near, free, stop = min(heard), self.sigma_high, self._stop_m
        v = r.v_max_m_s * min(1.0, max(0.0, (near - stop) / (free - stop)))
        w = 0.0
        for i, d in enumerate(heard):
            if d < self._active_m:
                w += self._turns[i]
        if min(heard[2:6]) >= self._blocked_m or r.turn_rule == "sum":
            self._side = 0.0
            return v, w
        if self._side == 0.0:
            self._side = -1.0 if w < 0 else 1.0
        return v, self._side * r.w_max_rad_s

    def reward(self, sigma: float, period: float) -> float:
        return avoid_reward(period, sigma, self.reading.reward_sigma_min_m, self.sigma_high)
