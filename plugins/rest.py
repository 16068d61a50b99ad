"""REST: a behaviour with a need of its own. Delete this file and nothing else changes; copy it to start your own."""
from dataclasses import dataclass

from attnlab.api import Behaviour, Need, need_reward, register, setting


@register("behaviours", "rest")
class Rest(Behaviour):
    """Stops the robot when it is tired. sigma is fatigue, which every active behaviour and every cycle adds to and
    every activation of REST at rest takes from. Not in the paper; the reward has the form of eq (8). Draws nothing."""
    charges = ("fatigue",)
    @dataclass
    class Params:
        threshold: float = setting(600.0, "released at this fatigue", unit="UoE", low=0)
        recovery: float = setting(40.0, "fatigue that one activation at rest takes away", unit="UoE", above=0)
        deadly: float = setting(1500.0, "the robot drops dead at this fatigue", unit="UoE", above=0)

    def __init__(self, params, context):
        super().__init__(params, context)
        self.sigma_high = params.deadly

    def needs(self):
        return [Need("fatigue", start=300.0, per_activation=0.5, per_cycle=0.5, death_at=self.params.deadly)]

    def percept(self, now):
        return min(self.sigma_high, max(self.sigma_low, now.need("fatigue")))

    def released(self, now, sigma):
        return now.need("fatigue") >= self.params.threshold

    def command(self, now, sigma):
        now.body.consume("fatigue", self.params.recovery)
        return 0.0, 0.0

    def reward(self, sigma, period):
        return need_reward(period, sigma, self.sigma_high)
