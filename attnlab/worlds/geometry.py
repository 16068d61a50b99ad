"""Plane geometry of solids: oriented boxes, all standing on the floor. Metres and radians throughout."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import cos, sin

import numpy as np
import numpy.typing as npt

from attnlab.arithmetic import length


@dataclass(frozen=True)
class Solid:
    """An upright box: centre (x, y), full size along its own axes, turned by yaw, from the floor to height."""
    kind: str  # wall | obstacle | food | water | a user's own
    x_m: float
    y_m: float
    length_m: float
    width_m: float
    yaw_rad: float = 0.0
    height_m: float = 0.5

    @cached_property
    def footprint(self) -> tuple[float, float, float, float]:
        """Cosine and sine of its yaw, half its length and half its width (m)."""
        return cos(self.yaw_rad), sin(self.yaw_rad), self.length_m / 2, self.width_m / 2

    def corners(self) -> list[tuple[float, float]]:
        """The four corners, counter-clockwise, in the world frame."""
        c, s = cos(self.yaw_rad), sin(self.yaw_rad)
        half = ((1, 1), (-1, 1), (-1, -1), (1, -1))
        return [(self.x_m + c * i * self.length_m / 2 - s * j * self.width_m / 2,
                 self.y_m + s * i * self.length_m / 2 + c * j * self.width_m / 2) for i, j in half]


def distance(x: float, y: float, solid: Solid) -> float:
    """From a point to the solid's footprint; 0 inside."""
    c, s, half_length, half_width = solid.footprint
    dx, dy = x - solid.x_m, y - solid.y_m
    along, across = abs(c * dx + s * dy) - half_length, abs(-s * dx + c * dy) - half_width
    return length(max(along, 0.0), max(across, 0.0))


def clearance(x: float, y: float, solids: tuple[Solid, ...]) -> float:
    """Distance from a point to the nearest solid; infinite without solids."""
    return min((distance(x, y, solid) for solid in solids), default=float("inf"))


def is_clear(x: float, y: float, solids: tuple[Solid, ...], least_m: float) -> bool:
    """Is every solid at least this far from a point?"""
    return all(distance(x, y, solid) >= least_m for solid in solids)


def clearances(xy: npt.NDArray[np.float64], solids: tuple[Solid, ...]) -> npt.NDArray[np.float64]:
    """:func:`clearance` of many points, shape (n, 2), at once: shape (n,)."""
    nearest = np.full(len(xy), np.inf)
    for solid in solids:
        c, s, half_length, half_width = solid.footprint
        dx, dy = xy[:, 0] - solid.x_m, xy[:, 1] - solid.y_m
        along = np.maximum(np.abs(c * dx + s * dy) - half_length, 0.0)
        across = np.maximum(np.abs(-s * dx + c * dy) - half_width, 0.0)
        np.minimum(nearest, np.sqrt(along * along + across * across), out=nearest)
    return nearest


def overlap(one: Solid, two: Solid) -> bool:
    """Do two footprints share area (separating axis theorem; touching edges do not count)?"""
    for box in (one, two):
        for angle in (box.yaw_rad, box.yaw_rad + 1.5707963267948966):
            axis = cos(angle), sin(angle)
            first = [axis[0] * x + axis[1] * y for x, y in one.corners()]
            second = [axis[0] * x + axis[1] * y for x, y in two.corners()]
            if max(first) <= min(second) + 1e-9 or max(second) <= min(first) + 1e-9:
                return False
    return True
