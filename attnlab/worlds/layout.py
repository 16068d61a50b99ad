"""A world written down box by box (conf/world/paper.yaml and others)."""

from __future__ import annotations

from dataclasses import dataclass
from difflib import get_close_matches
from itertools import combinations
from math import atan2
from typing import Any, Literal, TypedDict

from attnlab import registry
from attnlab.arithmetic import length
from attnlab.errors import ConfigError
from attnlab.registry import register
from attnlab.settings import setting
from attnlab.worlds.base import Layout, World, check_start, outer_walls
from attnlab.worlds.geometry import Solid, overlap


@dataclass
class BoxParams:
    kind: str = setting("obstacle", "obstacle, food, water or a kind of your own")
    x_m: float = setting(0.0, "centre", unit="m")
    y_m: float = setting(0.0, "centre", unit="m")
    yaw_rad: float = setting(0.0, "turned by this angle", unit="rad")
    size_m: float = setting(0.5, "edge of the square footprint", unit="m", above=0)


@dataclass
class WallParams:
    x1_m: float = setting(0.0, "one end", unit="m")
    y1_m: float = setting(0.0, "one end", unit="m")
    x2_m: float = setting(0.0, "other end", unit="m")
    y2_m: float = setting(0.0, "other end", unit="m")
    thickness_m: float = setting(0.25, "across; between the beams of the sonars the end of a thinner wall goes unheard",
                                 unit="m", above=0)


@dataclass
class StartParams:
    x_min_m: float = setting(0.0, "west edge of the start region", unit="m")
    x_max_m: float | None = setting(None, "east edge; all of the floor if left out", unit="m")
    y_min_m: float = setting(0.0, "south edge", unit="m")
    y_max_m: float | None = setting(None, "north edge; all of the floor if left out", unit="m")
    clearance_m: float = setting(0.5, "least distance of a start pose from any box or wall", unit="m", low=0.25)
    fixed: list[float] | None = setting(None, "[x m, y m, heading rad] of reading.start_pose=fixed")


@dataclass
class SourceParams:
    """How much the sources of a world give; what is left out is as the reading has it."""
    supply: Literal["endless", "depletion", "respawn", "wandering"] | None = setting(
        None, "endless, depletion, respawn or wandering; reading.food_supply if left out")
    portions: int | None = setting(None, "meals in a source; reading.food_portions if left out", low=1)
    respawn_cycles: int | None = setting(None, "reading.food_respawn_cycles if left out", unit="mc", low=1)

    def of_reading(self) -> dict[str, Any]:
        """The settings of the reading that this world changes."""
        named = {"food_supply": self.supply, "food_portions": self.portions, "food_respawn_cycles": self.respawn_cycles}
        return {name: value for name, value in named.items() if value is not None}


class StartFields(TypedDict):
    """Those of a :class:`Layout` that say where the robot may start."""
    start: tuple[float, float, float, float]
    start_clearance_m: float
    fixed_start: tuple[float, float, float] | None


def start_region(start: StartParams, width_m: float, depth_m: float) -> StartFields:
    """The start fields of a :class:`Layout` from their settings."""
    x_max = width_m if start.x_max_m is None else start.x_max_m
    y_max = depth_m if start.y_max_m is None else start.y_max_m
    if not (0 <= start.x_min_m <= x_max <= width_m and 0 <= start.y_min_m <= y_max <= depth_m):
        raise ConfigError("start", f"the region [{start.x_min_m}, {x_max}] x [{start.y_min_m}, {y_max}] is not within "
                          f"the floor of {width_m} x {depth_m} m")
    fixed = None
    if start.fixed is not None:
        if len(start.fixed) != 3:
            raise ConfigError("start.fixed", f"expected [x, y, heading], got {start.fixed}")
        x, y, heading = start.fixed
        fixed = x, y, heading
    return {"start": (start.x_min_m, x_max, start.y_min_m, y_max), "start_clearance_m": start.clearance_m,
            "fixed_start": fixed}


@register("world", "layout")
class WrittenLayout(World):
    """Arena, inner walls and boxes as given. Draws nothing at random."""

    @dataclass
    class Params:
        width_m: float = setting(4.0, "floor along x", unit="m", above=0, high=100)
        depth_m: float = setting(4.0, "floor along y", unit="m", above=0, high=100)
        boxes: list[BoxParams] = setting([], "cubes of 0.5 m by kind and place")
        walls: list[WallParams] = setting([], "inner walls by their two ends")
        start: StartParams = setting(StartParams(), "where the robot may start")
        sources: SourceParams = setting(SourceParams(), "how much food and water there is")

    params: Params

    def build(self, seed: int) -> Layout:
        """The checked layout; ConfigError if a box is outside, two overlap, or no start is free."""
        p = self.params
        boxes = [Solid(b.kind, b.x_m, b.y_m, b.size_m, b.size_m, b.yaw_rad) for b in p.boxes]
        inner = [Solid("wall", (w.x1_m + w.x2_m) / 2, (w.y1_m + w.y2_m) / 2, length(w.x2_m - w.x1_m, w.y2_m - w.y1_m),
                       w.thickness_m, atan2(w.y2_m - w.y1_m, w.x2_m - w.x1_m)) for w in p.walls]
        for group, given in (("boxes", boxes), ("walls", inner)):
            for i, solid in enumerate(given):
                if any(not (-1e-9 <= x <= p.width_m + 1e-9 and -1e-9 <= y <= p.depth_m + 1e-9)
                       for x, y in solid.corners()):
                    raise ConfigError(f"{group}[{i}]", f"the {solid.kind} at ({solid.x_m}, {solid.y_m}) reaches "
                                      f"outside the floor of {p.width_m} x {p.depth_m} m")
        sought = (getattr(spec.cls, "source", None) for spec in registry.parts.values())
        kinds = {"obstacle", "food", "water", *(kind for kind in sought if isinstance(kind, str))}
        for i, box in enumerate(p.boxes):
            close = get_close_matches(box.kind, kinds, n=1, cutoff=0.85)
            if close and box.kind not in kinds:
                raise ConfigError(f"boxes[{i}].kind", f"nobody looks for '{box.kind}'", f"Did you mean '{close[0]}'?")
        for (i, one), (j, two) in combinations(enumerate(boxes), 2):
            if overlap(one, two):
                raise ConfigError(f"boxes[{j}]", f"the {two.kind} at ({two.x_m}, {two.y_m}) overlaps boxes[{i}], the "
                                  f"{one.kind} at ({one.x_m}, {one.y_m})")
        solids = (*outer_walls(p.width_m, p.depth_m), *inner, *boxes)
        return check_start(Layout(p.width_m, p.depth_m, solids, **start_region(p.start, p.width_m, p.depth_m)))
