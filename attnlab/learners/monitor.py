"""Hand-set monitoring functions: the period follows from the percept, nothing is learned."""

from __future__ import annotations

from dataclasses import dataclass, fields
from random import Random
from typing import Any, Literal

from attnlab.errors import ConfigError
from attnlab.exploration.base import Exploration
from attnlab.learners.base import LearnerContext
from attnlab.learners.fixed import NoLearner
from attnlab.registry import register
from attnlab.settings import build, setting


@dataclass
class Function:
    """The monitoring function of one behaviour."""
    kind: Literal["linear", "table", "derivative"] = setting(
        "linear", "period from the percept (linear, table) or from its change (derivative)")
    lowest_mc: float = setting(1.0, "linear: period at the lowest percept", unit="mc", above=0)
    highest_mc: float = setting(12.0, "linear: period at the highest percept", unit="mc", above=0)
    bend: float = setting(1.0, "linear: power of the percept; 1 is a straight line", above=0)
    table: list[int] = setting([], "table: a period for each percept, from the lowest", unit="mc")
    gain: float = setting(20.0, "derivative: 1/gain is the relative change a cycle that halves the period", unit="mc",
                          low=0)


SATISFY = {"lowest_mc": 12.0, "highest_mc": 1.0}  # a need: the greater, the more attention


@register("learner", "monitor")
class Monitor(NoLearner):
    """Burattini & Rossi 2008 (Int. J. Pattern Recognit. Artif. Intell. 22:987): the clock's period is a function of the
    percept, set by hand.

    With x in [0, 1] the percept's place among the n bins: ``linear`` p = lowest + (highest - lowest) x^bend; ``table``
    one period a percept; ``derivative``, after Weber's law, p = longest / (1 + gain |s - s'| / (s' t)), s and s' the
    percepts now and t cycles ago, counted from 1: a stimulus that changes is watched. The nearest of the granted
    periods is taken. AVOID looks more often when something is near, EAT and DRINK when the need is great; the functions
    themselves are ours, the cited work sets them for its own robots. Ignores curiosity. Draws nothing at random.
    """

    @dataclass
    class Params:
        default: Function = setting(Function(), "the function of every behaviour not named below")
        behaviours: dict[str, dict[str, Any]] = setting({name: dict(SATISFY) for name in ("eat", "drink", "give")},
                                   "by behaviour: what differs")

    params: Params

    def __init__(self, params: Params, context: LearnerContext):
        super().__init__(params, context)
        given = {f.name: getattr(params.default, f.name) for f in fields(Function)}
        own = params.behaviours.get(context.behaviour, {})
        self.set(build(Function, {**given, **own}, f"learner.behaviours.{context.behaviour}"))

    def set(self, function: Function) -> None:
        """Use this function from now on."""
        self.function, n = function, self.context.bins
        if function.kind == "table":
            if len(function.table) != n or not set(function.table) <= set(self.context.periods):
                raise ConfigError("table", f"{function.table} must be {n} periods out of {list(self.context.periods)}")
            wanted = function.table
        else:
            span = function.highest_mc - function.lowest_mc
            wanted = [function.lowest_mc + span * (i / max(1, n - 1)) ** function.bend for i in range(n)]
        self._actions = [self._nearest(period) for period in wanted]
        self.start()

    def start(self) -> None:
        self._last = -1

    def _nearest(self, period: float) -> int:
        """The index of the granted period nearest to this one; the shorter of two."""
        periods, nearest = self.context.periods, 0
        for i, granted in enumerate(periods):
            more = abs(granted - period) - abs(periods[nearest] - period)
            if more < 0.0 or (more == 0.0 and granted < periods[nearest]):
                nearest = i
        return nearest

    def decide(self, state: int, exploration: Exploration, draw: Random) -> int:
        return self.granted(state)

    def granted(self, state: int) -> int:
        """The index of the period that the function gives for what is perceived."""
        bins, periods = self.context.bins, self.context.periods
        percept, last = state % bins, self._last
        self._last = percept
        if self.function.kind != "derivative":
            return self._actions[percept]
        if last < 0:
            return self._nearest(min(periods))
        elapsed = periods[state // bins % len(periods)]
        change = abs(percept - last) / ((last + 1) * elapsed)
        return self._nearest(max(periods) / (1.0 + self.function.gain * change))
