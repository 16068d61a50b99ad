"""The plane the paper's robot drove in: exact geometry, no physics, compiled."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, sin

import numpy as np

from attnlab.arithmetic import length
from attnlab.errors import ConfigError
from attnlab.registry import register
from attnlab.simulators.base import Blob, SensorParams, Simulator, SimulatorContext
from attnlab.simulators.robot import ALONG_AND_ACROSS2, BEAMS, CAMERA_HEIGHT_M, FRONT, RADIUS_M, SONAR_MIN_M
from attnlab.worlds.geometry import Solid


@register("simulator", "planar")
class Planar(Simulator):
    """A kinematic world like that of Stage (Vaughan 2008, Swarm Intelligence 2:189), exact where Stage has a grid.

    Sonar rays against oriented boxes, a disc against boxes for contact, and the blobs that a pinhole camera counts at
    its pixel centres, with occlusion; the unicycle's exact arc for motion. It agrees with pybullet on the
    kinematic drive (docs/certificate.md). Draws nothing at random.

    Every pose has an answer. Outside of the arena the walls are heard, and hide what is behind them. With the robot's
    centre inside a box (contact holds there) its sonars hear the box's surface from within, its camera looks
    through it.
    """

    requires = ("numba",)

    @dataclass
    class Params(SensorParams):
        pass

    def __init__(self, params: Params, context: SimulatorContext):
        super().__init__(params, context)
        from attnlab.kernels import planar
        self._sonar, self._blobs, self._advance = planar.sonar, planar.blobs, planar.advance
        solids = context.layout.solids
        for solid in solids:
            if solid.height_m != 2 * CAMERA_HEIGHT_M:
                raise ConfigError("simulator=planar", f"the {solid.kind} at ({solid.x_m}, {solid.y_m}) is "
                                  f"{solid.height_m} m high; the plane is exact for {2 * CAMERA_HEIGHT_M} m only",
                                  "Use simulator=pybullet")
        # Boxes that make blobs first, in the order of the layout; walls only hide, and are looked at last.
        self._solid = sorted(range(len(solids)), key=lambda i: (solids[i].kind == "wall", i))
        self._cubes = sum(solid.kind != "wall" for solid in solids)
        self._boxes = np.array([_row(solids[i]) for i in self._solid]).reshape(-1, 7)
        self._beams = np.array(BEAMS)
        self._along, self._across2 = np.array(ALONG_AND_ACROSS2).T.copy()
        self._front = self._beams[:len(FRONT)].copy()
        self._ranges = {count: np.zeros(count) for count in range(1, len(BEAMS) + 1)}
        self._seen, self._found = np.zeros((self._cubes, 4)), 0
        self._kinds = [solids[i].kind for i in self._solid]
        self._safety_m = context.safety_distance_m or 0.0

    def sonar(self, count: int = len(BEAMS)) -> list[float]:
        ranges = self._ranges[count]
        self._sonar(self.trace, self.cycle, self._boxes, self._beams, self.params.sonar_range_m, SONAR_MIN_M, ranges)
        return ranges.tolist()

    def blobs(self) -> list[Blob]:
        cam = self.camera
        found = self._blobs(self.trace, self.cycle, self._boxes, self._cubes, cam.columns, cam.rows, cam.focal_px,
                            CAMERA_HEIGHT_M, self._seen)
        if not found:
            return []
        blobs = []
        for box, centre, height, area in self._seen[:found].tolist():
            index, bearing = self._solid[int(box)], cam.bearing(centre)
            blobs.append(Blob(self.layout.solids[index].kind, bearing, int(height), int(area),
                              cam.distance(height, bearing), index))
        return blobs

    def advance(self, v: float, w: float, cycles: int) -> tuple[int, bool]:
        if cycles >= len(self.trace) - self.cycle:
            raise IndexError(f"{cycles} more cycles than the {len(self.trace) - 1} of an episode")
        moved = self._advance(self.trace, self.cycle, self._boxes, v, w, self.dt_s, cycles, RADIUS_M,
                              self._safety_m, self._front, self.params.sonar_range_m, SONAR_MIN_M)
        if moved < 0:
            self.cycle -= moved
            return -moved, True
        self.cycle += moved
        return moved, False


def _row(solid: Solid) -> tuple[float, ...]:
    half_length, half_width = solid.length_m / 2, solid.width_m / 2
    return (solid.x_m, solid.y_m, cos(solid.yaw_rad), sin(solid.yaw_rad), half_length, half_width,
            length(half_length, half_width))
