"""Settings that are swept together, which Hydra's grammar of products cannot say."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from attnlab.config import COSMETIC
from attnlab.errors import ConfigError, nearest
from attnlab.settings import build, setting
from attnlab.stats.soundness import EARLY_EPISODES, LEAST_EARLY
from attnlab.tables.ranges import seeds

DESIGNS = ("multiverse",)
BLOCK = 4  # candidates come in designs of so many times the readings that are asked for
Variants = dict[str | None, dict[str, Any]]  # name -> setting -> value


@dataclass(frozen=True)
class Pilot:
    """Which readings are sound, as declared before any of them is run: those in whose pilots a robot survives early and
    somebody eats and drinks. The pilots' seeds take no part in the study."""
    condition: str = setting("plain", "the condition that the pilots run")
    seeds: str = setting("1000-1001", "of the pilots; none of the study's")
    episodes: int = setting(EARLY_EPISODES, "training episodes of a pilot", low=1)
    survival: float = setting(LEAST_EARLY, "a sound reading's mean survival in them is above this", unit="%", low=0,
                              high=100)
    candidates: int = setting(1536, "readings of the design, which are tried in order until there are enough", low=2)

    @property
    def numbers(self) -> list[int]:
        """The seeds."""
        return seeds("variants.pilot.seeds", self.seeds)

    def check(self, size: int, conditions: Mapping[str, Any]) -> None:
        """Raise ConfigError unless so many sound readings can be found under one of these conditions."""
        if self.condition not in conditions:
            raise ConfigError("variants.pilot.condition", f"no condition is called '{self.condition}'",
                              nearest(self.condition, filter(None, conditions)))
        if self.candidates < size:
            raise ConfigError("variants.pilot.candidates", f"is {self.candidates}, fewer than the {size} readings "
                              "asked for", "variants.size=...")
        if not self.numbers:
            raise ConfigError("variants.pilot.seeds", "names none", "1000-1001")


@dataclass(frozen=True)
class Design:
    """Readings by name: ``levels`` of each factor, and the ``settings`` that these stand for; ``size``: how many are
    asked for, of all that are here if a ``pilot`` is to find the sound ones."""
    size: int
    levels: dict[str, dict[str, str]]
    settings: dict[str, dict[str, Any]]
    conditions: dict[str, dict[str, Any]]
    pilot: Pilot | None

    def variants(self, readings: Iterable[str] | None = None, conditions: Iterable[str] | None = None) -> Variants:
        """These readings under these conditions; all if left out."""
        return {f"{name} {condition}".rstrip(): {**self.settings[name], **self.conditions[condition]}
                for name in (self.settings if readings is None else readings)
                for condition in (self.conditions if conditions is None else conditions)}


def read_variants(node: Any) -> Variants:
    """Variants by name: setting -> value. A study without any has the one variant None, which changes nothing.

    ``{design: multiverse, size: 64, seed: 0, factors: dinocera2014}`` asks
    :func:`~attnlab.launch.multiverse.design` for them; with ``conditions: {name: {setting: value}}`` each reading is
    run under each of these. With a ``pilot`` these are all candidates. Raises ConfigError.
    """
    if not node:
        return {None: {}}
    if not isinstance(node, Mapping):
        raise ConfigError("variants", f"expected {{name: {{setting: value}}}}, got {node!r}")
    design = read_design(node)
    if design is not None:
        return design.variants()
    for name, together in node.items():
        if not isinstance(together, Mapping) or not together:
            raise ConfigError(f"variants.{name}", f"expected {{setting: value}}, got {together!r}")
        for key in map(str, together):
            if key == "seed":
                raise ConfigError(f"variants.{name}.seed", "seeds are swept apart", "seed=0-4")
            if key.partition(".")[0] in (*COSMETIC, "experiment"):
                raise ConfigError(f"variants.{name}.{key}", "is one for all runs of a command",
                                  f"Type it beside: {key}=...")
    return {str(name): dict(together) for name, together in node.items()}


def read_design(node: Any) -> Design | None:
    """The design that ``variants`` asks for; None if it lists them, or there are none. Raises ConfigError."""
    if not isinstance(node, Mapping) or "design" not in node:
        return None
    if node["design"] not in DESIGNS:
        raise ConfigError("variants.design", f"'{node['design']}' is none", nearest(str(node["design"]), DESIGNS))
    known = ("design", "size", "seed", "factors", "conditions", "pilot")
    unknown = sorted(str(name) for name in node if name not in known)
    if unknown:
        raise ConfigError(f"variants.{unknown[0]}", "no such setting", nearest(unknown[0], known))
    size, seed = node.get("size", 64), node.get("seed", 0)
    for name, value, low in (("size", size, 2), ("seed", seed, 0)):
        if not isinstance(value, int) or isinstance(value, bool) or value < low:
            raise ConfigError(f"variants.{name}", f"is {value!r}, must be a whole number of at least {low}")
    from attnlab.launch.multiverse import DEFAULT, design_levels, load_factors, overrides_of
    factors = node.get("factors", DEFAULT)
    points = load_factors([str(name) for name in factors] if isinstance(factors, (list, tuple)) else str(factors))
    conditions = _conditions(node.get("conditions"), {key for levels in points.values()
                                                      for of in levels.values() for key in of})
    pilot = None if node.get("pilot") is None else build(Pilot, node["pilot"], "variants.pilot")
    if pilot is not None:
        pilot.check(size, conditions)
    if pilot is None:
        rows, width = design_levels(points, size, seed), len(str(size - 1))
    else:  # in blocks, each balanced, so that the first stay what they are when there are more
        count, width = BLOCK * size, 3
        each: dict[tuple[str, ...], dict[str, str]] = {}
        for block in range(-(-pilot.candidates // count)):
            for row in design_levels(points, count, seed + block):
                each.setdefault(tuple(row.values()), row)
        rows = list(each.values())[:pilot.candidates]
        if len(rows) < size:
            raise ConfigError("variants.size", f"is {size}, and the factors make {len(rows)} different readings",
                              "Ask for fewer, or name more factors")
    levels = {f"r{i:0{width}d}": row for i, row in enumerate(rows)}
    return Design(size, levels, {name: overrides_of(points, row) for name, row in levels.items()}, conditions, pilot)


def _conditions(node: Any, of_factors: set[str]) -> dict[str, dict[str, Any]]:
    """What each reading is run under, by name; nothing of one's own under "" if it is not said."""
    if node is None:
        return {"": {}}
    if not isinstance(node, Mapping) or len(node) < 2 or not all(isinstance(of, Mapping) and of
                                                                 for of in node.values()):
        raise ConfigError("variants.conditions", f"expected two {{name: {{setting: value}}}} or more, got {node!r}")
    for condition, of in node.items():
        for key in of:
            if key in of_factors:
                raise ConfigError(f"variants.conditions.{condition}.{key}", "is set by a factor of the design, too",
                                  "Leave it out here, or out of the factors")
    return {str(name): dict(of) for name, of in node.items()}


def as_override(value: Any) -> str:
    """A value in Hydra's grammar."""
    if isinstance(value, bool) or value is None:
        return json.dumps(value)
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, (list, tuple)):
        return "[" + ",".join(as_override(item) for item in value) + "]"
    if isinstance(value, Mapping):
        return "{" + ",".join(f"{key}:{as_override(item)}" for key, item in value.items()) + "}"
    plain = str(value)
    return plain if plain.replace("_", "").replace(".", "").replace("-", "").isalnum() else \
        "'" + plain.replace("\\", "\\\\").replace("'", "\\'") + "'"
