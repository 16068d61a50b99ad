"""The ring of sonars of the Pioneer 3-DX, and how a unicycle moves: what simulators and readers of logs share.

Sonar poses as published in public descriptions of the robot; the first eight are the frontal ring.
"""

from __future__ import annotations

from math import cos, radians, sin

SONARS_MM_DEG = (
    (69, 136, 90), (114, 119, 50), (148, 78, 30), (166, 27, 10), (166, -27, -10), (148, -78, -30), (114, -119, -50),
    (69, -136, -90), (-157, -136, -90), (-203, -119, -130), (-237, -78, -150), (-255, -27, -170), (-255, 27, 170),
    (-237, 78, 150), (-203, 119, 130), (-157, 136, 90),
)
SONARS = tuple((x / 1000, y / 1000, radians(deg)) for x, y, deg in SONARS_MM_DEG)  # (x m, y m, rad), robot frame
FRONT = range(8)


def arc(x: float, y: float, heading: float, v: float, w: float, dt: float) -> tuple[float, float, float]:
    """The pose after moving for ``dt`` s at ``v`` m/s and ``w`` rad/s: the exact arc of a unicycle."""
    turn = w * dt
    if -1e-9 < turn < 1e-9:
        return x + v * dt * cos(heading), y + v * dt * sin(heading), heading + turn
    radius, after = v / w, heading + turn
    return x + radius * (sin(after) - sin(heading)), y - radius * (cos(after) - cos(heading)), after
