"""An episode as an MCAP log in JSON: pose and world in Foxglove's schemas, the rest in our own.

Topics: ``/world`` (foxglove.SceneUpdate, once), ``/pose`` (foxglove.PoseInFrame, every cycle), ``/body`` (needs,
energy, wanting, safety, every cycle), ``/attention/<behaviour>`` (a look), ``/sonar`` and ``/camera`` (when they were
read), ``/meals``. Time is that of the episode, from 0. The same episode gives the same bytes.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from math import cos, sin
from pathlib import Path
from typing import Any

from attnlab import __version__
from attnlab.simulators.robot import SONARS
from attnlab.worlds.base import Layout

COLOURS = {"food": (0.0, 0.62, 0.45, 1.0), "water": (0.0, 0.45, 0.7, 1.0), "wall": (0.6, 0.6, 0.6, 1.0)}
DARK = (0.15, 0.15, 0.15, 1.0)
Message = tuple[int, str, str, dict[str, Any]]  # ns, topic, schema, content


def write(track: Mapping[str, Any], layout: Layout, out: Path) -> None:
    """Write the file. ``track``: see :func:`attnlab.replay.track.track_of`."""
    from mcap.writer import CompressionType, Writer
    with out.open("wb") as file:
        writer = Writer(file, compression=CompressionType.ZSTD)
        writer.start(profile="", library=f"attnlab {__version__}")
        writer.add_metadata("attnlab", {name: str(track[name]) for name in (
            "run", "label", "seed", "phase", "episode", "n", "dt", "death")})
        schemas: dict[str, int] = {}
        channels: dict[str, int] = {}
        for number, (time_ns, topic, name, content) in enumerate(messages(track, layout)):
            if topic not in channels:
                if name not in schemas:
                    shape = {"type": "object", "properties": {key: {"type": _type(v)} for key, v in content.items()}}
                    schemas[name] = writer.register_schema(name, "jsonschema", json.dumps(shape).encode())
                channels[topic] = writer.register_channel(topic, "json", schemas[name])
            data = json.dumps(content, separators=(",", ":"), allow_nan=False).encode()
            writer.add_message(channels[topic], log_time=time_ns, publish_time=time_ns, data=data, sequence=number)
        writer.finish()  # type: ignore[no-untyped-call]


def messages(track: Mapping[str, Any], layout: Layout) -> Iterator[Message]:
    """All messages of an episode in the order of time. What was read and chosen in a cycle comes at its beginning, pose
    and body at its end."""
    yield 0, "/world", "foxglove.SceneUpdate", _scene(layout)
    yield 0, "/pose", "foxglove.PoseInFrame", _pose(0, *track["start"])
    looks: dict[int, list[tuple[str, dict[str, Any]]]] = {}
    for behaviour, rows in track["looks"].items():
        for row in rows:
            looks.setdefault(row[0], []).append((behaviour, dict(zip(track["columns"], row, strict=True))))
    meals: dict[int, list[str]] = {}
    for cycle, need in track["meals"]:
        meals.setdefault(cycle, []).append(need)
    for cycle in range(track["n"]):
        begin, end = _ns(cycle * track["dt"]), _ns((cycle + 1) * track["dt"])
        if cycle in track["fans"]:
            ranges = track["fans"][cycle]
            yield begin, "/sonar", "attnlab.Sonar", {"cycle": cycle, "ranges_m": ranges, "bearings_rad": [
                round(angle, 6) for *_, angle in SONARS[:len(ranges)]]}
        if cycle in track["blobs"]:
            yield begin, "/camera", "attnlab.Blobs", {"cycle": cycle, "blobs": [
                dict(zip(("solid", "bearing_rad", "distance_m", "height_px"), blob, strict=True))
                for blob in track["blobs"][cycle]]}
        for behaviour, look in looks.get(cycle, []):
            yield begin, f"/attention/{behaviour}", "attnlab.Look", look
        yield end, "/pose", "foxglove.PoseInFrame", _pose(end, *(track[name][cycle] for name in "xyh"))
        body = {need["name"]: need["v"][cycle] for need in track["needs"]}
        yield end, "/body", "attnlab.Body", {"cycle": cycle, **body, **{name: track[of][cycle] for name, of in (
            ("energy", "energy"), ("wanting", "wanting"), ("safety", "safety"), ("safety_held", "held"))}}
        for need in meals.get(cycle, []):
            yield end, "/meals", "attnlab.Meal", {"cycle": cycle, "need": need}


def _ns(seconds: float) -> int:
    return round(seconds * 1e9)


def _stamp(time_ns: int) -> dict[str, int]:
    return {"sec": time_ns // 10 ** 9, "nsec": time_ns % 10 ** 9}


def _placed(x: float, y: float, z: float, yaw: float) -> dict[str, Any]:
    return {"position": {"x": x, "y": y, "z": z},
            "orientation": {"x": 0.0, "y": 0.0, "z": round(sin(yaw / 2), 12), "w": round(cos(yaw / 2), 12)}}


def _pose(time_ns: int, x: float, y: float, yaw: float) -> dict[str, Any]:
    return {"timestamp": _stamp(time_ns), "frame_id": "world", "pose": _placed(x, y, 0.0, yaw)}


def _scene(layout: Layout) -> dict[str, Any]:
    cubes = [{"pose": _placed(s.x_m, s.y_m, s.height_m / 2, s.yaw_rad),
              "size": {"x": s.length_m, "y": s.width_m, "z": s.height_m},
              "color": dict(zip("rgba", COLOURS.get(s.kind, DARK), strict=True))} for s in layout.solids]
    nothing: dict[str, list[Any]] = {kind: [] for kind in ("metadata", "arrows", "spheres", "cylinders", "lines",
                                                           "triangles", "texts", "models")}
    return {"deletions": [], "entities": [{"timestamp": _stamp(0), "frame_id": "world", "id": "world",
                                           "lifetime": _stamp(0), "frame_locked": False, **nothing, "cubes": cubes}]}


def _type(value: Any) -> str:
    names = {bool: "boolean", int: "integer", str: "string", list: "array", dict: "object"}
    return names.get(type(value), "number")
