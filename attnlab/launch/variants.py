"""Settings that are swept together, which Hydra's grammar of products cannot say."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from attnlab.config import COSMETIC
from attnlab.errors import ConfigError, nearest

DESIGNS = ("multiverse",)


def read_variants(node: Any) -> dict[str | None, dict[str, Any]]:
    """Variants by name: setting -> value. A study without any has the one variant None, which changes nothing.

    ``{design: multiverse, size: 64, seed: 0, factors: dinocera2014}`` asks
    :func:`~attnlab.launch.multiverse.design` for them; with ``conditions: {name: {setting: value}}`` each reading is
    run under each of these. Raises ConfigError.
    """
    if not node:
        return {None: {}}
    if not isinstance(node, Mapping):
        raise ConfigError("variants", f"expected {{name: {{setting: value}}}}, got {node!r}")
    if "design" in node:
        return _design(node)
    for name, together in node.items():
        if not isinstance(together, Mapping) or not together:
            raise ConfigError(f"variants.{name}", f"expected {{setting: value}}, got {together!r}")
        for setting in together:
            if setting == "seed":
                raise ConfigError(f"variants.{name}.seed", "seeds are swept apart", "seed=0-4")
            if str(setting).partition(".")[0] in (*COSMETIC, "experiment"):
                raise ConfigError(f"variants.{name}.{setting}", "is one for all runs of a command",
                                  f"Type it beside: {setting}=...")
    return {str(name): dict(together) for name, together in node.items()}


def _design(node: Mapping[str, Any]) -> dict[str | None, dict[str, Any]]:
    if node["design"] not in DESIGNS:
        raise ConfigError("variants.design", f"'{node['design']}' is none", nearest(str(node["design"]), DESIGNS))
    known = ("design", "size", "seed", "factors", "conditions")
    unknown = sorted(str(name) for name in node if name not in known)
    if unknown:
        raise ConfigError(f"variants.{unknown[0]}", "no such setting", nearest(unknown[0], known))
    size, seed = node.get("size", 64), node.get("seed", 0)
    for name, value, low in (("size", size, 2), ("seed", seed, 0)):
        if not isinstance(value, int) or isinstance(value, bool) or value < low:
            raise ConfigError(f"variants.{name}", f"is {value!r}, must be a whole number of at least {low}")
    from attnlab.launch.multiverse import DEFAULT, design
    readings = design(size, seed, str(node.get("factors", DEFAULT)))
    width = len(str(len(readings) - 1))
    named: dict[str | None, dict[str, Any]] = {f"r{i:0{width}d}": dict(reading) for i, reading in enumerate(readings)}
    conditions = node.get("conditions")
    if conditions is None:
        return named
    if not isinstance(conditions, Mapping) or len(conditions) < 2 or not all(
            isinstance(of, Mapping) and of for of in conditions.values()):
        raise ConfigError("variants.conditions", f"expected two {{name: {{setting: value}}}} or more, got "
                          f"{conditions!r}")
    for condition, of in conditions.items():
        for setting in of:
            if any(setting in reading for reading in readings):
                raise ConfigError(f"variants.conditions.{condition}.{setting}", "is set by a factor of the design, too",
                                  f"Leave it out here, or out of {node.get('factors', DEFAULT)}.yaml")
    return {f"{name} {condition}": {**reading, **of} for name, reading in named.items()
            for condition, of in conditions.items()}


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
