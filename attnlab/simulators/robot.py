"""The Pioneer 3-DX as both simulators know it: footprint, blob camera, and of :mod:`attnlab.pioneer` the sonar ring and
unicycle motion."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import atan2, cos, floor, sin, sqrt, tan

from attnlab.pioneer import FRONT as FRONT
from attnlab.pioneer import SONARS as SONARS
from attnlab.pioneer import SONARS_MM_DEG as SONARS_MM_DEG
from attnlab.pioneer import arc as arc

RADIUS_M = 0.25  # footprint: the circle swept when the robot turns on the spot
SONAR_HEIGHT_M = 0.2
CAMERA_HEIGHT_M = 0.25  # half the height of a cube, on the robot's axis
WHEEL_RADIUS_M = 0.0975
WHEEL_BASE_M = 0.33
SONAR_MIN_M = 0.1
# r + o along the ray, p across: the hit point's distance from the centre is the length of (r + along, across).
_ALONG = tuple(x * cos(a) + y * sin(a) for x, y, a in SONARS)
_ACROSS = tuple(-x * sin(a) + y * cos(a) for x, y, a in SONARS)
ALONG_AND_ACROSS2 = tuple((o, p * p) for o, p in zip(_ALONG, _ACROSS, strict=True))
# Simulated beams start where their line passes nearest to the centre, well inside the footprint, because the rear ones
# stand out of it by 6 mm and could otherwise start inside a wall: (foot x m, foot y m, cos, sin, m from foot to ring).
BEAMS = tuple((x - o * cos(a), y - o * sin(a), cos(a), sin(a), o) for (x, y, a), o in zip(SONARS, _ALONG, strict=True))


def centre_distances(ranges_m: list[float]) -> list[float]:
    """Sonar ranges (m, from the ring) as distances of the echoes from the robot's centre; the first n sonars of n."""
    return [sqrt((r + o) * (r + o) + pp) for r, (o, pp) in zip(ranges_m, ALONG_AND_ACROSS2, strict=False)]


@dataclass(frozen=True)
class Camera:
    """A pinhole blob camera at the robot's centre, looking ahead. ``columns`` x ``rows`` square pixels."""
    columns: int
    rows: int
    fov_rad: float  # horizontal

    @cached_property
    def focal_px(self) -> float:
        return self.columns / 2 / tan(self.fov_rad / 2)

    def rows_within(self, half_px: float) -> int:
        """How many pixel centres of a column lie within ``half_px`` of the image's middle line."""
        if half_px >= self.rows / 2:
            return self.rows
        return 2 * floor(half_px + 0.5) if self.rows % 2 == 0 else 2 * floor(half_px) + 1

    def bearing(self, column: float) -> float:
        """Bearing (rad, left positive) of a column coordinate (0 = left edge of the image)."""
        return atan2(self.columns / 2 - column, self.focal_px)

    def column(self, bearing_rad: float) -> float:
        """The column coordinate of a bearing."""
        return self.columns / 2 - self.focal_px * tan(bearing_rad)

    def distance(self, height_px: float, bearing_rad: float, height_m: float = 0.5) -> float:
        """The distance proxy: how far from the centre a cube is whose blob is ``height_px`` tall (m)."""
        return self.focal_px * height_m / height_px / cos(bearing_rad)
