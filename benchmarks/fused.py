"""The limit: the same sensing and moving as a run's, with control in the same compiled loop and nothing else.

Reactive control of two lines stands in for the behaviours; the sensors are read as often as a learning robot reads
them (reads a cycle, measured in a run). No learning, no needs, no records.
"""

from __future__ import annotations

from math import pi

import numpy as np
from numba import njit

from attnlab.kernels import planar
from attnlab.simulators.planar import Planar
from attnlab.simulators.robot import CAMERA_HEIGHT_M, FRONT, RADIUS_M, SONAR_MIN_M


@njit(error_model="numpy")
def drive(trace, boxes, cubes, beams, columns, rows, focal, reach, dt, per_sonar, per_image, per_step, least, radius,
          half_height, ranges, seen):
    """Cycles moved until the trace is full; a contact turns the robot round and does not end the drive.

    ``per_sonar``, ``per_image`` and ``per_step``: cycles between two readings and between two calls of the motion.
    """
    cycle, v, w, next_sonar, next_image, total = 0, 0.4, 0.0, 0.0, 0.0, 0.0
    last = len(trace) - 1
    while cycle < last:
        if cycle >= next_sonar:
            planar.sonar(trace, cycle, boxes, beams, reach, least, ranges)
            nearest = ranges.min()
            v, w = 0.4 * min(1.0, max(0.0, nearest - 0.2)), 1.0 if nearest < 0.5 else 0.0
            next_sonar += per_sonar
        if cycle >= next_image:
            if planar.blobs(trace, cycle, boxes, cubes, columns, rows, focal, half_height, seen) and w == 0.0:
                w = 0.1 * (columns / 2 - seen[0, 1]) / columns
            next_image += per_image
        total += per_step
        steps = min(last - cycle, max(1, int(total) - cycle))
        moved = planar.advance(trace, cycle, boxes, v, w, dt, steps, radius, 0.0, beams, reach, least)
        cycle += abs(moved)
        if moved < 0:  # back to before the contact, facing away
            trace[cycle, 0], trace[cycle, 1] = trace[cycle - 1, 0], trace[cycle - 1, 1]
            trace[cycle, 2] = (trace[cycle - 1, 2] + pi / 2 + pi) % (2 * pi) - pi
    return cycle


def limit(simulator: Planar, reads: dict[str, float], cycles: int) -> int:
    """Drive ``cycles`` cycles in the simulator's world; ``reads``: sonars, images and motions a cycle."""
    cam, p = simulator.camera, simulator.params
    trace = np.zeros((cycles + 1, 3))
    trace[0] = simulator.trace[0]
    every = [1.0 / reads[what] for what in ("sonar", "blobs", "advance")]
    return drive(trace, simulator._boxes, simulator._cubes, simulator._front, cam.columns, cam.rows, cam.focal_px,
                 p.sonar_range_m, simulator.dt_s, *every, SONAR_MIN_M, RADIUS_M, CAMERA_HEIGHT_M,
                 np.zeros(len(FRONT)), np.zeros((simulator._cubes, 4)))
