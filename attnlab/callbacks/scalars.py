"""What dashboards are told of an episode: few numbers, under the names of the tables."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from attnlab.probes.base import Lived


def scalars(lived: Lived) -> dict[str, float]:
    """``phase/name`` -> number: survival, means of energy, wanting, safety and needs, path if it is known, and for each
    behaviour its activations, mean period and sum of rewards (eq 4, without the penalty)."""
    steps = np.diff(lived.path[:, :2], axis=0)
    found = {"survival": lived.cycles / lived.max_cycles, "energy_mean": float(lived.energy.mean()),
             "wanting_mean": float(lived.wanting.mean()),
             **{f"{name}_mean": float(values.mean()) for name, values in lived.needs.items()}}
    if not np.isnan(steps).any():
        found["path_m"] = float(np.hypot(steps[:, 0], steps[:, 1]).sum())
    if lived.safety is not None:
        found["safety_mean"] = float(lived.safety.mean())
    for name, looks in lived.looks.items():
        found[f"{name}/activations"] = float(len(looks))
        found[f"{name}/period_mean"] = sum(look.period for look in looks) / len(looks)
        found[f"{name}/reward"] = float(sum(look.reward or 0.0 for look in looks))
    return {f"{lived.phase}/{name}": value for name, value in found.items()}


def flat(config: Mapping[str, Any], above: str = "") -> dict[str, Any]:
    """A resolved config with dotted names: ``learner.alpha`` -> 0.8."""
    found: dict[str, Any] = {}
    for key, value in config.items():
        name = f"{above}{key}"
        found |= flat(value, f"{name}.") if isinstance(value, Mapping) and value else {name: value}
    return found
