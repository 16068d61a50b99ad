"""A log as machine cycles: what a robot that cannot act is shown, one row a cycle."""

from __future__ import annotations

import os
import tempfile
import weakref
from array import array
from collections.abc import Iterator
from itertools import pairwise
from math import inf, nan
from struct import Struct
from typing import Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from attnlab.errors import ConfigError
from attnlab.logs.base import Pose
from attnlab.logs.file import Log
from attnlab.logs.sonars import cones, least, sectors
from attnlab.pioneer import FRONT, SONARS

Hearing = Literal["cones", "sectors"]
ROW = Struct(f"<{3 + len(SONARS)}d")  # x m, y m, heading rad, ranges of the sixteen sonars m
NOWHERE: Pose = nan, nan, nan
SHORTEST = 20  # cycles: a shorter stretch between two holes is no episode
MARGIN_M = 1.0  # of floor around the path
GAPS = 1 << 16  # between scans, of which the middle one is taken


class Shown(NamedTuple):
    """A scan as the robot's sonars hear it."""
    time_s: float
    pose: Pose | None
    ranges_m: tuple[float, ...]


class Rows:
    """The cycles of a log in a temporary file, so that a log of any length takes no memory to speak of.

    ``every_s``: a cycle shows the last scan at its time; None: a scan is a cycle. ``count`` cycles of ``cycle_s``;
    ``starts``: those at which a stretch without holes begins, 0 first; ``posed``: does the log say where the robot was;
    ``width_m``, ``depth_m``: of a floor that holds its path, which was shifted there; ``told``: what was skipped.
    """

    def __init__(self, log: Log, silent_m: float, hearing: Hearing = "cones", every_s: float | None = None,
                 poses: bool = True):
        self._gaps, self._shift = array("d"), (0.0, 0.0)
        self.count, self._first, self.starts = 0, 0, list[int]()
        x, y = [inf, -inf], [inf, -inf]
        with tempfile.TemporaryFile(prefix="attnlab-log-") as file:
            for begins, shown in _cycles(self._heard(log, silent_m, hearing), log.settings.hole_s, every_s):
                pose = (poses and shown.pose) or NOWHERE
                if begins:
                    self.starts.append(self.count)
                if pose is NOWHERE and x[1] == -inf:
                    self._first = self.count + 1  # a path that begins later begins here
                else:
                    x, y = [min(x[0], pose[0]), max(x[1], pose[0])], [min(y[0], pose[1]), max(y[1], pose[1])]
                file.write(ROW.pack(*pose, *shown.ranges_m))
                self.count += 1
            file.flush()
            self._file = os.dup(file.fileno())  # the file is gone when this is
        weakref.finalize(self, os.close, self._file)
        if not self.count:
            raise ConfigError("simulator.file", f"{log.path.name} holds no scan that can be used",
                              " ".join(log.ledger.lines()[:1]))
        self.posed = self._first < self.count
        self.width_m = self.depth_m = 2 * MARGIN_M
        if self.posed:
            self._begin_at_first_pose(log)
            self._shift = MARGIN_M - x[0], MARGIN_M - y[0]
            self.width_m, self.depth_m = x[1] - x[0] + 2 * MARGIN_M, y[1] - y[0] + 2 * MARGIN_M
        else:
            self._first = 0
        gaps = np.sort(np.array(self._gaps))
        self.cycle_s = every_s or (float(gaps[len(gaps) // 2]) if len(gaps) else inf)
        self.told = tuple(log.ledger.lines())

    def _heard(self, log: Log, silent_m: float, hearing: Hearing) -> Iterator[Shown]:
        """Scans as sonars hear them; such in which no frontal sonar does are counted in the log's ledger."""
        beams_of, last = sectors if hearing == "sectors" else cones, None
        for number, scan in enumerate(log, start=1):
            heard = [least(scan.ranges_m, of) for of in beams_of(scan.beams.bearings_rad)]
            if all(heard[i] is None for i in FRONT):
                log.ledger.skip("scan in which no frontal sonar is valid", f"scan {number}")
                continue
            if last is not None and len(self._gaps) < GAPS:
                self._gaps.append(scan.time_s - last)
            last = scan.time_s
            yield Shown(scan.time_s, scan.pose, tuple(silent_m if r is None else min(r, silent_m) for r in heard))

    def _begin_at_first_pose(self, log: Log) -> None:
        if self._first:
            log.ledger.skip("cycle before the first pose", "the first", self._first)
            self.count -= self._first
            self.starts = [0, *(start - self._first for start in self.starts if start > self._first)]

    def read(self, first: int, count: int) -> npt.NDArray[np.float64]:
        """Some cycles, shape (count, 3 + 16): the pose (NaN if there is none) and the ranges of the sonars, m."""
        data = os.pread(self._file, count * ROW.size, (self._first + first) * ROW.size)
        rows = np.frombuffer(data, np.float64).reshape(count, -1).copy()
        rows[:, :2] += self._shift
        return rows

    def stretches(self, blocks: int) -> list[list[tuple[int, int]]]:
        """``blocks`` blocks of equal length, each as stretches (from, to) of cycles without holes, as the arena has
        them; those too short to be an episode are left out."""
        edges = [self.count * i // blocks for i in range(blocks + 1)]
        found = []
        for low, high in pairwise(edges):
            cuts = [low, *(start for start in self.starts if low < start < high), high]
            found.append([(a, b) for a, b in pairwise(cuts) if b - a >= SHORTEST])
        return found


def _cycles(scans: Iterator[Shown], hole_s: float, every_s: float | None) -> Iterator[tuple[bool, Shown]]:
    """(does a stretch begin here, what is shown) in each cycle."""
    held: Shown | None = None
    origin, done = 0.0, 0  # of the stretch: when it began, cycles it has
    for scan in scans:
        hole = held is not None and scan.time_s - held.time_s > hole_s
        if every_s is None:
            yield held is None or hole, scan
        elif held is not None and not hole:
            while origin + done * every_s < scan.time_s:
                yield not done, held
                done += 1
        else:
            if held is not None and origin + done * every_s <= held.time_s:
                yield not done, held
            origin, done = scan.time_s, 0
        held = scan
    if every_s is not None and held is not None and origin + done * every_s <= held.time_s:
        yield not done, held
