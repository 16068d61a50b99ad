"""The page of a replay: one HTML file with its data, style and script in it."""

from __future__ import annotations

import base64
import hashlib
import json
from collections import Counter
from collections.abc import Mapping, Sequence
from html import escape
from math import degrees
from pathlib import Path
from typing import Any

from attnlab.worlds.base import Layout

SCRIPTS = ("plane.js", "live.js", "draw.js", "view.js")
HERE = Path(__file__).parent
STEP = 5  # cycles between two points of the path that a browser without script shows


def script() -> str:
    """All of the page's script."""
    return "\n".join((HERE / name).read_text().replace('"use strict";\n', "", 1 if i else 0)
                     for i, name in enumerate(SCRIPTS))


def world_of(layout: Layout, sonars: Sequence[Sequence[float]]) -> dict[str, Any]:
    """What the page draws of a world (m, rad)."""
    return {"width": layout.width_m, "depth": layout.depth_m, "sonars": [list(sonar) for sonar in sonars],
            "solids": [{"kind": s.kind, "x": s.x_m, "y": s.y_m, "l": s.length_m, "w": s.width_m, "yaw": s.yaw_rad}
                       for s in layout.solids]}


def said(track: Mapping[str, Any]) -> str:
    """An episode in one sentence."""
    end = "the robot lived" if track["death"] == "none" else f"the robot died: {track['death']}"
    eaten = Counter(need for _, need in track["meals"])
    fed = ", ".join(f"{need} satisfied {times} time{'s' * (times != 1)}" for need, times in sorted(eaten.items()))
    looks = ", ".join(f"{name} {len(rows)}" for name, rows in track["looks"].items())
    return (f"{track['n']} of {track['most']} cycles ({track['n'] * track['dt']:.0f} s), {end}; looks: {looks}"
            + (f"; {fed}" if fed else "") + ".")


def page(tracks: Sequence[dict[str, Any]], worlds: Sequence[Mapping[str, Any]], notes: Sequence[str],
         surprising: float) -> str:
    """The whole page; everything that a user named is escaped."""
    for track in tracks:
        track["title"] = f"{track['label']}, seed {track['seed']}"
        track["said"] = said(track)
    first, code = tracks[0], script()
    title = " and ".join(dict.fromkeys(track["title"] for track in tracks))
    data = json.dumps({"tracks": tracks, "world": worlds, "surprising": surprising, "what": None},
                      separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
    style = (HERE / "style.css").read_text()
    policy = (f"default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src '{_hash(code)}'; "
              "base-uri 'none'; form-action 'none'")
    told = "".join(f"<li>{escape(note)}</li>" for note in notes)
    fill = {"TITLE": escape(title), "POLICY": policy, "STYLE": style, "SCRIPT": code, "DATA": data,
            "LEAD": escape(f"{first['phase']} episode {first['episode']} of run {first['run']}"),
            "NOTES": f'<div class="notes" role="note"><ul>{told}</ul></div>' if told else "",
            "WORDS": "".join(f"<h2>{escape(t['title'])}</h2><p>{escape(t['said'])}</p>{_picture(t, world)}{_meals(t)}"
                             for t, world in zip(tracks, worlds, strict=True))}
    parts = (HERE / "page.html").read_text().split("%%")
    return "".join(fill[part] if i % 2 else part for i, part in enumerate(parts))


def _picture(track: Mapping[str, Any], world: Mapping[str, Any]) -> str:
    """The arena with the path, for a browser without script."""
    margin, width, depth = 0.15, world["width"], world["depth"]
    boxes = "".join(f'<rect class="solid {escape(s["kind"])}" x="{-s["l"] / 2:g}" y="{-s["w"] / 2:g}" '
                    f'width="{s["l"]:g}" height="{s["w"]:g}" transform="translate({s["x"]:g} {s["y"]:g}) '
                    f'rotate({degrees(s["yaw"]):g})"/>' for s in world["solids"])
    points = " ".join(f"{x:.2f},{y:.2f}" for x, y in
                      [track["start"][:2], *zip(track["x"], track["y"], strict=True)][::STEP])
    return (f'<div class="arena still"><svg viewBox="{-margin:g} {-depth - margin:g} {width + 2 * margin:g} '
            f'{depth + 2 * margin:g}" role="img" aria-label="The arena from above, with the robot\'s path">'
            f'<g transform="scale(1,-1)"><rect class="floor" width="{width:g}" height="{depth:g}"/>{boxes}<polyline '
            f'class="behind" points="{points}"/></g></svg></div>')


def _meals(track: Mapping[str, Any]) -> str:
    """The meals as a table, for a browser without script."""
    rows = "".join(f"<tr><td>{cycle}</td><td>{cycle * track['dt']:.1f} s</td><td>{escape(need)}</td>"
                   f"<td>{track['x'][cycle]:.2f}, {track['y'][cycle]:.2f}</td></tr>" for cycle, need in track["meals"])
    return f"<table><tr><th>cycle</th><th>time</th><th>satisfied</th><th>at, m</th></tr>{rows}</table>" if rows else ""


def _hash(text: str) -> str:
    return "sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
