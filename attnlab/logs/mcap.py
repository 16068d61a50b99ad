"""MCAP files: laser scans, single ranges and odometry of ROS 1 and 2, laser scans of Foxglove in JSON."""

from __future__ import annotations

import json
import re
import struct
from collections.abc import Iterator
from math import nan, radians
from typing import IO, Any

from attnlab.errors import ConfigError
from attnlab.logs.base import Beams, Ledger, LogSettings, Pose, Raw
from attnlab.logs.ros import Cursor, laser_scan, odometry, one_range, stamp
from attnlab.pioneer import SONARS_MM_DEG

KINDS = {"sensor_msgs/LaserScan": "scan", "foxglove.LaserScan": "scan", "sensor_msgs/Range": "range",
         "nav_msgs/Odometry": "pose"}
READ = {("scan", "cdr"), ("scan", "ros1"), ("scan", "json"), ("range", "cdr"), ("range", "ros1"), ("pose", "cdr"),
        ("pose", "ros1")}
LARGEST = 1 << 26  # bytes of a record: chunks are a few MB
ROUND = {1: (0,), 8: tuple(deg for *_, deg in SONARS_MM_DEG[:8]), 16: tuple(deg for *_, deg in SONARS_MM_DEG)}


def read(stream: IO[bytes], settings: LogSettings, ledger: Ledger) -> Iterator[Raw]:
    """Scans of an MCAP, message after message as they stand in the file.

    Laser scans: those of ``settings.topic``, or of the first topic that has some. Without any, single ranges: a topic a
    sonar, 1 ahead, 8 or 16 as on the Pioneer's ring, in the order of the numbers in their names; a scan is a round of
    them. Raises ConfigError if the package mcap is not installed.
    """
    try:
        from mcap.records import Channel, Message, Schema
        from mcap.stream_reader import StreamReader
    except ImportError:
        raise ConfigError("log", "an MCAP file needs the package mcap, which is not installed here",
                          "pip install 'attnlab[logs]'") from None
    schemas: dict[int, str] = {}
    channels: dict[int, tuple[str, str, str]] = {}  # topic, kind, encoding
    topic, pose, number = settings.topic, None, 0
    ranges = _Ranges(settings)
    try:
        for record in StreamReader(stream, record_size_limit=LARGEST).records:
            if isinstance(record, Schema):
                schemas[record.id] = record.name.replace("/msg/", "/")
            elif isinstance(record, Channel):
                kind = KINDS.get(schemas.get(record.schema_id, ""), "")
                channels[record.id] = record.topic, kind, record.message_encoding
            elif isinstance(record, Message):
                number += 1
                of, kind, encoding = channels.get(record.channel_id, ("?", "", ""))
                place = f"message {number}"
                if not kind or (kind == "scan" and topic and of != topic):
                    continue
                if (kind, encoding) not in READ:
                    ledger.skip(f"message of {of} in {encoding}, which is not read", place)
                    continue
                try:
                    if kind == "pose":
                        pose = odometry(Cursor(record.data, encoding))
                    elif kind == "scan":
                        topic = topic or of
                        yield _scan(record.data, encoding, settings, pose, place)
                    elif not topic:
                        yield from ranges.hear(of, Cursor(record.data, encoding), pose, place)
                except (struct.error, IndexError, ValueError, KeyError, TypeError, AttributeError):
                    ledger.skip(f"message of {of} that is broken", place)
    except ConfigError:
        raise
    except Exception as cause:  # noqa: BLE001  each decompressor has errors of its own
        ledger.skip("file that ends early or is damaged", f"message {number}: {type(cause).__name__}")
    yield from ranges.end(pose, f"message {number}")
    if settings.topic and settings.topic not in {of for of, kind, _ in channels.values() if kind == "scan"}:
        known = sorted(of for of, kind, _ in channels.values() if kind == "scan")
        raise ConfigError("topic", f"no laser scans under '{settings.topic}'", f"Known: {', '.join(known) or 'none'}")


class _Ranges:
    """Single ranges of several topics, put together: a round ends when a topic is heard again. Which topics there are
    is known after two rounds, so the first one waits for the second."""

    def __init__(self, settings: LogSettings):
        self.settings, self.topics = settings, list[str]()
        self.round: dict[str, tuple[float, float, float, float]] = {}  # time, least, longest, range
        self.waiting: list[tuple[dict[str, tuple[float, float, float, float]], Pose | None, str]] = []

    def hear(self, topic: str, cursor: Cursor, pose: Pose | None, place: str) -> Iterator[Raw]:
        heard = one_range(cursor)
        if topic in self.round:
            self.waiting.append((self.round, pose, place))
            self.round = {}
            if self.topics or len(self.waiting) == 2:
                yield from self.flush()
        self.round[topic] = heard

    def end(self, pose: Pose | None, place: str) -> Iterator[Raw]:
        """What is left when the file has ended."""
        if self.round:
            self.waiting.append((self.round, pose, place))
        yield from self.flush()

    def flush(self) -> Iterator[Raw]:
        if not self.topics:
            known = {topic for heard, *_ in self.waiting for topic in heard}
            self.topics = sorted(known, key=lambda name: ([int(n) for n in re.findall(r"\d+", name)], name))
            if known and len(known) not in ROUND:
                raise ConfigError("log", f"it has {len(known)} topics of single ranges, whose bearings it does not "
                                  "say", "1, 8 and 16 are known")
        for heard, pose, place in self.waiting:
            beams = Beams(tuple(map(radians, ROUND[len(self.topics)])), min(r[1] for r in heard.values()),
                          self.settings.range_max_m or max(r[2] for r in heard.values()))
            ranges = tuple(heard[name][3] if name in heard else nan for name in self.topics)
            yield Raw(max(r[0] for r in heard.values()), ranges, beams, pose, place)
        self.waiting = []


def _scan(data: bytes, encoding: str, settings: LogSettings, pose: Pose | None, place: str) -> Raw:
    if encoding == "json":
        message: dict[str, Any] = json.loads(data)
        ranges = tuple(float("nan" if r is None else r) for r in message["ranges"])
        first, last, low, high = message["start_angle"], message["end_angle"], settings.range_min_m, float("inf")
        step, time_s = (last - first) / max(1, len(ranges) - 1), stamp(message["timestamp"])
    else:
        time_s, first, step, low, high, ranges = laser_scan(Cursor(data, encoding))
    if not ranges:
        raise ValueError
    beams = Beams(tuple(first + i * step for i in range(len(ranges))), max(low, settings.range_min_m),
                  settings.range_max_m or (high if 0 < high < 1e4 else 80.0))
    return Raw(time_s, ranges, beams, pose, place)
