"""Rules that make no sense are refused: a rule must be able to fail, and to hold."""

from __future__ import annotations

from attnlab.claims.parts import Part
from attnlab.errors import ConfigError
from attnlab.measures.base import Measure

TIMES = ("order", "median")  # tests for values that may be inf


def can_fail_and_hold(part: Part, measure: Measure, where: str) -> None:
    """Raise ConfigError for a comparison that no run could fail, or none could pass, by the bounds of its measure."""
    name = part.measure_name
    if measure.censored and part.test not in TIMES:
        raise ConfigError(f"{where}.test", f"'{name}' is never for some seeds, which has no mean",
                          f"Use {' or '.join(TIMES)}")
    low, high = measure.bounds
    if part.test in ("paired", "not_lower"):
        low, high = low - high, high - low
    elif part.test == "order":
        low, high = -100.0, 100.0
    if part.test == "not_lower":
        if -(part.margin or 0.0) <= low:
            raise ConfigError(f"{where}.margin", f"cannot fail: '{name}' cannot be lower by more than {-low:g}")
        return
    r = part.reference
    never, always = {"higher": (r >= high, r <= low), "at_least": (r > high, r <= low),
                     "lower": (r <= low, r >= high), "at_most": (r < low, r >= high)}.get(part.direction,
                                                                                        (False, False))
    if part.test == "permutation":
        return
    if always and low < high:
        raise ConfigError(f"{where}.reference", f"cannot fail: '{name}' is between {low:g} and {high:g}")
    if never:
        raise ConfigError(f"{where}.reference", f"cannot hold: '{name}' is between {low:g} and {high:g}")
    if part.number is not None and part.known is not None:
        if part.number + part.known < low or part.number - part.known > high:
            raise ConfigError(f"{where}.number", f"cannot hold: '{name}' is between {low:g} and {high:g}")
        if part.direction == "about" and part.number - part.known <= low and part.number + part.known >= high:
            raise ConfigError(f"{where}.tolerance", f"cannot fail: '{name}' is between {low:g} and {high:g}")
