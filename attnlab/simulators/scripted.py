"""A hand that moves as it is told, and a robot on an empty plane that may watch it."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass
from itertools import pairwise
from math import pi
from pathlib import Path

from attnlab.arithmetic import distance
from attnlab.errors import ConfigError
from attnlab.registry import register
from attnlab.settings import setting
from attnlab.simulators.base import Blob, SensorParams, Simulator, SimulatorContext
from attnlab.simulators.robot import SONARS, arc

Point = tuple[float, float, float]


@register("simulator", "scripted")
class Scripted(Simulator):
    """A hand's trajectory before the robot's end-effector, from a CSV file or from keyframes.

    The CSV has columns ``t_s, x_m, y_m`` and perhaps ``z_m``: the hand relative to the end-effector, joined by straight
    lines. Keyframes are [t s, distance m]; between two of them the hand follows the minimum-jerk profile of human
    reaching, 10 u^3 - 15 u^4 + 6 u^5 (Flash & Hogan 1985, J. Neurosci. 5:1688). Before the first and after the last
    point it rests. :meth:`hand` tells what a behaviour may know. The plane is empty: sonars hear nothing, nothing is in
    view, nothing is run into; the robot moves as an ideal unicycle. Draws nothing at random.
    """
    interpreted = "its hand is looked up in a table of points"

    @dataclass
    class Params(SensorParams):
        csv: str | None = setting(None, "file of a trajectory; None for the keyframes")
        keyframes: list[list[float]] = setting(
            [[0.0, 1.5], [4.0, 1.5], [9.0, 0.9], [13.0, 0.9], [15.0, 0.2], [19.0, 0.2], [22.0, 1.5]],
            "[t s, distance of the hand m]: rest, a slow approach, rest, a fast one, rest close by, retreat")

    params: Params

    def __init__(self, params: Params, context: SimulatorContext):
        super().__init__(params, context)
        if params.csv is not None:
            self._times, self._points = read_csv(params.csv)
        else:
            self._times, self._points = check_keyframes(params.keyframes)
        self._smooth = params.csv is None

    def at(self, t_s: float) -> Point:
        """Where the hand is at this time, m from the end-effector."""
        i = bisect_right(self._times, t_s)
        if i == 0 or i == len(self._times):
            return self._points[max(0, i - 1)]
        u = (t_s - self._times[i - 1]) / (self._times[i] - self._times[i - 1])
        if self._smooth:
            u = u * u * u * (10.0 - 15.0 * u + 6.0 * u * u)
        (x, y, z), (x1, y1, z1) = self._points[i - 1], self._points[i]
        return x + u * (x1 - x), y + u * (y1 - y), z + u * (z1 - z)

    def hand(self) -> tuple[float, float]:
        """(distance m, speed m/s) of the hand now; the speed is the mean over the last cycle."""
        now, before = self.at(self.cycle * self.dt_s), self.at((self.cycle - 1) * self.dt_s)
        return distance(now, (0.0, 0.0, 0.0)), distance(now, before) / self.dt_s

    def sonar(self, count: int = len(SONARS)) -> list[float]:
        return [self.params.sonar_range_m] * count

    def blobs(self) -> list[Blob]:
        return []

    def advance(self, v: float, w: float, cycles: int) -> tuple[int, bool]:
        for _ in range(cycles):
            x, y, heading = arc(*self.pose(), v, w, self.dt_s)
            self.cycle += 1
            self.trace[self.cycle] = x, y, (heading + pi) % (2 * pi) - pi
        return cycles, False


def check_keyframes(keyframes: list[list[float]]) -> tuple[list[float], list[Point]]:
    """(times, points), or a ConfigError."""
    if not keyframes or any(len(frame) != 2 or frame[1] < 0 for frame in keyframes):
        raise ConfigError("simulator.keyframes", "each must be [t s, distance m], the distance 0 or more")
    times = [frame[0] for frame in keyframes]
    if any(b <= a for a, b in pairwise(times)):
        raise ConfigError("simulator.keyframes", f"the times {times} must rise")
    return times, [(frame[1], 0.0, 0.0) for frame in keyframes]


def read_csv(path: str) -> tuple[list[float], list[Point]]:
    """(times s, points m) of a trajectory file, or a ConfigError naming its line."""
    import csv
    if not Path(path).is_file():
        raise ConfigError("simulator.csv", f"there is no file {path}")
    times: list[float] = []
    points: list[Point] = []
    with Path(path).open(newline="") as file:
        for line, row in enumerate(csv.DictReader(file), start=2):
            try:
                t, point = float(row["t_s"]), (float(row["x_m"]), float(row["y_m"]), float(row.get("z_m") or 0.0))
            except (KeyError, TypeError, ValueError):
                raise ConfigError("simulator.csv", f"line {line} of {path} is not a number in each of t_s, x_m, y_m",
                                  "Columns: t_s, x_m, y_m and perhaps z_m") from None
            if times and not t > times[-1]:
                raise ConfigError("simulator.csv", f"line {line} of {path}: t_s must rise")
            times.append(t)
            points.append(point)
    if not times:
        raise ConfigError("simulator.csv", f"{path} holds no row")
    return times, points
