"""Emotional clocks: an inner state that lasts shortens the period."""

from __future__ import annotations

from dataclasses import dataclass
from random import Random

from attnlab.exploration.base import Exploration
from attnlab.learners.base import LearnerContext
from attnlab.learners.monitor import Monitor
from attnlab.registry import register
from attnlab.settings import setting


@register("learner", "emotional")
class Emotional(Monitor):
    """Burattini & Rossi 2010 (Connection Science 22): internal clocks whose period an emotional state modulates. The
    form is ours: p' = p (1 - gain e), p being the monitoring function's period for the percept (``monitor``), and e in
    [0, 1] a state that rises at once to the urgency u of what is seen and fades: e = max(u, e' fading^t) after t
    cycles.

    Urgency is how far the function has shortened the period, (longest - p) / (longest - shortest): a robot that was
    near something keeps watching for a while. The nearest granted period is taken. Nothing is learned. Draws nothing at
    random.
    """

    @dataclass
    class Params(Monitor.Params):
        gain: float = setting(0.7, "g: share of the period that the strongest emotion takes", low=0, high=1)
        fading: float = setting(0.95, "what is left of an emotion after a cycle", low=0, high=1)

    params: Params

    def __init__(self, params: Params, context: LearnerContext):
        super().__init__(params, context)
        self._emotion = 0.0

    def start(self) -> None:
        self._last, self._emotion = -1, 0.0

    def decide(self, state: int, exploration: Exploration, draw: Random) -> int:
        periods = self.context.periods
        elapsed = periods[state // self.context.bins % len(periods)]
        wanted = periods[self.granted(state)]
        longest, shortest = max(periods), min(periods)
        urgency = (longest - wanted) / (longest - shortest) if longest > shortest else 0.0
        self._emotion = max(urgency, self._emotion * self.params.fading ** elapsed)
        return self._nearest(wanted * (1.0 - self.params.gain * self._emotion))
