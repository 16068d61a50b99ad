"""Exact plane geometry of the robot's sensors and motion, compiled.

``boxes`` is an (n, 7) float64 array, a row a solid: centre x, y (m), cos and sin of its yaw, half length, half width
(m), radius of its circumcircle (m). ``trace`` is the (cycles + 1, 3) float64 array of poses; the robot stands at
``trace[cycle]``.
"""

from __future__ import annotations

from math import cos, floor, inf, pi, sin, sqrt

import numpy as np
import numpy.typing as npt

from attnlab.kernels.compile import compiled, inner

Floats = npt.NDArray[np.float64]


@inner
def crossing(x: float, y: float, dx: float, dy: float, c: float, s: float, half_length: float, half_width: float
             ) -> tuple[float, float]:
    """Where the line from (x, y), relative to the box's centre, along (dx, dy) enters and leaves it, in units of
    (dx, dy); (inf, -inf) if it misses."""
    px, py = c * x + s * y, c * y - s * x
    qx, qy = c * dx + s * dy, c * dy - s * dx
    enters, leaves = -inf, inf
    if qx != 0.0:
        one, two = (-half_length - px) / qx, (half_length - px) / qx
        enters, leaves = min(one, two), max(one, two)
    elif abs(px) > half_length:
        return inf, -inf
    if qy != 0.0:
        one, two = (-half_width - py) / qy, (half_width - py) / qy
        enters, leaves = max(enters, min(one, two)), min(leaves, max(one, two))
    elif abs(py) > half_width:
        return inf, -inf
    return (enters, leaves) if enters <= leaves else (inf, -inf)


@compiled("void(float64[:, ::1], int64, float64[:, ::1], float64[:, ::1], float64, float64, float64[::1])")
def sonar(trace: Floats, cycle: int, boxes: Floats, beams: Floats, reach: float, shortest: float, ranges: Floats
          ) -> None:
    """Fill ``ranges`` (m) of the first len(ranges) rows of ``beams``, see :data:`attnlab.simulators.robot.BEAMS`.

    The first surface on the way is heard, from whichever side.
    """
    x, y, c, s = trace[cycle, 0], trace[cycle, 1], cos(trace[cycle, 2]), sin(trace[cycle, 2])
    for k in range(len(ranges)):
        ox, oy = x + c * beams[k, 0] - s * beams[k, 1], y + s * beams[k, 0] + c * beams[k, 1]
        dx, dy = c * beams[k, 2] - s * beams[k, 3], s * beams[k, 2] + c * beams[k, 3]
        nearest = beams[k, 4] + reach
        for b in range(len(boxes)):
            rx, ry, round_m = boxes[b, 0] - ox, boxes[b, 1] - oy, boxes[b, 6]
            if abs(dx * ry - dy * rx) > round_m or dx * rx + dy * ry + round_m < 0.0:
                continue  # the ray passes by the box's circumcircle
            enters, leaves = crossing(-rx, -ry, dx, dy, boxes[b, 2], boxes[b, 3], boxes[b, 4], boxes[b, 5])
            if enters >= 0.0:
                nearest = min(nearest, enters)
            elif leaves >= 0.0:
                nearest = min(nearest, leaves)
        ranges[k] = max(nearest - beams[k, 4], shortest)


@inner
def arc(trace: Floats, at: int, v: float, w: float, dt: float) -> None:
    """The pose after a cycle into ``trace[at]``, as :func:`attnlab.simulators.robot.arc` has it, heading wrapped."""
    x, y, heading, turn = trace[at - 1, 0], trace[at - 1, 1], trace[at - 1, 2], w * dt
    after = heading + turn
    if -1e-9 < turn < 1e-9:
        trace[at, 0], trace[at, 1] = x + v * dt * cos(heading), y + v * dt * sin(heading)
    else:
        radius = v / w
        trace[at, 0] = x + radius * (sin(after) - sin(heading))
        trace[at, 1] = y - radius * (cos(after) - cos(heading))
    trace[at, 2] = (after + pi) % (2 * pi) - pi


@inner
def touches(x: float, y: float, boxes: Floats, radius: float) -> bool:
    """Does a disc touch a box? Touching edges do."""
    for b in range(len(boxes)):
        dx, dy = x - boxes[b, 0], y - boxes[b, 1]
        along = abs(boxes[b, 2] * dx + boxes[b, 3] * dy) - boxes[b, 4]
        across = abs(boxes[b, 2] * dy - boxes[b, 3] * dx) - boxes[b, 5]
        if along <= radius and across <= radius and max(along, 0.0) ** 2 + max(across, 0.0) ** 2 <= radius * radius:
            return True
    return False


@inner
def span(box: Floats, x: float, y: float, c: float, s: float, columns: int, focal: float) -> tuple[int, int]:
    """First and one past the last column that can meet a box; all of them if part of it is not ahead."""
    low, high, behind = inf, -inf, 0
    for corner in range(4):
        along = box[4] if corner < 2 else -box[4]
        across = box[5] if corner % 2 == 0 else -box[5]
        gx, gy = box[0] + box[2] * along - box[3] * across - x, box[1] + box[3] * along + box[2] * across - y
        ahead = c * gx + s * gy
        if ahead < 1e-6:
            behind += 1
        else:
            column = columns / 2 - focal * (c * gy - s * gx) / ahead
            low, high = min(low, column), max(high, column)
    if behind == 4 or (behind == 0 and (high < 0.0 or low > columns)):
        return 0, 0
    if behind > 0:
        return 0, columns
    return int(max(low - 1.0, 0.0)), int(min(high + 1.0, float(columns)))


@inner
def pixel_rows(half_px: float, rows: int) -> int:
    """How many of ``rows`` pixel centres lie within ``half_px`` of the image's middle line."""
    if half_px >= rows / 2:
        return rows
    return 2 * int(floor(half_px + 0.5)) if rows % 2 == 0 else 2 * int(floor(half_px)) + 1


@compiled("int64(float64[:, ::1], int64, float64[:, ::1], int64, int64, int64, float64, float64, float64[:, ::1])")
def blobs(trace: Floats, cycle: int, boxes: Floats, cubes: int, columns: int, rows: int, focal: float,
          half_height: float, seen: Floats) -> int:
    """Blobs of the pinhole camera at the robot's centre; how many rows of ``seen`` are filled.

    The first ``cubes`` boxes make blobs, the others only hide. ``half_height``: how far every box reaches above and
    below the camera, m. A pixel belongs to the box that its centre's ray enters first (one it starts in hides nothing,
    as in a renderer that culls back faces). A row of ``seen``: the box, its
    centroid column (px from the left edge), its tallest column (px), its area (px).
    """
    x, y, c, s = trace[cycle, 0], trace[cycle, 1], cos(trace[cycle, 2]), sin(trace[cycle, 2])
    depths, owner = np.full(columns, inf), np.full(columns, -1)
    for b in range(len(boxes)):
        first, last = span(boxes[b], x, y, c, s, columns, focal)
        for column in range(first, last):
            if b >= cubes and owner[column] < 0:
                continue  # no cube there to hide
            left = (columns / 2 - column - 0.5) / focal  # sideways for each metre ahead, so that lengths are depths
            depth, _ = crossing(x - boxes[b, 0], y - boxes[b, 1], c - s * left, s + c * left,
                                boxes[b, 2], boxes[b, 3], boxes[b, 4], boxes[b, 5])
            if 0.0 <= depth < depths[column]:
                depths[column], owner[column] = depth, b
    seen[:cubes] = 0.0
    for column in range(columns):
        b = owner[column]
        if 0 <= b < cubes:
            height = pixel_rows(focal * half_height / depths[column], rows)
            seen[b, 1] += height * (column + 0.5)
            seen[b, 2] = max(seen[b, 2], height)
            seen[b, 3] += height
    filled = 0
    for b in range(cubes):
        if seen[b, 3] > 0.0:
            seen[filled, 0], seen[filled, 1] = b, seen[b, 1] / seen[b, 3]
            seen[filled, 2], seen[filled, 3] = seen[b, 2], seen[b, 3]
            filled += 1
    return filled


@compiled("int64(float64[:, ::1], int64, float64[:, ::1], float64, float64, float64, int64, float64, float64,"
          " float64[:, ::1], float64, float64)")
def advance(trace: Floats, cycle: int, boxes: Floats, v: float, w: float, dt: float, cycles: int, radius: float,
            safety: float, beams: Floats, reach: float, shortest: float) -> int:
    """Move up to ``cycles`` cycles of ``dt`` s at v (m/s), w (rad/s), writing ``trace``; the number moved, negative if
    the last of them crashed: the disc of ``radius`` m touches a box, or (``safety`` > 0) the echo of one of
    ``beams`` comes from nearer than ``safety`` m to the centre."""
    ranges = np.empty(len(beams) if safety > 0.0 else 0)
    for moved in range(1, cycles + 1):
        at = cycle + moved
        arc(trace, at, v, w, dt)
        if touches(trace[at, 0], trace[at, 1], boxes, radius):
            return -moved
        if safety > 0.0:
            sonar(trace, at, boxes, beams, reach, shortest, ranges)
            for k in range(len(ranges)):
                along, x, y = ranges[k] + beams[k, 4], beams[k, 0], beams[k, 1]
                if sqrt(along * along + (x * x + y * y)) < safety:
                    return -moved
    return cycles
