"""The two simulators at the same random poses: every sensor, contact, and the same commands driven open loop."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import cos, pi, sin
from random import Random
from typing import Any

import numpy as np

from attnlab.simulators.base import Blob, Simulator
from attnlab.simulators.robot import BEAMS, RADIUS_M
from attnlab.worlds.geometry import clearance

GRAZE_M = 0.001  # a beam that passes an edge nearer than this may hit or miss it by rounding


def compare_poses(one: Simulator, two: Simulator, count: int, draw: Random, tick: Callable[[], None]
                  ) -> dict[str, Any]:
    """Errors of ``two`` against ``one`` over ``count`` poses, uniform over the floor and all headings.

    Contact is compared at every pose, sensors where there is none. Lengths in m, bearing and height in px.
    """
    layout, columns = one.layout, one.camera.columns
    edges = np.array([corner for solid in layout.solids for corner in solid.corners()]).reshape(-1, 2)
    ranges, grazes, bearing, height, area = [], [], [], [], []
    contacts, deepest, blobs, missed, compared = 0, 0.0, 0, 0, 0
    for _ in range(count):
        pose = draw.uniform(0.0, layout.width_m), draw.uniform(0.0, layout.depth_m), draw.uniform(-pi, pi)
        touching = [_touches(simulator, pose) for simulator in (one, two)]
        if touching[0] != touching[1]:
            contacts += 1
            deepest = max(deepest, abs(clearance(*pose[:2], layout.solids) - RADIUS_M))
        tick()
        if any(touching):
            continue
        compared += 1
        ranges.append(np.abs(np.subtract(one.sonar(), two.sonar())))
        grazes.append(_grazing(pose, edges, one.params.sonar_range_m))
        seen, other = _by_solid(one.blobs()), _by_solid(two.blobs())
        blobs += len(seen.keys() | other.keys())
        missed += len(seen.keys() ^ other.keys())
        for solid in seen.keys() & other.keys():
            a, b = seen[solid], other[solid]
            bearing.append(abs(one.camera.column(a.bearing_rad) - two.camera.column(b.bearing_rad)))
            height.append(abs(a.height_px - b.height_px))
            area.append(abs(a.area_px - b.area_px))
    off, grazing = np.array(ranges).reshape(-1), np.array(grazes, bool).reshape(-1)
    return {
        "poses": count, "poses_sensed": compared, "rays": len(off), "rays_grazing": int(grazing.sum()),
        **_spread("sonar_m", off[~grazing]), **_spread("sonar_all_m", off),
        "blobs": blobs, "blob_miss_share": missed / blobs if blobs else 0.0, "columns": columns,
        **_spread("bearing_px", bearing), **_spread("height_px", height), **_spread("area_px", area),
        "contact_disagreement_share": contacts / count, "contact_depth_max_m": deepest,
    }


def compare_drives(one: Simulator, two: Simulator, count: int, draw: Random, tick: Callable[[], None]
                  ) -> dict[str, Any]:
    """The same random commands in both from the same start until either crashes: gap of position (m), heading (rad)."""
    gaps, turns, ends = [], [], 0
    for _ in range(count):
        start = one.layout.random_start(draw)
        one.place(*start)
        two.place(*start)
        ended = False
        while not ended and one.cycle + 12 < len(one.trace):
            command = draw.uniform(0.0, 0.4), draw.uniform(-1.5, 1.5), draw.choice((1, 4, 8, 12))
            first, second = one.advance(*command), two.advance(*command)
            ended = first[1] or second[1]
            ends += first != second
        n = min(one.cycle, two.cycle) + 1
        step = one.trace[:n] - two.trace[:n]
        gaps.append(np.hypot(step[:, 0], step[:, 1]).max())
        turns.append(np.abs((step[:, 2] + pi) % (2 * pi) - pi).max())
        tick()
    return {"drives": count, "drive_gap_max_m": float(max(gaps)), "drive_turn_max_rad": float(max(turns)),
            "drive_end_disagreements": ends}


def _touches(simulator: Simulator, pose: tuple[float, float, float]) -> bool:
    simulator.place(*pose)
    return simulator.advance(0.0, 0.0, 1)[1]


def _by_solid(blobs: list[Blob]) -> dict[int, Blob]:
    return {blob.solid: blob for blob in blobs}


def _grazing(pose: tuple[float, float, float], edges: np.ndarray, reach: float) -> list[bool]:
    """Which beams pass a vertical edge nearer than GRAZE_M?"""
    x, y, heading = pose
    c, s = cos(heading), sin(heading)
    grazing = []
    for fx, fy, bc, bs, offset in BEAMS:
        dx, dy = c * bc - s * bs, s * bc + c * bs
        gap = edges - (x + c * fx - s * fy, y + s * fx + c * fy)
        along, across = gap @ (dx, dy), np.abs(gap @ (-dy, dx))
        grazing.append(bool(np.any((across < GRAZE_M) & (along > 0) & (along < offset + reach + GRAZE_M))))
    return grazing


def _spread(name: str, values: Sequence[float] | np.ndarray) -> dict[str, float]:
    """Median, 99 % and maximum; 0 without values."""
    values = np.asarray(values, float)
    if not len(values):
        values = np.zeros(1)
    return {f"{name}_median": float(np.median(values)), f"{name}_p99": float(np.quantile(values, 0.99)),
            f"{name}_max": float(values.max())}

