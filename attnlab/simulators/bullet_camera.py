"""Two ways to see with Bullet: its renderer's segmentation mask, or a ray a column."""

from __future__ import annotations

from math import cos, sin
from types import ModuleType

import numpy as np

from attnlab.simulators.robot import CAMERA_HEIGHT_M, Camera

NEAR_M = 0.2
Columns = dict[int, list[int]]  # body -> its pixels in each column of the image


class Segmentation:
    """Bullet's software renderer, one body number a pixel. What is nearer than NEAR_M is cut off."""

    def __init__(self, p: ModuleType, client: int, camera: Camera, reach_m: float):
        """``reach_m``: as far as anything can be; the depth of the image loses precision beyond need."""
        self._p, self._client, self._camera = p, client, camera
        # The renderer samples a pixel at its corner of least coordinates: half a pixel to the left and up makes that
        # the centre.
        pixel = NEAR_M / camera.focal_px
        right, top = camera.columns / 2 * pixel, camera.rows / 2 * pixel
        self._projection = p.computeProjectionMatrix(pixel / 2 - right, pixel / 2 + right, pixel / 2 - top,
                                                     pixel / 2 + top, NEAR_M, reach_m)

    def look(self, x: float, y: float, heading: float, robot: int, bodies: list[int]) -> Columns:
        """Pixels a column of every visible one of ``bodies``, seen from this pose (m, m, rad)."""
        p, cam, z = self._p, self._camera, CAMERA_HEIGHT_M
        view = p.computeViewMatrix((x, y, z), (x + cos(heading), y + sin(heading), z), (0, 0, 1))
        mask = p.getCameraImage(cam.columns, cam.rows, view, self._projection, renderer=p.ER_TINY_RENDERER,
                                flags=p.ER_SEGMENTATION_MASK_OBJECT_AND_LINKINDEX, physicsClientId=self._client)[4]
        mask = np.asarray(mask).reshape(cam.rows, cam.columns)
        present = set(np.unique(mask).tolist())
        return {body: (mask == body).sum(axis=0).tolist() for body in bodies if body in present}


class Rays:
    """One ray for each column, at the height of the camera; the rows follow from its depth, as all solids are 0.5 m
    high and the camera is at half of that."""

    def __init__(self, p: ModuleType, client: int, camera: Camera, base_z: float, group: int,
                 surfaces: dict[int, int], reach_m: float):
        """``surfaces``: body hit by a ray -> body it belongs to; ``reach_m``: as far as anything can be."""
        self._p, self._client, self._camera, self._group, self._surfaces = p, client, camera, group, surfaces
        z = CAMERA_HEIGHT_M - base_z
        self._depth = reach_m
        self._from = [(0.0, 0.0, z)] * camera.columns
        self._to = [(reach_m, reach_m * (camera.columns / 2 - column - 0.5) / camera.focal_px, z)
                    for column in range(camera.columns)]

    def look(self, x: float, y: float, heading: float, robot: int, bodies: list[int]) -> Columns:
        """Pixels a column of every visible one of ``bodies``, seen from where the robot is."""
        cam = self._camera
        seen: Columns = {}
        hits = self._p.rayTestBatch(self._from, self._to, parentObjectUniqueId=robot, collisionFilterMask=self._group,
                                    physicsClientId=self._client)
        for column, hit in enumerate(hits):
            body = self._surfaces.get(hit[0])
            if body is not None:
                depth = hit[2] * self._depth
                rows = cam.rows_within(cam.focal_px * CAMERA_HEIGHT_M / depth) if depth > 0 else cam.rows
                seen.setdefault(body, [0] * cam.columns)[column] = rows
        return {body: seen[body] for body in bodies if body in seen and any(seen[body])}
