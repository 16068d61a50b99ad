"""Three ROS messages as bytes: CDR (ROS 2) or ROS 1's own form."""

from __future__ import annotations

import struct
from collections.abc import Mapping
from math import atan2
from typing import Any

LONGEST = 1 << 24  # bytes of a text or beams of a scan: more is a damaged length


class Cursor:
    """Reads a message from its start. In CDR each number stands at a multiple of its size, in ROS 1 nothing is
    aligned. Raises struct.error or ValueError at the end of a message that is cut off."""
    SIZES = {"B": 1, "i": 4, "I": 4, "f": 4, "d": 8}

    def __init__(self, data: bytes, encoding: str):
        self.cdr = encoding == "cdr"
        self.data, self.at = (data[4:], 0) if self.cdr else (data, 0)
        self.order = ">" if self.cdr and data[1] == 0 else "<"

    def number(self, kind: str) -> Any:
        return self.numbers(kind, 1)[0]

    def numbers(self, kind: str, count: int) -> tuple[Any, ...]:
        size = self.SIZES[kind]
        if self.cdr and count:
            self.at += -self.at % size
        found = struct.unpack_from(f"{self.order}{count}{kind}", self.data, self.at)
        self.at += size * count
        return found

    def text(self) -> None:
        """Step over a text."""
        length = self.number("I")
        if length > min(LONGEST, len(self.data) - self.at):
            raise ValueError
        self.at += length

    def header(self) -> float:
        """Step over a message's header; its time in s."""
        if not self.cdr:
            self.number("I")
        seconds, nanoseconds = int(self.number("i")), int(self.number("I"))
        self.text()
        return seconds + nanoseconds * 1e-9


def laser_scan(cursor: Cursor) -> tuple[float, float, float, float, float, tuple[float, ...]]:
    """(time s, first bearing rad, step rad, least range, longest range, ranges m) of a sensor_msgs/LaserScan."""
    time_s = cursor.header()
    first, _, step, _, _, low, high = cursor.numbers("f", 7)
    count = cursor.number("I")
    if count > LONGEST:
        raise ValueError
    return time_s, first, step, low, high, cursor.numbers("f", count)


def one_range(cursor: Cursor) -> tuple[float, float, float, float]:
    """(time s, least, longest, range m) of a sensor_msgs/Range."""
    time_s = cursor.header()
    cursor.number("B")
    _, low, high, value = cursor.numbers("f", 4)
    return time_s, low, high, value


def odometry(cursor: Cursor) -> tuple[float, float, float]:
    """(x m, y m, heading rad) of a nav_msgs/Odometry."""
    cursor.header()
    cursor.text()
    x, y, _, qx, qy, qz, qw = cursor.numbers("d", 7)
    return x, y, atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz))


def stamp(value: Mapping[str, Any]) -> float:
    """Seconds of a timestamp in Foxglove's JSON."""
    return float(value["sec"]) + float(value["nsec"]) * 1e-9
