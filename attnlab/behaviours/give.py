"""GIVE: watch the hand that may take an object (Fig 1 of the paper)."""

from __future__ import annotations

from dataclasses import dataclass

from attnlab.behaviours.base import Behaviour, Command, Senses
from attnlab.equations import need_reward
from attnlab.registry import register
from attnlab.settings import setting


def salience(distance_m: float, speed_m_s: float, d_max: float, v_max: float) -> float:
    """clip(max(v/v_max, 1 - d/d_max)) in [0, 1]: a fast hand or a near one."""
    return min(1.0, max(0.0, speed_m_s / v_max, 1.0 - distance_m / d_max))


def giving_period(salience: float, shortest: int, longest: int) -> int:
    """p = round(p_max - (p_max - p_min) * salience), mc: an assumption, the paper does not give its function."""
    return round(longest - (longest - shortest) * salience)


@register("behaviours", "give")
class Give(Behaviour):
    """The giving task of Sidobre et al. 2012, Fig 1 of Di Nocera et al. 2014: the faster or the nearer the human hand,
    the more often it is looked at.

    sigma is the salience max(v/v_max, 1 - d/d_max) of the hand of ``simulator=scripted``, in [0, 1]. The exact function
    is not in the paper; this one is an assumption. With ``learner=monitor`` the period falls linearly with sigma,
    ``giving_period`` but for the width of a percept. It moves nothing; the reward has the form of eq (8). Draws
    nothing at random.
    """
    interpreted = "it watches the hand of simulator=scripted"
    simulators = ("scripted",)

    @dataclass
    class Params:
        v_max_m_s: float = setting(1.0, "speed of the hand that has all attention", unit="m/s", above=0)
        d_max_m: float = setting(1.5, "distance of the hand from which on it has none", unit="m", above=0)

    params: Params

    def percept(self, now: Senses) -> float:
        distance, speed = now.hand()
        return salience(distance, speed, self.params.d_max_m, self.params.v_max_m_s)

    def command(self, now: Senses, sigma: float) -> Command | None:
        return None

    def reward(self, sigma: float, period: float) -> float:
        return need_reward(period, sigma, self.sigma_high)
