"""What a world is once it stands: solids, and where the robot may start."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from math import pi
from random import Random
from typing import Any

import numpy as np

from attnlab.errors import ConfigError
from attnlab.worlds.geometry import Solid, clearance, clearances, is_clear

WALL_M = 0.1  # thickness of the walls around an arena, outside of its floor
GRID_M = 0.05  # of the search for free starts


@dataclass(frozen=True)
class Layout:
    """A checked world.

    ``solids``: walls first, then the boxes. ``start``: (x_min, x_max, y_min, y_max) of the start region in m.
    ``start_clearance_m``: least distance of a start pose from any solid. ``fixed_start``: (x, y, heading) or None.
    """
    width_m: float
    depth_m: float
    solids: tuple[Solid, ...]
    start: tuple[float, float, float, float]
    start_clearance_m: float
    fixed_start: tuple[float, float, float] | None = None

    def free_points(self) -> Iterator[tuple[float, float]]:
        """Points of a 0.05 m grid over the start region that are clear of every solid."""
        x_min, x_max, y_min, y_max = self.start
        nx, ny = (max(1, round((high - low) / GRID_M)) for low, high in ((x_min, x_max), (y_min, y_max)))
        row = np.empty((ny + 1, 2))
        row[:, 1] = y_min + (y_max - y_min) * np.arange(ny + 1) / ny
        for i in range(nx + 1):
            row[:, 0] = x = x_min + (x_max - x_min) * i / nx
            for y in row[clearances(row, self.solids) >= self.start_clearance_m, 1].tolist():
                yield x, y

    def random_start(self, draw: Random) -> tuple[float, float, float]:
        """A free pose (x m, y m, heading rad): uniform over the start region less what is too near to a solid.

        A region of no area (a point, a line) or one that a thousand draws miss falls back on the grid's free points.
        """
        x_min, x_max, y_min, y_max = self.start
        for _ in range(1000):
            x, y = draw.uniform(x_min, x_max), draw.uniform(y_min, y_max)
            if is_clear(x, y, self.solids, self.start_clearance_m):
                break
        else:
            x, y = draw.choice(list(self.free_points()))
        return x, y, draw.uniform(-pi, pi)

    @cached_property
    def steady_start(self) -> tuple[float, float, float]:
        """The one start pose of ``reading.start_pose=fixed``: the world's own, or the free point nearest its middle."""
        if self.fixed_start is not None:
            return self.fixed_start
        x0, y0 = (self.start[0] + self.start[1]) / 2, (self.start[2] + self.start[3]) / 2
        x, y = min(self.free_points(), key=lambda p: ((p[0] - x0) ** 2 + (p[1] - y0) ** 2, p))
        return x, y, 0.0


class World(ABC):
    """Builds the layout of a run."""
    name: str

    def __init__(self, params: Any, context: None = None):
        self.params = params

    @abstractmethod
    def build(self, seed: int) -> Layout:
        """The checked layout of this seed, from the seed alone; ConfigError naming what cannot be."""


def outer_walls(width_m: float, depth_m: float) -> list[Solid]:
    """Four walls whose inner faces bound the floor [0, width] x [0, depth]."""
    t, w, d = WALL_M, width_m, depth_m
    return [Solid("wall", w / 2, -t / 2, w + 2 * t, t), Solid("wall", w / 2, d + t / 2, w + 2 * t, t),
            Solid("wall", -t / 2, d / 2, t, d), Solid("wall", w + t / 2, d / 2, t, d)]


def check_start(layout: Layout) -> Layout:
    """The layout, or a ConfigError if the robot could not start anywhere."""
    if next(layout.free_points(), None) is None:
        raise ConfigError("start", f"no free start: every point of the start region is nearer than "
                          f"{layout.start_clearance_m} m to a box or wall", "Move a box, or widen start")
    if layout.fixed_start is not None:
        x, y, _ = layout.fixed_start
        if clearance(x, y, layout.solids) < layout.start_clearance_m:
            raise ConfigError("fixed_start", f"({x}, {y}) is nearer than {layout.start_clearance_m} m to a box or wall")
    return layout
