"""How near the robot's body comes to things."""

from __future__ import annotations

from collections.abc import Mapping

from attnlab.probes.base import Lived, Probe
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

    def measure(self, lived: Lived) -> Mapping[str, float]:
        gaps = clearances(lived.path[1:, :2], self.layout.solids) - RADIUS_M
        return {"clearance_min_m": float(gaps.min()), "clearance_mean_m": float(gaps.mean())}
