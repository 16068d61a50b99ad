"""CARMEN text logs: a message a line."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from math import pi
from typing import IO

from attnlab.logs.base import Beams, Ledger, LogSettings, Raw, text_lines

RANGE_MAX_M = 80.0  # of the SICK lasers of that time, which say 81.83 or 81.91 when they hear nothing
MOST_BEAMS = 100_000
OTHERS = frozenset(("PARAM", "SYNC", "ODOM", "RLASER", "TRUEPOS", "NEFF", "ROBOTLASER2", "RAWLASER2", "RAWLASER3",
                    "RAWLASER4", "POSITION", "NMEAGGA", "NMEARMC", "MARKER", "IMU", "REMISSION"))


def read(stream: IO[bytes], settings: LogSettings, ledger: Ledger) -> Iterator[Raw]:
    """Front laser scans: FLASER, ROBOTLASER1 and RAWLASER1 messages, as the header of such logs describes them.

    FLASER says no bearings. Ours: from the right to the left over 180 degrees, an odd number of beams from end to end
    (181 are a degree apart), an even number in the middles of equal shares (180 are at -89.5 ... 89.5). Pose: the
    corrected one, which is in the message.
    """
    for number, line in text_lines(stream, ledger):
        words = line.split()
        kind, place = words[0], f"line {number}"
        if kind.startswith("#") or kind in OTHERS:
            continue
        try:
            if kind == "FLASER":
                yield _flaser(words, settings, place)
            elif kind in ("ROBOTLASER1", "RAWLASER1"):
                yield _rawlaser(words, settings, place, robot=kind == "ROBOTLASER1")
            else:
                ledger.skip("line of an unknown message", place)
        except (ValueError, IndexError):
            ledger.skip(f"{kind} line that is broken", place)


def _flaser(words: list[str], settings: LogSettings, place: str) -> Raw:
    """FLASER n r1 ... rn x y theta odom_x odom_y odom_theta ipc_timestamp ipc_hostname logger_timestamp."""
    count = _count(words[1])
    if len(words) != 2 + count + 9:
        raise ValueError
    ranges = tuple(map(float, words[2:2 + count]))
    x, y, theta = map(float, words[2 + count:5 + count])
    return Raw(float(words[8 + count]), ranges, _half_circle(count, settings.range_min_m, settings.range_max_m),
               (x, y, theta), place)


def _rawlaser(words: list[str], settings: LogSettings, place: str, robot: bool) -> Raw:
    """KIND type start fov resolution max accuracy remission n r1 ... rn m s1 ... sm [laser pose, robot pose, tv rv
    forward side turn] timestamp host logger_timestamp."""
    start, _, step, longest = map(float, words[2:6])
    count = _count(words[8])
    ranges = tuple(map(float, words[9:9 + count]))
    remissions = int(words[9 + count])
    at = 10 + count + remissions
    if remissions < 0 or len(words) != at + (11 if robot else 0) + 3 or len(ranges) != count:
        raise ValueError
    pose = None
    if robot:
        x, y, theta = map(float, words[at + 3:at + 6])
        pose, at = (x, y, theta), at + 11
    beams = Beams(tuple(start + i * step for i in range(count)), settings.range_min_m, settings.range_max_m or longest)
    return Raw(float(words[at]), ranges, beams, pose, place)


def _count(word: str) -> int:
    count = int(word)
    if not 0 < count <= MOST_BEAMS:
        raise ValueError
    return count


@lru_cache(maxsize=8)
def _half_circle(count: int, low: float, high: float | None) -> Beams:
    step, shift = (pi / max(1, count - 1), 0.0) if count % 2 else (pi / count, 0.5)
    return Beams(tuple((i + shift) * step - pi / 2 for i in range(count)), low, high or RANGE_MAX_M)
