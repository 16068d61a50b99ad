"""Simulators that users may know, on the nearest work to a machine cycle that each offers. Missing ones raise Missing.

They do not learn; what a step of theirs includes is in ``NOTES``, and that is what their figure means.
"""

from __future__ import annotations

import shutil
import subprocess
import tempfile
import time
from math import pi
from pathlib import Path
from random import Random

from benchmarks.loops import Entry

NOTES = {
    "ir-sim": "16 beams of 5 m every step, differential drive, collision test; no display, no camera; 4 boxes, 4 walls",
    "MiniGrid": "a grid world with its default 7x7 view every step (Empty-16x16); no geometry, no learning",
    "Enki": "e-puck with 8 infrared sensors and camera every step, physics of contact; C++ without Python",
}
BOXES = ((1.2, 2.8), (2.8, 1.2), (0.25, 1.0), (3.75, 3.0))


class Missing(Exception):
    """This peer cannot run here, and why."""


def irsim(steps: int) -> Entry:
    """ir-sim in the paper's arena, stepped with random commands; put back when it collides."""
    try:
        import irsim as package
        import numpy as np
    except ImportError:
        raise Missing("not installed (pip install -r benchmarks/requirements.txt)") from None
    walls = ((2, -0.05, 4.2, 0.1), (2, 4.05, 4.2, 0.1), (-0.05, 2, 0.1, 4), (4.05, 2, 0.1, 4))
    obstacles = "\n".join(f"  - shape: {{name: rectangle, length: {a}, width: {b}}}\n    state: [{x}, {y}, 0]"
                          for x, y, a, b in (*walls, *((x, y, 0.5, 0.5) for x, y in BOXES)))
    world = f"""
world: {{height: 6, width: 6, offset: [-1, -1], step_time: 0.1565, sample_time: 0.1565, collision_mode: unobstructed}}
robot:
  - kinematics: {{name: diff}}
    shape: {{name: circle, radius: 0.25}}
    state: [2, 2, 0]
    vel_max: [0.4, 1.5]
    vel_min: [-0.4, -1.5]
    sensors:
      - {{type: lidar2d, range_min: 0, range_max: 5, angle_range: {2 * pi}, number: 16}}
obstacle:
{obstacles}
"""
    with tempfile.NamedTemporaryFile("w", suffix=".yaml", delete=False) as file:
        file.write(world)
    env = package.make(file.name, display=False, disable_all_plot=True, headless=True, log_level="ERROR")
    Path(file.name).unlink()

    def entry() -> tuple[int, float]:
        draw = Random(0)
        started = time.process_time()
        for _ in range(steps):
            env.step(np.array([[draw.uniform(0, 0.4)], [draw.uniform(-1.5, 1.5)]]))
            env.get_lidar_scan()
            if env.robot.collision:
                env.robot.set_state([2.0, 2.0, draw.uniform(-3, 3)])
        return steps, time.process_time() - started
    return entry


def minigrid(steps: int) -> Entry:
    """MiniGrid with random actions."""
    try:
        import gymnasium
        import minigrid  # noqa: F401  registers its environments
    except ImportError:
        raise Missing("not installed (pip install -r benchmarks/requirements.txt)") from None
    env = gymnasium.make("MiniGrid-Empty-16x16-v0")

    def entry() -> tuple[int, float]:
        draw = Random(0)
        env.reset(seed=0)
        started = time.process_time()
        for _ in range(steps):
            *_, terminated, truncated, _ = env.step(draw.randrange(3))
            if terminated or truncated:
                env.reset()
        return steps, time.process_time() - started
    return entry


def enki(steps: int) -> Entry:
    """Enki (Debian: libenki-dev), a program of a page compiled on the spot; it prints its own CPU seconds."""
    if shutil.which("g++") is None or not any(Path(root, "enki/PhysicalEngine.h").exists()
                                              for root in ("/usr/include", "/usr/local/include")):
        raise Missing("not installed (apt-get install libenki-dev g++)")
    folder = Path(tempfile.mkdtemp())
    built = subprocess.run(["g++", "-O2", "-std=c++14", str(Path(__file__).with_name("enki.cpp")), "-o",
                            str(folder / "enki"), "-lenki"], capture_output=True, text=True)
    if built.returncode:
        raise Missing(f"does not compile: {built.stderr.strip().splitlines()[0]}")

    def entry() -> tuple[int, float]:
        done = subprocess.run([str(folder / "enki"), str(steps)], capture_output=True, text=True, check=True)
        return steps, float(done.stdout)
    return entry


PEERS = {"ir-sim": (irsim, 2_000), "MiniGrid": (minigrid, 20_000), "Enki": (enki, 200_000)}
