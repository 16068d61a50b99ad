"""What a search may choose from: the sweeps that were typed, as distributions of Optuna."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from hydra.core.override_parser.types import IntervalSweep, Override, RangeSweep

from attnlab.errors import ConfigError
from attnlab.launch.expand import choices, name_of

DIGITS = 4  # of a number that is chosen: more would be noise in names and commands


@dataclass(frozen=True)
class Axis:
    """A setting and what it may be: ``words``, or all numbers from ``low`` to ``high`` (whole ones, or every
    ``step``-th one, or evenly by factors: ``log``)."""
    name: str
    words: tuple[str, ...] = ()
    low: float = 0.0
    high: float = 0.0
    step: float | None = None
    whole: bool = False
    log: bool = False

    @property
    def edges(self) -> Sequence[str]:
        """Both ends of a range, or all words: what is checked before anything runs."""
        return self.words or (self.text(self.low), self.text(self.high))

    def text(self, value: Any) -> str:
        """A value of Optuna's as it is typed."""
        if self.words:
            return str(value)
        if self.whole:
            return str(int(value))
        if self.step is not None:
            return f"{value:.10g}"
        return repr(min(self.high, max(self.low, float(f"{value:.{DIGITS}g}"))))

    def distribution(self) -> Any:
        """For Optuna."""
        from optuna.distributions import CategoricalDistribution, FloatDistribution, IntDistribution
        if self.words:
            return CategoricalDistribution(self.words)
        if self.whole:
            return IntDistribution(int(self.low), int(self.high), log=self.log, step=int(self.step or 1))
        return FloatDistribution(self.low, self.high, log=self.log, step=self.step)


def axis(override: Override, holds: Any) -> Axis:
    """What a sweep may choose from. ``holds``: what the setting is by default; where that is a whole number, so is all
    of a range with whole ends. Raises ConfigError."""
    name, sweep = name_of(override), override.value()
    ends: Any = (sweep.start, sweep.end) if isinstance(sweep, IntervalSweep) else None
    typed = str(override.input_line).partition("=")[2]
    if isinstance(sweep, IntervalSweep):
        low, high, log = float(ends[0]), float(ends[1]), "log" in sweep.tags
        if not (math.isfinite(low) and math.isfinite(high) and low < high):
            raise ConfigError(name, f"{typed} is no range", "interval(LOW,HIGH), two numbers, the lower one first")
        if sweep.tags - {"log"}:
            raise ConfigError(name, f"{typed} has a tag that means nothing here", "tag(log,interval(0.01,1))")
        if log and low <= 0:
            raise ConfigError(name, f"{typed} begins at {low:g}, and factors need more than 0",
                              "tag(log,interval(0.01,1))")
        whole = isinstance(ends[0], int) or (isinstance(holds, int) and not isinstance(holds, bool))
        return Axis(name, (), low, high, None, whole and low.is_integer() and high.is_integer(), log)
    words = tuple(text.partition("=")[2] for text in choices(override))
    if isinstance(sweep, RangeSweep) and len(words) > 1:
        numbers = sorted(map(float, words))
        whole = all(number.is_integer() for number in numbers)
        return Axis(name, (), numbers[0], numbers[-1], abs(float(sweep.step)), whole)
    return Axis(name, words)
