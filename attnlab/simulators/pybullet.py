"""The Pioneer 3-DX in pybullet: rays for sonars, the segmentation camera for blobs, contact by Bullet."""

from __future__ import annotations

import contextlib
import ctypes
import os
import weakref
from collections.abc import Iterator
from dataclasses import dataclass
from math import cos, inf, pi, sin
from operator import mul
from types import ModuleType
from typing import Any, Literal

from attnlab.arithmetic import length, total
from attnlab.registry import register
from attnlab.settings import setting
from attnlab.simulators.base import Blob, SensorParams, Simulator, SimulatorContext
from attnlab.simulators.bullet_bodies import RAY_GROUP, add_floor, add_robot, add_solids, draw_beams, look_at
from attnlab.simulators.bullet_camera import Rays, Segmentation
from attnlab.simulators.robot import (
    BEAMS,
    CAMERA_HEIGHT_M,
    RADIUS_M,
    SONAR_HEIGHT_M,
    SONAR_MIN_M,
    WHEEL_BASE_M,
    WHEEL_RADIUS_M,
    arc,
)

PHYSICS_HZ = 240
SURE_M = 0.01  # Bullet's contact is exact to some tenths of a millimetre


@contextlib.contextmanager
def silence() -> Iterator[None]:
    """Bullet prints a build line from C when it is imported; keep it out of our output."""
    null = os.open(os.devnull, os.O_WRONLY)
    saved = [(fd, os.dup(fd)) for fd in (1, 2)]
    for fd, _ in saved:
        os.dup2(null, fd)
    try:
        yield
    finally:
        ctypes.CDLL(None).fflush(None)  # C buffers the line when the output is no terminal
        for fd, copy in saved:
            os.dup2(copy, fd)
            os.close(copy)
        os.close(null)


@register("simulator", "pybullet")
class PyBullet(Simulator):
    """One physics client, owned and closed. Draws nothing at random.

    ``drive=kinematic`` advances the pose by (v, w) and asks Bullet for contacts every cycle; ``drive=wheels`` steps
    the physics at 240 Hz with motors on the two wheels. ``camera=segmentation`` counts blobs in the mask of Bullet's
    software renderer, where walls are drawn only when the world has inner ones, as nothing hides behind the outer ones;
    ``camera=rays`` sends one ray a column (docs/simulators.md says what each costs).
    """
    interpreted = "Bullet is not compiled"

    @dataclass
    class Params(SensorParams):
        drive: Literal["kinematic", "wheels"] = setting("kinematic", "how the robot moves")
        camera: Literal["segmentation", "rays"] = setting(
            "segmentation", "blobs from the rendered image, or from one ray a column")
        gui: bool = setting(False, "open Bullet's window, in which sonar beams are drawn whenever they are read")
        wheel_force_n: float = setting(40.0, "largest torque of a wheel motor", unit="N m", above=0)

    params: Params
    requires = ("pybullet",)

    def __init__(self, params: Params, context: SimulatorContext):
        super().__init__(params, context)
        with silence():
            import pybullet
        self._p = p = pybullet
        self._client = p.connect(p.GUI if params.gui else p.DIRECT)
        if self._client < 0:
            raise RuntimeError("pybullet gave no physics client" + (" (no display?)" if params.gui else ""))
        if params.gui:
            look_at(p, self._client, self.layout)
        self._finalizer = weakref.finalize(self, _disconnect, p, self._client)
        self._wheels = params.drive == "wheels"
        self._substeps = max(1, round(self.dt_s * PHYSICS_HZ))
        self._lines: list[int] = []
        self._build()
        reach, z = params.sonar_range_m, SONAR_HEIGHT_M - self._base_z
        self._ray_from = [(x, y, z) for x, y, *_ in BEAMS]
        self._ray_to = [(x + c * (o + reach), y + s * (o + reach), z) for x, y, c, s, o in BEAMS]
        self._beams = [(o, o + reach) for *_, o in BEAMS]
        self._boxes = [(b.x_m, b.y_m, cos(b.yaw_rad), sin(b.yaw_rad), b.length_m / 2, b.width_m / 2)
                       for b in self.layout.solids]
        self._free_m = 0.0  # so far the robot may move before it can touch anything
        self._pose = (0.0, 0.0, 0.0)
        reach = 10.0 + length(self.layout.width_m, self.layout.depth_m)
        self._camera: Rays | Segmentation
        if params.camera == "rays":
            self._camera = Rays(p, self._client, self.camera, self._base_z, RAY_GROUP, self._surfaces, reach)
        else:
            mirrored = all(solid.height_m == 2 * CAMERA_HEIGHT_M for solid in self.layout.solids)
            self._camera = Segmentation(p, self._client, self.camera, reach, mirrored)

    def _build(self) -> None:
        """The same bodies in the same order, so that every start is the first one."""
        p, c = self._p, self._client
        p.resetSimulation(physicsClientId=c)
        p.setPhysicsEngineParameter(deterministicOverlappingPairs=1, physicsClientId=c)
        p.setTimeStep(self.dt_s / self._substeps, physicsClientId=c)
        p.setGravity(0, 0, -9.81, physicsClientId=c)
        if self._wheels:
            add_floor(p, c)
        self._cubes, self._surfaces = add_solids(p, c, self.layout, self.params.gui)
        self._robot, self._base_z, self._joints = add_robot(p, c, self._wheels, self.params.gui)

    def place(self, x: float, y: float, heading: float) -> None:
        if self._wheels:  # contacts with the floor would be remembered; kinematic motion has no memory but the pose
            self._build()
        # A kinematic robot remembers no contact point of an earlier pose, so that contact depends on the pose alone.
        # Bullet keeps this setting for the whole process, so it is made anew for every episode.
        self._p.setPhysicsEngineParameter(contactBreakingThreshold=0.02 if self._wheels else 1e-6,
                                          physicsClientId=self._client)
        self.cycle = 0
        self._set_pose(x, y, heading)
        self._free_m = 0.0
        self.trace[0] = self._pose

    def _set_pose(self, x: float, y: float, heading: float) -> None:
        self._pose = (x, y, heading)
        self._p.resetBasePositionAndOrientation(self._robot, (x, y, self._base_z),
                                                (0.0, 0.0, sin(heading / 2), cos(heading / 2)),
                                                physicsClientId=self._client)

    def pose(self) -> tuple[float, float, float]:
        return self._pose

    def sonar(self, count: int = len(BEAMS)) -> list[float]:
        hits = self._p.rayTestBatch(self._ray_from[:count], self._ray_to[:count], parentObjectUniqueId=self._robot,
                                    collisionFilterMask=RAY_GROUP, physicsClientId=self._client)
        ranges = [max(SONAR_MIN_M, hit[2] * length - offset)
                  for hit, (offset, length) in zip(hits, self._beams, strict=False)]
        if self.params.gui:
            self._lines = draw_beams(self._p, self._client, self._robot, ranges, self._lines)
        return ranges

    def blobs(self) -> list[Blob]:
        cam, solids, blobs = self.camera, self.layout.solids, []
        for body, columns in self._camera.look(*self._pose, self._robot, list(self._cubes)).items():
            area = int(total(columns))
            centre = (total(map(mul, columns, range(cam.columns))) + area / 2) / area  # whole and half numbers: exact
            height, bearing, index = max(columns), cam.bearing(centre), self._cubes[body]
            blobs.append(Blob(solids[index].kind, bearing, height, area, cam.distance(height, bearing), index))
        return blobs

    def advance(self, v: float, w: float, cycles: int) -> tuple[int, bool]:
        step = self._roll if self._wheels else self._slide
        trace, start = self.trace, self.cycle
        for moved in range(1, cycles + 1):
            crashed = step(v, w)
            self.cycle = start + moved
            trace[self.cycle] = self._pose
            if crashed or self.too_near():
                return moved, True
        return cycles, False

    def _slide(self, v: float, w: float) -> bool:
        x, y, heading = arc(*self._pose, v, w, self.dt_s)
        self._set_pose(x, y, (heading + pi) % (2 * pi) - pi)
        self._free_m -= abs(v) * self.dt_s
        if self._free_m <= 0.0:
            self._free_m = self._clearance(x, y) - RADIUS_M - SURE_M
        if self._free_m > 0.0:
            return False
        self._p.performCollisionDetection(physicsClientId=self._client)
        return self._touching()

    def _clearance(self, x: float, y: float) -> float:
        """Distance (m) of a point to the nearest solid, infinite without solids; 0 inside."""
        nearest = inf
        for at_x, at_y, c, s, half_length, half_width in self._boxes:
            dx, dy = x - at_x, y - at_y
            along, across = abs(c * dx + s * dy) - half_length, abs(c * dy - s * dx) - half_width
            nearest = min(nearest, length(max(along, 0.0), max(across, 0.0)))
        return nearest

    def _roll(self, v: float, w: float) -> bool:
        p, c = self._p, self._client
        for joint, side in zip(self._joints, (1, -1), strict=True):
            speed = (v - side * w * WHEEL_BASE_M / 2) / WHEEL_RADIUS_M
            p.setJointMotorControl2(self._robot, joint, p.VELOCITY_CONTROL, targetVelocity=speed,
                                    force=self.params.wheel_force_n, physicsClientId=c)
        touched = False
        for _ in range(self._substeps):
            p.stepSimulation(physicsClientId=c)
            touched = touched or self._touching()
        (x, y, _), turn = p.getBasePositionAndOrientation(self._robot, physicsClientId=c)
        self._pose = (x, y, p.getEulerFromQuaternion(turn)[2])
        return touched

    def _touching(self) -> bool:
        """Does the footprint (the robot's base, not its wheels) touch a wall or a box?"""
        contacts = self._p.getContactPoints(bodyA=self._robot, linkIndexA=-1, physicsClientId=self._client)
        return any(contact[8] <= 0.0 for contact in contacts)

    def snapshot(self) -> Any:
        state = self._p.saveState(physicsClientId=self._client) if self._wheels else None
        return self._pose, self.cycle, self.trace[:self.cycle + 1].copy(), state

    def restore(self, state: Any) -> None:
        pose, self.cycle, path, saved = state
        self._free_m = 0.0
        self.trace[:self.cycle + 1] = path
        if saved is None:
            self._set_pose(*pose)
        else:
            self._p.restoreState(stateId=saved, physicsClientId=self._client)
            self._pose = pose

    def close(self) -> None:
        self._finalizer()


def _disconnect(p: ModuleType, client: int) -> None:
    with contextlib.suppress(p.error):
        p.disconnect(client)
