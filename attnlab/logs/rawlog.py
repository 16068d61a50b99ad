"""MRPT rawlogs: serialised objects one after the other, usually gzipped."""

from __future__ import annotations

import re
import struct
from collections.abc import Iterator
from math import atan2, inf, isfinite, nan, pi
from typing import IO

from attnlab.arithmetic import length
from attnlab.logs.base import Beams, Ledger, LogSettings, Pose, Raw
from attnlab.pioneer import arc

LARGEST = 1 << 20  # bytes: no object that is read has more
LONGEST_NAME = 64
# An object: 0x80 + length of its class's name, the name, its version, its content, 0x88.
OBJECT = re.compile(rb"[\x80-\xbf](?:mrpt::obs::)?(CObservation2DRangeScan|CActionRobotMovement2D)([\x00-\x7f])")
NAME = re.compile(rb"[\x87\x94](?:mrpt::poses::)?CPose([23])D([\x00-\x7f])")
MATRIX = re.compile(rb"[\x88\x90-\x9f](?:mrpt::math::)?CMatrix(?:D|F)?.", re.DOTALL)
TICKS_S = 1e-7  # timestamps count these


def read(stream: IO[bytes], settings: LogSettings, ledger: Ledger) -> Iterator[Raw]:
    """Scans (class CObservation2DRangeScan, versions 6 and 7), found by their class's name: other objects need not be
    understood. Pose: odometry increments (CActionRobotMovement2D) added up from (0, 0, 0)."""
    window, start, at, ended = b"", 0, 0, False  # bytes held, where they begin in the file, how far they are read
    pose: Pose = 0.0, 0.0, 0.0
    moved = False
    while True:
        while not ended and len(window) - at < LARGEST:
            more = stream.read(LARGEST)
            ended = not more
            start, window, at = start + at, window[at:] + more, 0
        found = OBJECT.search(window, at)
        if found is None:
            if ended:
                return
            at = max(at, len(window) - LONGEST_NAME)  # a name may be cut by the window's end
            continue
        if found.start() - at > LARGEST // 2 and not ended:  # too near to the end to hold an object
            at = found.start()
            continue
        place = f"byte {start + found.start()}"
        at = found.end()
        try:
            if found[1] == b"CActionRobotMovement2D":
                step, at = _increment(window, at, found[2][0])
                if step is not None:
                    pose, moved = _compose(pose, step), True
            else:
                raw, at = _scan(window, at, found[2][0], settings, place)
                yield raw._replace(pose=pose if moved else None)
        except (struct.error, IndexError, ValueError):
            ledger.skip("object that is broken or cut off", place)
        except NotImplementedError as unknown:
            ledger.skip(str(unknown), place)


def _scan(data: bytes, at: int, version: int, settings: LogSettings, place: str) -> tuple[Raw, int]:
    """f32 aperture, u8 right to left, f32 longest range, the sensor's pose, u32 n, n x f32 ranges, n x u8 valid, f32
    sigma, u64 time."""
    if version not in (6, 7):
        raise NotImplementedError(f"laser scan of version {version}, which is not read")
    aperture, leftward, longest = struct.unpack_from("<fBf", data, at)
    yaw, at = _yaw(data, at + 9)
    count, = struct.unpack_from("<I", data, at)
    if not 0 < count <= LARGEST // 8 or not 0 < aperture <= 2 * pi + 1e-3:
        raise ValueError
    ranges = struct.unpack_from(f"<{count}f", data, at + 4)
    valid = struct.unpack_from(f"<{count}B", data, at + 4 + 4 * count)
    at += 4 + 5 * count
    ticks, = struct.unpack_from("<Q", data, at + 4)
    high = settings.range_max_m or longest
    # A beam that is not valid has heard nothing if it says the longest range, and is broken otherwise.
    heard = tuple(r if ok else inf if r >= longest else nan for r, ok in zip(ranges, valid, strict=True))
    step = aperture / max(1, count - 1) * (1 if leftward else -1)
    first = yaw - (aperture / 2 if leftward else -aperture / 2)
    beams = Beams(tuple(first + i * step for i in range(count)), settings.range_min_m, high)
    return Raw(ticks * TICKS_S, heard, beams, None, place), at + 12


def _yaw(data: bytes, at: int) -> tuple[float, int]:
    """(yaw of a CPose3D, where it ends): version 1 is a matrix of doubles, 2 has angles, 3 a quaternion."""
    found = NAME.match(data, at)
    if found is None or found[1] != b"3":
        raise ValueError
    version, at = found[2][0], found.end()
    if version == 1:
        matrix = MATRIX.match(data, at)
        if matrix is None:
            raise ValueError
        rows, columns = struct.unpack_from("<II", data, matrix.end())
        if (rows, columns) != (4, 4):
            raise ValueError
        cells = struct.unpack_from("<16d", data, matrix.end() + 8)
        at, yaw = matrix.end() + 8 + 128 + 1, atan2(cells[4], cells[0])
    elif version == 2:
        yaw, at = struct.unpack_from("<6d", data, at)[3], at + 48
    elif version == 3:
        _, _, _, w, x, y, z = struct.unpack_from("<7d", data, at)
        yaw, at = atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)), at + 56
    else:
        raise NotImplementedError(f"sensor pose of version {version}, which is not read")
    if data[at] != 0x88:
        raise ValueError
    return yaw, at + 1


def _increment(data: bytes, at: int, version: int) -> tuple[Pose | None, int]:
    """The odometry increment of an action: u32 method, 0 being odometry, then a CPose2D. None for other methods."""
    method, = struct.unpack_from("<I", data, at)
    found = NAME.match(data, at + 4)
    if method != 0 or version < 3 or found is None or found[1] != b"2":
        return None, at
    kind = "<3d" if found[2][0] >= 1 else "<3f"
    x, y, turn = struct.unpack_from(kind, data, found.end())
    if not (isfinite(x) and isfinite(y) and isfinite(turn)):
        raise ValueError
    return (x, y, turn), found.end() + struct.calcsize(kind) + 1


def _compose(pose: Pose, step: Pose) -> Pose:
    """A pose after an increment given in its own frame."""
    distance = length(step[0], step[1])
    x, y, _ = arc(pose[0], pose[1], pose[2] + atan2(step[1], step[0]), distance, 0.0, 1.0)
    return x, y, (pose[2] + step[2] + pi) % (2 * pi) - pi
