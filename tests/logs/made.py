"""Small logs in every format, made here."""

import gzip
import json
import struct
from math import pi

SCANS = [(0.0, (1.0, 2.0, 0.5)), (0.25, (1.5, 4.9, 0.7)), (0.5, (1.25, 9.0, 0.25))]  # s, right, ahead, left
POSES = [(0.0, 0.0, 0.0), (0.5, 0.0, 0.0), (0.5, 0.25, pi / 2)]


def csv(scans=SCANS):
    rows = [f"{t},{x},{y},{h}," + ",".join(map(str, r)) for (t, r), (x, y, h) in zip(scans, POSES, strict=False)]
    return "\n".join(["t_s,x_m,y_m,heading_rad,r-90,r0,r90", *rows, ""]).encode()


def carmen(scans=SCANS):
    rows = [f"FLASER 3 {' '.join(map(str, r))} {x} {y} {h} 0 0 0 {t} host {t}"
            for (t, r), (x, y, h) in zip(scans, POSES, strict=False)]
    return "\n".join(["# message formats", "PARAM robot_width 0.4 0 host 0", "ODOM 0 0 0 0 0 0 0 host 0", *rows, ""]
                     ).encode()


def named(name, version):
    return bytes([0x80 | len(name)]) + name + bytes([version])


def pose3d(version=1, names=b""):
    one = struct.pack("<16d", 1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)
    body = {1: named(b"CMatrixD", 0) + struct.pack("<II", 4, 4) + one + b"\x88",
            2: struct.pack("<6d", 0, 0, 0, 0, 0, 0), 3: struct.pack("<7d", 0, 0, 0, 1, 0, 0, 0), 9: b""}[version]
    return named(names + b"CPose3D", version) + body + b"\x88"


def scan_object(t, ranges, version=6, pose=1, spaces=b"", valid=None):
    n = len(ranges)
    return (named((b"mrpt::obs::" if spaces else b"") + b"CObservation2DRangeScan", version)
            + struct.pack("<fBf", pi, 1, 5.0) + pose3d(pose, spaces and b"mrpt::poses::") + struct.pack("<I", n)
            + struct.pack(f"<{n}f", *ranges) + bytes(valid or [1] * n) + struct.pack("<fQ", 0.01, round(t * 1e7))
            + struct.pack("<fId", 0.0, 0, 0.0) + b"\x88")


def move_object(x, y, turn):
    return (named(b"CActionRobotMovement2D", 6) + struct.pack("<I", 0) + named(b"CPose2D", 1)
            + struct.pack("<3d", x, y, turn) + b"\x88" + b"\0" * 30 + b"\x88")


def rawlog(scans=SCANS, version=6, pose=1, spaces=b""):
    moves = [(0.0, 0.0, 0.0), (0.5, 0.0, 0.0), (0.0, 0.25, pi / 2)]
    parts = [named(b"CSensoryFrame", 2)]
    for (t, ranges), move in zip(scans, moves, strict=False):
        parts += [move_object(*move), scan_object(t, ranges, version, pose, spaces)]
    return gzip.compress(b"".join(parts) + b"\x88")


def cdr(*fields):
    """Fields (kind, values) or a text, aligned as CDR has it."""
    data = b""
    for field in fields:
        if isinstance(field, str):
            data += b"\0" * (-len(data) % 4) + struct.pack("<I", len(field) + 1) + field.encode() + b"\0"
        else:
            kind, *values = field
            size = struct.calcsize(kind)
            for value in values:
                data += b"\0" * (-len(data) % size) + struct.pack(f"<{kind}", value)
    return b"\0\1\0\0" + data


def laser(t, ranges, first=-pi / 2, step=pi / 2):
    return cdr(("i", int(t)), ("I", round(t % 1 * 1e9)), "laser", ("f", first, pi / 2, step, 0.0, 0.1, 0.05, 5.0),
               ("I", len(ranges)), ("f", *ranges), ("I", 0))


def sonar(t, value):
    return cdr(("i", int(t)), ("I", round(t % 1 * 1e9)), "s", ("B", 0), ("f", 0.5, 0.1, 5.0, value))


def odometry(t, x, y, z, w):
    return cdr(("i", int(t)), ("I", 0), "odom", "base", ("d", x, y, 0.0, 0.0, 0.0, z, w))


def mcap(path, messages):
    """``messages``: (topic, schema, encoding, data)."""
    from mcap.writer import Writer
    with path.open("wb") as stream:
        writer, channels = Writer(stream, chunk_size=4096), {}
        writer.start()
        for i, (topic, schema, encoding, data) in enumerate(messages):
            if topic not in channels:
                of = writer.register_schema(schema, "ros2msg", b"")
                channels[topic] = writer.register_channel(topic, encoding, of)
            writer.add_message(channels[topic], i, data, i)
        writer.finish()
    return path


def foxglove(t, ranges):
    return json.dumps({"timestamp": {"sec": int(t), "nsec": round(t % 1 * 1e9)}, "start_angle": -pi / 2,
                       "end_angle": pi / 2, "ranges": ranges}).encode()


def mcap_scans(path, scans=SCANS):
    turned = 0.5 ** 0.5
    poses = [(0.0, 0.0, 0.0, 1.0), (0.5, 0.0, 0.0, 1.0), (0.5, 0.25, turned, turned)]
    messages = []
    for (t, ranges), pose in zip(scans, poses, strict=True):
        messages += [("/odom", "nav_msgs/msg/Odometry", "cdr", odometry(t, *pose)),
                     ("/scan", "sensor_msgs/msg/LaserScan", "cdr", laser(t, ranges)),
                     ("/chatter", "std_msgs/msg/String", "cdr", b"\0\1\0\0")]
    return mcap(path, messages)
