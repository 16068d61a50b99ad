"""WATCH: look at what is nearest ahead, and leave the robot alone."""

from __future__ import annotations

from dataclasses import dataclass

from attnlab.behaviours.base import Behaviour, BehaviourContext, Command, Senses
from attnlab.errors import ConfigError
from attnlab.registry import register
from attnlab.settings import setting


@register("behaviours", "watch")
class Watch(Behaviour):
    """Ours, for logs (``simulator=log``), in which nobody can act: AVOID's percept without AVOID's command.

    sigma is the nearest of the 8 frontal sonars (m, from the log's sensor). Of eq (7) the period alone could be earned
    here, for no crash punishes who never looks; instead a long period pays as far as nothing is near at its end, a
    short one as far as something is: reward = u p + (1 - u) (1 - p), p the period term of eq (7), u that of the
    distance. It answers for crashes, of which there are none: that makes safety (eq 13) a matter of its clock. Draws
    nothing at random.
    """
    interpreted = "what it watches is the file of simulator=log"
    charges = ("crash",)
    simulators = ("log",)

    @dataclass
    class Params:
        sigma_max_m: float = setting(1.0, "what is farther away is as good as nothing", unit="m", above=0)
        sigma_min_m: float = setting(0.4, "what is nearer is as good as touched", unit="m", low=0)

        def __post_init__(self) -> None:
            if self.sigma_min_m >= self.sigma_max_m:
                raise ConfigError("sigma_min_m", "must be below sigma_max_m")

    params: Params

    def __init__(self, params: Params, context: BehaviourContext):
        super().__init__(params, context)
        self.sigma_high = params.sigma_max_m

    def percept(self, now: Senses) -> float:
        return min(self.sigma_high, max(0.0, min(now.front_distances())))

    def command(self, now: Senses, sigma: float) -> Command | None:
        return None

    def reward(self, sigma: float, period: float) -> float:
        low, high = self.params.sigma_min_m, self.sigma_high
        free = max(0.0, (sigma - low) / (high - low))
        return free * period + (1.0 - free) * (1.0 - period)
