"""Checks of a simulator and of a world."""

from __future__ import annotations

import math
from random import Random
from typing import Any

from attnlab.simulators.base import Blob, Simulator
from attnlab.simulators.robot import SONARS
from attnlab.testing.build import layout, make
from attnlab.worlds.geometry import clearance

Step = tuple[int, bool, tuple[float, float, float], list[float], list[Blob]]  # cycles, crashed, pose, sonar, blobs


def drive(simulator: Simulator, steps: int, seed: int = 2) -> list[Step]:
    """What is sensed on a random drive."""
    draw = Random(seed)
    trace: list[Step] = []
    for _ in range(steps):
        if simulator.cycle > 1000:
            break
        moved, crashed = simulator.advance(draw.uniform(0, 0.4), draw.uniform(-1.5, 1.5), draw.randint(1, 4))
        trace.append((moved, crashed, simulator.pose(), simulator.sonar(), simulator.blobs()))
        if crashed:
            break
    return trace


def senses_in_range(name: str, **settings: Any) -> None:
    """16 finite sonar ranges within reach, blobs of the layout's solids, the pose after every cycle in the trace."""
    with make("simulator", name, **settings) as simulator:
        simulator.place(2.0, 2.0, 0.5)
        assert simulator.cycle == 0 and simulator.pose() == tuple(simulator.trace[0])
        cycles = 0
        for moved, _, pose, sonar, blobs in drive(simulator, 30):
            cycles += moved
            assert len(sonar) == len(SONARS) and all(0.0 <= d <= simulator.params.sonar_range_m for d in sonar)
            assert all(map(math.isfinite, pose))
            assert all(b.kind == simulator.layout.solids[b.solid].kind and b.distance_m > 0 for b in blobs)
        assert simulator.cycle == cycles
        assert tuple(simulator.trace[cycles]) == simulator.pose()


def places_anew(name: str, **settings: Any) -> None:
    """Every start is like the first one."""
    with make("simulator", name, **settings) as simulator:
        drives = []
        for _ in range(2):
            simulator.place(2.0, 2.0, 0.5)
            drives.append(drive(simulator, 20))
        assert drives[0] == drives[1], f"{name}: the second episode differs from the first"


def restores(name: str, **settings: Any) -> None:
    """A snapshot goes on exactly as it did."""
    with make("simulator", name, **settings) as simulator:
        simulator.place(2.0, 2.0, 0.5)
        drive(simulator, 5)
        state = simulator.snapshot()
        first = drive(simulator, 10, seed=3)
        simulator.restore(state)
        assert drive(simulator, 10, seed=3) == first, f"{name}: a restored snapshot went on otherwise"


def closes_twice(name: str, **settings: Any) -> None:
    """Closing again does no harm."""
    simulator = make("simulator", name, **settings)
    simulator.close()
    simulator.close()


SIMULATOR = (senses_in_range, places_anew, restores, closes_twice)


def built_from_seed(name: str, **settings: Any) -> None:
    """The same seed builds the same world, and it has room to start in."""
    for seed in (0, 1, 2):
        world = layout(seed, name, **settings)
        assert world == layout(seed, name, **settings), f"{name}: seed {seed} built two worlds"
        x, y, _ = world.random_start(Random(0))
        assert clearance(x, y, world.solids) >= world.start_clearance_m


def no_global_draws(name: str, **settings: Any) -> None:
    """The world comes from the seed alone."""
    import random
    saved = random.getstate()
    try:
        worlds = []
        for seed in (1, 2):
            random.seed(seed)
            worlds.append(layout(0, name, **settings))
            assert random.getstate() == random.Random(seed).getstate(), f"{name}: moves the global random state"
        assert worlds[0] == worlds[1], f"{name}: depends on the global random state"
    finally:
        random.setstate(saved)


WORLD = (built_from_seed, no_global_draws)
