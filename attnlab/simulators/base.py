"""The protocol of a simulator. Sensors cost because they are read: nothing is sensed unless a method here is called."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field
from math import radians
from random import Random
from typing import Any, NamedTuple, Protocol, Self

import numpy as np
import numpy.typing as npt

from attnlab.settings import setting
from attnlab.simulators.robot import FRONT, SONARS, Camera, centre_distances
from attnlab.worlds.base import Layout


class Blob(NamedTuple):
    """What the camera says of one visible cube. ``solid`` is its index in the layout."""
    kind: str
    bearing_rad: float  # centroid, left positive
    height_px: int  # of its tallest column
    area_px: int
    distance_m: float  # the proxy computed from the height
    solid: int


class Surroundings(Protocol):
    """What may be asked about the world around a robot in machine cycle ``cycle``."""
    cycle: int

    def front_distances(self) -> list[float]:
        """Echoes of the 8 frontal sonars as distances from the robot's centre, m, left to right."""

    def ring(self) -> list[float]:
        """Echoes of all 16 sonars as distances from the robot's centre, m, in the order of the ring."""

    def blobs(self, kind: str) -> list[Blob]:
        """The cubes of this kind in view, empty sources left out."""

    def heading(self) -> float:
        """Of the robot, from odometry, rad."""


@dataclass
class SensorParams:
    """Settings that every simulator shares."""
    sonar_range_m: float = setting(5.0, "reach of a sonar; a silent one reads this", unit="m", above=0.1, high=20)
    camera_columns: int = setting(32, "camera resolution across", unit="px", low=8, high=640)
    camera_rows: int = setting(24, "camera resolution down", unit="px", low=6, high=480)
    camera_fov_deg: float = setting(60.0, "horizontal field of view", unit="deg", low=10, high=150)


@dataclass(frozen=True)
class SimulatorContext:
    """What a simulator is built from. ``safety_distance_m``: None, or the least front-sonar distance from the centre
    that does not count as a crash; ``draw``: its own random stream, for sensors and motors that are not exact."""
    layout: Layout
    dt_s: float
    max_cycles: int
    safety_distance_m: float | None = None
    draw: Random = field(default_factory=lambda: Random(0))


class Simulator(ABC):
    """A robot in a world. A simulator whose state is the trace alone writes sensors and ``advance`` only.

    ``trace`` is a (max_cycles + 1, 3) float array: the pose (x m, y m, heading rad) before the first cycle and after
    each; ``cycle`` counts the cycles moved since :meth:`place`.
    """
    name: str
    interpreted = ""  # why it runs as Python alone, where it does not compile
    recorded = False  # does all go as it went, whatever the robot does? Then behaviours must name it in ``simulators``

    def __init__(self, params: SensorParams, context: SimulatorContext):
        self.params, self.layout, self.dt_s = params, context.layout, context.dt_s
        self.safety_distance_m, self.draw = context.safety_distance_m, context.draw
        self.camera = Camera(params.camera_columns, params.camera_rows, radians(params.camera_fov_deg))
        self.trace: npt.NDArray[np.float64] = np.zeros((context.max_cycles + 1, 3))
        self.cycle = 0

    @classmethod
    def settles(cls, params: Any, config: Mapping[str, Any]) -> dict[str, Any]:  # noqa: ARG003  most read none
        """Of a ``recorded`` simulator: what in a run's config follows from the files it reads, by group, whole. Raises
        ConfigError."""
        return {}

    def told(self) -> list[str]:
        """Of a ``recorded`` simulator: what a reader of the run should know of its files, a line each."""
        return []

    def begin(self, phase: str, episode: int) -> tuple[int, tuple[float, float, float]] | None:
        """Which episode comes next; called before :meth:`place` by whoever knows it. (cycles it has, where it starts)
        if that is not the run's and the world's to say, as it is on a log."""
        return None

    def place(self, x: float, y: float, heading: float) -> None:
        """Start anew: the robot at this pose (m, m, rad), at rest, cycle 0, the world as built."""
        self.cycle = 0
        pose = self.trace[0]
        pose[0], pose[1], pose[2] = x, y, heading

    def pose(self) -> tuple[float, float, float]:
        """(x m, y m, heading rad)."""
        return tuple(self.trace[self.cycle].tolist())

    @abstractmethod
    def sonar(self, count: int = len(SONARS)) -> list[float]:
        """Ranges in m from the ring of the first ``count`` of the 16 sonars, in the order of
        :data:`attnlab.simulators.robot.SONARS`."""

    def echoes(self, count: int = len(SONARS)) -> list[float]:
        """What the first ``count`` sonars hear, m from the robot's centre."""
        return centre_distances(self.sonar(count))

    def gaps(self) -> npt.NDArray[np.float64] | None:
        """How near the nearest surface was after each cycle since :meth:`place`, m; None: the layout says."""
        return None

    @abstractmethod
    def blobs(self) -> list[Blob]:
        """A blob for every cube in view (walls are none), in the order of the layout's solids."""

    def hand(self) -> tuple[float, float]:
        """(distance m, speed m/s) of a human hand before the robot; few worlds hold one."""
        raise NotImplementedError(f"simulator '{self.name}' shows no hand")

    @abstractmethod
    def advance(self, v: float, w: float, cycles: int) -> tuple[int, bool]:
        """Move at v m/s, w rad/s for up to ``cycles`` cycles; (cycles moved, crashed).

        The crash rule is tested after every cycle, and the cycle in which it holds is the last one moved.
        """

    def snapshot(self) -> Any:
        """All that a later :meth:`restore` on this simulator needs to go on exactly from here."""
        return self.cycle, self.trace[:self.cycle + 1].copy()

    def restore(self, state: Any) -> None:
        """Go on from a snapshot."""
        self.cycle, path = state
        self.trace[:self.cycle + 1] = path

    def close(self) -> None:
        """Give back what the simulator holds; safe to call twice."""

    def too_near(self) -> bool:
        """The safety-distance rule: front-sonar minimum from the centre below the distance (False without the rule)."""
        return self.safety_distance_m is not None and \
            min(centre_distances(self.sonar(len(FRONT)))) < self.safety_distance_m

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
