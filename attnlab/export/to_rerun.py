"""An episode as a Rerun recording, on the timelines ``cycle`` and ``episode_time``: the arena from above, the robot
with its path, sonar beams when they were read, and every scalar of the body and of each behaviour's attention."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import cos, sin
from pathlib import Path
from typing import Any

from attnlab.simulators.robot import SONARS
from attnlab.worlds.base import Layout
from attnlab.worlds.geometry import Solid

COLOURS = {"food": (0, 158, 115), "water": (0, 114, 178), "wall": (140, 140, 140)}
DARK = (40, 40, 40)
ROBOT_M = 0.2  # the radius that is drawn


def write(track: Mapping[str, Any], layout: Layout, out: Path) -> None:
    """Write the file. ``track``: see :func:`attnlab.replay.track.track_of`."""
    import rerun as rr
    cycles, dt = list(range(track["n"])), track["dt"]

    def when(of: Sequence[int]) -> list[Any]:
        return [rr.TimeColumn("cycle", sequence=list(of)),
                rr.TimeColumn("episode_time", duration=[(cycle + 1) * dt for cycle in of])]
    with rr.RecordingStream("attnlab", recording_id=f"{track['run']}-{track['phase']}-{track['episode']}") as stream:
        stream.save(out)
        stream.log("about", rr.TextDocument(f"{track['label']}, seed {track['seed']}: {track['phase']} episode "
                                            f"{track['episode']} of run {track['run']}; death: {track['death']}"),
                   static=True)
        stream.log("world", rr.LineStrips2D([_outline(solid) for solid in layout.solids],
                                            colors=[COLOURS.get(solid.kind, DARK) for solid in layout.solids],
                                            labels=[solid.kind for solid in layout.solids]), static=True)
        poses = list(zip(track["x"], track["y"], track["h"], strict=True))
        stream.log("world/path", rr.LineStrips2D([[(x, y) for x, y, _ in poses]], colors=(200, 200, 200)), static=True)
        stream.send_columns("world/robot", indexes=when(cycles), columns=rr.Points2D.columns(
            positions=[(x, y) for x, y, _ in poses], radii=[ROBOT_M] * len(poses)))
        stream.send_columns("world/robot/heading", indexes=when(cycles), columns=rr.Arrows2D.columns(
            origins=[(x, y) for x, y, _ in poses], vectors=[(ROBOT_M * cos(h), ROBOT_M * sin(h)) for *_, h in poses]))
        for cycle, fan in sorted(track["fans"].items()):
            at = track["start"] if cycle == 0 else poses[cycle - 1]
            stream.set_time("cycle", sequence=cycle)
            stream.set_time("episode_time", duration=(cycle + 1) * dt)
            stream.log("world/sonar", rr.LineStrips2D(_beams(at, fan), colors=(230, 190, 0)))
            if cycle + 1 not in track["fans"] and cycle + 1 < track["n"]:
                stream.set_time("cycle", sequence=cycle + 1)
                stream.set_time("episode_time", duration=(cycle + 2) * dt)
                stream.log("world/sonar", rr.Clear(recursive=False))
        body = {**{f"needs/{need['name']}": need["v"] for need in track["needs"]}, "energy": track["energy"],
                "wanting": track["wanting"], "safety": track["safety"], "safety_held": track["held"]}
        for name, values in body.items():
            _scalars(rr, stream, f"body/{name}", when, cycles, values)
        for behaviour, rows in track["looks"].items():
            for place, column in enumerate(track["columns"]):
                if column not in ("cycle", "level"):
                    _scalars(rr, stream, f"attention/{behaviour}/{column}", when, [row[0] for row in rows],
                             [row[place] for row in rows])
        for cycle, need in track["meals"]:
            stream.set_time("cycle", sequence=cycle)
            stream.set_time("episode_time", duration=(cycle + 1) * dt)
            stream.log("meals", rr.TextLog(f"{need} satisfied"))


def _scalars(rr: Any, stream: Any, entity: str, when: Any, cycles: Sequence[int], values: Sequence[Any]) -> None:
    """A column of numbers; cycles in which there is none are left out."""
    kept = [(cycle, float(value)) for cycle, value in zip(cycles, values, strict=True) if value is not None]
    if kept:
        stream.send_columns(entity, indexes=when([cycle for cycle, _ in kept]),
                            columns=rr.Scalars.columns(scalars=[value for _, value in kept]))


def _outline(solid: Solid) -> list[tuple[float, float]]:
    """The corners of a box, the first again at the end (m)."""
    first, *others = solid.corners()
    return [first, *others, first]


def _beams(pose: Sequence[float], fan: Sequence[float]) -> list[list[tuple[float, float]]]:
    """From each sonar to what it heard (m)."""
    x, y, heading = pose
    c, s = cos(heading), sin(heading)
    found = []
    for (dx, dy, bearing), reach in zip(SONARS, fan, strict=False):
        at = x + c * dx - s * dy, y + s * dx + c * dy
        found.append([at, (at[0] + reach * cos(heading + bearing), at[1] + reach * sin(heading + bearing))])
    return found
