"""The run's world in Bullet's software renderer: from outside, and as the robot sees it."""

from __future__ import annotations

from math import cos, pi, sin
from typing import Any

import numpy as np
import numpy.typing as npt

from attnlab.simulators.bullet_bodies import add_robot, add_solids
from attnlab.simulators.pybullet import silence
from attnlab.simulators.robot import CAMERA_HEIGHT_M, SONAR_HEIGHT_M, SONARS
from attnlab.worlds.base import Layout

Image = npt.NDArray[np.uint8]
Pixel = tuple[float, float]
Pose = tuple[float, float, float]


class Scene:
    """Bullet without physics: bodies are put where they are recorded. Use as a context manager; ``width``, ``height``:
    of the view from outside, px."""

    def __init__(self, layout: Layout, width: int, height: int):
        with silence():
            import pybullet
        self._p = p = pybullet
        self._client = c = p.connect(p.DIRECT)
        self.width, self.height = width, height
        floor = p.createVisualShape(p.GEOM_BOX, halfExtents=(layout.width_m / 2, layout.depth_m / 2, 0.005),
                                    rgbaColor=(0.93, 0.93, 0.9, 1), physicsClientId=c)
        p.createMultiBody(0, -1, floor, (layout.width_m / 2, layout.depth_m / 2, -0.005), physicsClientId=c)
        add_solids(p, c, layout, True)
        self._robot, self._base_z, _ = add_robot(p, c, False, True)
        nose = p.createVisualShape(p.GEOM_BOX, halfExtents=(0.1, 0.03, 0.02), rgbaColor=(1, 1, 1, 1), physicsClientId=c)
        self._nose = p.createMultiBody(0, -1, nose, physicsClientId=c)
        far = max(layout.width_m, layout.depth_m)
        eye = (layout.width_m / 2, layout.depth_m / 2 - 0.75 * far, 1.15 * far)
        self._view = p.computeViewMatrix(eye, (layout.width_m / 2, layout.depth_m / 2 - 0.03 * far, 0), (0, 0, 1))
        self._projection = p.computeProjectionMatrixFOV(45.0, width / height, 0.05, 4 * far)
        self._both = np.array(self._projection).reshape(4, 4).T @ np.array(self._view).reshape(4, 4).T
        self._far = 4 * far

    def __enter__(self) -> Scene:
        return self

    def __exit__(self, *_: object) -> None:
        self._p.disconnect(self._client)

    def outside(self, pose: Pose) -> Image:
        """The arena with the robot at this pose (m, m, rad)."""
        x, y, heading = pose
        turn = (0.0, 0.0, sin(heading / 2), cos(heading / 2))
        self._p.resetBasePositionAndOrientation(self._robot, (x, y, self._base_z), turn, physicsClientId=self._client)
        self._p.resetBasePositionAndOrientation(self._nose, (x + 0.09 * cos(heading), y + 0.09 * sin(heading), 0.22),
                                                turn, physicsClientId=self._client)
        return self._picture(self.width, self.height, self._view, self._projection)

    def inside(self, pose: Pose, width: int, height: int, fov_rad: float) -> Image:
        """What the camera on the robot sees."""
        (x, y, heading), p, z = pose, self._p, CAMERA_HEIGHT_M
        view = p.computeViewMatrix((x, y, z), (x + cos(heading), y + sin(heading), z), (0, 0, 1))
        up_deg = 2 * np.arctan(np.tan(fov_rad / 2) * height / width) * 180 / pi
        return self._picture(width, height, view, p.computeProjectionMatrixFOV(up_deg, width / height, 0.2, self._far))

    def _picture(self, width: int, height: int, view: Any, projection: Any) -> Image:
        p = self._p
        pixels = p.getCameraImage(width, height, view, projection, shadow=0, renderer=p.ER_TINY_RENDERER,
                                  lightDirection=(2, -3, 6), physicsClientId=self._client)[2]
        return np.asarray(pixels, np.uint8).reshape(height, width, 4)[:, :, :3].copy()

    def pixel(self, x: float, y: float, z: float) -> Pixel:
        """Where a point (m) is in the view from outside, px from its top left corner."""
        clip = self._both @ (x, y, z, 1.0)
        return (clip[0] / clip[3] + 1) / 2 * self.width, (1 - clip[1] / clip[3]) / 2 * self.height

    def beams(self, pose: Pose, ranges: list[float]) -> list[tuple[Pixel, Pixel]]:
        """Sonar beams of these ranges (m, from the ring) as lines in the view from outside."""
        (x, y, heading), c, s = pose, cos(pose[2]), sin(pose[2])
        lines = []
        for (sx, sy, angle), reach in zip(SONARS, ranges, strict=False):
            fx, fy = x + c * sx - s * sy, y + s * sx + c * sy
            tx, ty = fx + reach * cos(heading + angle), fy + reach * sin(heading + angle)
            lines.append((self.pixel(fx, fy, SONAR_HEIGHT_M), self.pixel(tx, ty, SONAR_HEIGHT_M)))
        return lines
