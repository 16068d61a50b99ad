"""A log's scans as a ring of sixteen sonars would hear them."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from math import isnan, pi, radians

from attnlab.logs.base import Beams, Scan
from attnlab.pioneer import FRONT, SONARS

HALF_CONE_RAD = radians(7.5)  # a sonar hears the nearest of the beams this near to its axis
FRONT_RAD = pi / 2 + 1e-6


@lru_cache(maxsize=64)
def cones(bearings_rad: tuple[float, ...]) -> tuple[tuple[int, ...], ...]:
    """The beams that each sonar hears: those within its cone, else the nearest within two cones, else none."""
    found = []
    for *_, axis in SONARS:
        off = [abs((bearing - axis + pi) % (2 * pi) - pi) for bearing in bearings_rad]
        within = tuple(i for i, angle in enumerate(off) if angle <= HALF_CONE_RAD + 1e-9)
        nearest = min(range(len(off)), key=off.__getitem__)
        found.append(within or ((nearest,) if off[nearest] <= 2 * HALF_CONE_RAD + 1e-9 else ()))
    return tuple(found)


@lru_cache(maxsize=64)
def sectors(bearings_rad: tuple[float, ...]) -> tuple[tuple[int, ...], ...]:
    """The beams that are nearer to a sonar's axis than to any other's: each beam is heard by one."""
    found: list[list[int]] = [[] for _ in SONARS]
    for i, bearing in enumerate(bearings_rad):
        off = [abs((bearing - axis + pi) % (2 * pi) - pi) for *_, axis in SONARS]
        found[min(range(len(off)), key=off.__getitem__)].append(i)
    return tuple(map(tuple, found))


def least(ranges: Sequence[float], chosen: Sequence[int]) -> float | None:
    """The nearest of some beams, those without a valid range left out; None if there is none."""
    found = [ranges[i] for i in chosen if not isnan(ranges[i])]
    return min(found) if found else None


def ring(scan: Scan, silent_m: float) -> list[float]:
    """Ranges of the sixteen sonars, m from the sensor, cut at ``silent_m``: what a sonar reads that heard nothing, or
    that the log's sensor does not cover."""
    heard = (least(scan.ranges_m, chosen) for chosen in cones(scan.beams.bearings_rad))
    return [silent_m if r is None else min(r, silent_m) for r in heard]


@lru_cache(maxsize=64)
def frontal(beams: Beams) -> tuple[int, ...]:
    """The beams of the front half."""
    return tuple(i for i, bearing in enumerate(beams.bearings_rad)
                 if abs((bearing + pi) % (2 * pi) - pi) <= FRONT_RAD)


def nearest_ahead(scan: Scan, sonars: bool = True) -> float | None:
    """The nearest of the front half, m from the sensor: of the eight frontal sonars, or of the log's own beams. None
    if none of them gave a valid range."""
    if not sonars:
        return least(scan.ranges_m, frontal(scan.beams))
    heard = (least(scan.ranges_m, cones(scan.beams.bearings_rad)[i]) for i in FRONT)
    return min((r for r in heard if r is not None), default=None)
