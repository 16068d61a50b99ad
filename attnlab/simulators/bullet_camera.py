"""Two ways to see with Bullet: its renderer's segmentation mask, or a ray a column."""

from __future__ import annotations

from math import cos, sin
from types import ModuleType

import numpy as np

from attnlab.simulators.robot import CAMERA_HEIGHT_M, Camera

NEAR_M = 0.2
Columns = dict[int, list[int]]  # body -> its pixels in each column of the image


class Segmentation:
    """Bullet's software renderer, one body number a pixel. What is nearer than NEAR_M is cut off.

    The camera is level and at half the height of a solid, so that the lower half of the image is the upper one upside
    down: it is not rendered where all solids have that height and the rows are even.
    """

    def __init__(self, p: ModuleType, client: int, camera: Camera, reach_m: float, mirrored: bool):
        """``reach_m``: as far as anything can be; the depth of the image loses precision beyond need. ``mirrored``: do
        all solids have twice the camera's height?"""
        self._p, self._client, self._camera = p, client, camera
        self._halves = 2 if mirrored and camera.rows % 2 == 0 else 1
        self._rows = camera.rows // self._halves
        # The renderer samples a pixel at its corner of least coordinates: half a pixel to the left and up makes that
        # the centre.
        pixel = NEAR_M / camera.focal_px
        right, top = camera.columns / 2 * pixel, camera.rows / 2 * pixel
        bottom = pixel / 2 if self._halves == 2 else pixel / 2 - top
        self._projection = p.computeProjectionMatrix(pixel / 2 - right, pixel / 2 + right, bottom, pixel / 2 + top,
                                                     NEAR_M, reach_m)
        self._bins = (1 + p.getNumBodies(physicsClientId=client)) * camera.columns
        self._columns = np.tile(np.arange(camera.columns) + camera.columns, self._rows)

    def look(self, x: float, y: float, heading: float, robot: int, bodies: list[int]) -> Columns:
        """Pixels a column of every visible one of ``bodies``, seen from this pose (m, m, rad)."""
        p, cam, z = self._p, self._camera, CAMERA_HEIGHT_M
        view = p.computeViewMatrix((x, y, z), (x + cos(heading), y + sin(heading), z), (0, 0, 1))
        mask = p.getCameraImage(cam.columns, self._rows, view, self._projection, renderer=p.ER_TINY_RENDERER,
                                physicsClientId=self._client)[4]
        # a bin for every column of every body, that of no body (-1) first
        bins = np.asarray(mask).ravel() * cam.columns + self._columns
        counts = self._halves * np.bincount(bins, minlength=self._bins).reshape(-1, cam.columns)
        area = counts.sum(axis=1).tolist()
        return {body: counts[body + 1].tolist() for body in bodies if area[body + 1]}


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
