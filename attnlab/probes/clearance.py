"""How near the robot's body comes to things."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from attnlab.errors import ConfigError
from attnlab.probes.base import Lived, Probe, ProbeContext
from attnlab.registry import register
from attnlab.simulators.robot import RADIUS_M
from attnlab.tables.schema import Column
from attnlab.worlds.geometry import clearances


@register("probe", "clearance")
class Clearance(Probe):
    """Distance of the round body's edge to the nearest surface, from path and layout: what the robot did not know, for
    no sensor is read. Below 0 it overlaps something. Draws nothing at random."""
    columns = {"clearance_min_m": Column("float64", "m", "from the body's edge to the nearest surface: smallest"),
               "clearance_mean_m": Column("float64", "m", "the same over the cycles: mean")}

    def __init__(self, params: Any, context: ProbeContext):
        super().__init__(params, context)
        if not self.layout.solids:
            raise ConfigError("probe.clearance", "this world has no surface to be near to", "Leave it out")

    def measure(self, lived: Lived) -> Mapping[str, float]:
        gaps = clearances(lived.path[1:, :2], self.layout.solids) - RADIUS_M
        return {"clearance_min_m": float(gaps.min()), "clearance_mean_m": float(gaps.mean())}
