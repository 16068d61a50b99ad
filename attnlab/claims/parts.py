"""What a claims file is made of: rules, roles, claims and their comparisons, as typed settings."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal

from attnlab.errors import ConfigError
from attnlab.settings import setting

PAIRED = ("paired", "not_lower", "order")  # tests that hold one role against another, seed by seed
DIRECTIONS = ("higher", "lower", "at_least", "at_most")


@dataclass
class Rules:
    confidence: float = setting(0.95, "of all intervals", above=0.5, high=0.999)
    resamples: int = setting(4000, "bootstrap samples of the BCa interval shown beside", low=100, high=1_000_000)
    least_seeds: int = setting(6, "fewer seeds make a claim untestable", low=3)
    contradict_seeds: int = setting(8, "fewer contradict no claim of several comparisons", low=3)
    seed: int = setting(0, "of bootstrap and permutations", low=0)


@dataclass
class Role:
    label: str = setting("", "what it is called")
    where: dict[str, Any] = setting({}, "settings of its runs, e.g. {curiosity: litman}")


@dataclass
class Part:
    """One comparison. All numbers in ``unit``."""
    measure: Any = setting(None, "{name: ..., and its parameters}")
    test: Literal["paired", "level", "not_lower", "order", "median", "permutation"] = setting(
        "paired", "paired: role - against by seed; level: one role against reference; not_lower: paired, may be lower "
        "by margin; order: in how many seeds role is above against, less the reverse; median: one role's median "
        "against reference, where never counts as later than all; permutation: levels exchanged")
    direction: Literal["higher", "lower", "at_least", "at_most", "about"] = setting(
        "about", "claimed side of the reference")
    role: str = setting("treatment", "whose level, or who is compared")
    against: str = setting("control", "whom it is compared with")
    reference: float = setting(0.0, "what the direction is against")
    number: float | None = setting(None, "what the paper found")
    tolerance: float | None = setting(None, "how far from the number counts as the same; left out: half of the paper's "
                                            "effect, in quadrature with its standard error", low=0)
    deviations: list[float] | None = setting(None, "the paper's standard deviations over its episodes")
    episodes: int = setting(100, "of the paper, behind the deviations", low=1)
    margin: float | None = setting(None, "of not_lower", low=0)
    unit: str | None = setting(None, "unit of the measure; must be the measure's own")
    forms: dict[str, Any] = setting({}, "other ways to measure it: name -> settings of the measure")
    counts: bool = setting(True, "false: shown, but no part of the verdict")
    note: str = setting("", "shown beside it")

    def __post_init__(self) -> None:
        if self.measure is None:
            raise ConfigError("measure", "is missing", "Write measure: {name: survival}")
        if self.unit is None:
            raise ConfigError("unit", "is missing", "Name the measure's unit, so that nobody misreads a number")
        for name in ("tolerance", "deviations"):
            if self.number is None and getattr(self, name) is not None:
                raise ConfigError("number", "is missing", f"{name} belongs to a number")
        if self.deviations is not None and (not self.deviations or min(self.deviations) < 0):
            raise ConfigError("deviations", f"expected numbers of 0 or more, got {self.deviations}")
        if self.test in ("paired", "level", "order", "median") and self.direction == "about" and self.known is None:
            raise ConfigError("direction", "is missing", f"One of {', '.join(DIRECTIONS)}, or a number to be near "
                              "with its tolerance")
        if self.test == "not_lower" and self.margin is None:
            raise ConfigError("margin", "is missing", "How much lower still counts as not lower?")
        if self.test in PAIRED and self.role == self.against:
            raise ConfigError("against", f"compares '{self.role}' with itself")
        for name, form in self.forms.items():
            if not isinstance(form, dict):
                raise ConfigError(f"forms.{name}", f"expected settings of the measure, got {form!r}")

    @property
    def roles(self) -> tuple[str, ...]:
        """Who is measured."""
        return (self.role, self.against) if self.test in PAIRED else (self.role,)

    @property
    def node(self) -> dict[str, Any]:
        """The measure with its settings."""
        return {"name": self.measure} if isinstance(self.measure, str) else dict(self.measure)

    @property
    def measure_name(self) -> str:
        return str(self.node.get("name"))

    @property
    def known(self) -> float | None:
        """How far from the number counts as the same; None if that is not known, or there is no number.

        Half of the paper's effect, in quadrature with its standard error: over n episodes sqrt(sum of SD^2 / n). A
        number with neither tolerance nor deviations is one whose precision nobody knows.
        """
        if self.tolerance is not None or self.number is None or self.deviations is None:
            return self.tolerance
        error = math.sqrt(sum(sd ** 2 for sd in self.deviations) / self.episodes)
        return math.hypot((self.number - self.reference) / 2, error)


@dataclass
class Claim:
    title: str = setting("", "in a few words")
    where: str = setting("", "where in the paper")
    says: str = setting("", "what it says there")
    mind: str = setting("", "what a reader must know before believing a verdict on it")
    parts: list[Part] = setting([], "comparisons; all that count must hold")

    def __post_init__(self) -> None:
        for name in ("title", "where", "says"):
            if not getattr(self, name).strip():
                raise ConfigError(name, "is missing")
        if not any(part.counts for part in self.parts):
            raise ConfigError("parts", "has no comparison that counts")
