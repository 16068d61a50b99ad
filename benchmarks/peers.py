"""Simulators that users may know, on the nearest work to a machine cycle that each offers. They do not learn; what a
step of theirs includes is in ``NOTES``, and that is what their figure means.

Each runs in a process of its own, of a Python that may have other packages than attnlab's (``python
benchmarks/peers.py NAME`` answers each line that it reads, a number of steps, with steps and CPU seconds); so nothing
here imports attnlab.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from math import pi
from pathlib import Path
from random import Random

Steps = Callable[[int], tuple[int, float]]  # how many are asked for -> how many were done, their CPU seconds
NOTES = {
    "ir-sim": "16 beams of 5 m every step, differential drive, collision test; no display, no camera; 4 boxes, 4 walls",
    "MiniGrid": "a grid world with its default 7x7 view every step (Empty-16x16); no geometry",
    "Enki": "e-puck with 8 infrared sensors and camera every step, physics of contact; C++ without Python",
    "EnvPool CartPole": "64 carts at once in C++, a step of each counted; a formula of four numbers, no sensors",
    "EnvPool Ant": "8 robots of MuJoCo at once in C++, a step of each counted; 5 steps of its physics in each",
}
ELSEWHERE = {"PufferLib": "not measured: it is built from source, against PyTorch; EnvPool stands for its kind"}
BOXES = ((1.2, 2.8), (2.8, 1.2), (0.25, 1.0), (3.75, 3.0))
INSTALL = "not installed (pip install -r benchmarks/requirements.txt)"


class Missing(Exception):
    """This peer cannot run here, and why."""


def irsim() -> Steps:
    """ir-sim in the paper's arena, stepped with random commands; put back when it collides."""
    import irsim as package
    import numpy as np
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

    def run(steps: int) -> tuple[int, float]:
        draw = Random(0)
        started = time.process_time()
        for _ in range(steps):
            env.step(np.array([[draw.uniform(0, 0.4)], [draw.uniform(-1.5, 1.5)]]))
            env.get_lidar_scan()
            if env.robot.collision:
                env.robot.set_state([2.0, 2.0, draw.uniform(-3, 3)])
        return steps, time.process_time() - started
    return run


def minigrid() -> Steps:
    """MiniGrid with random actions."""
    import gymnasium
    import minigrid  # noqa: F401  registers its environments
    env = gymnasium.make("MiniGrid-Empty-16x16-v0")

    def run(steps: int) -> tuple[int, float]:
        draw = Random(0)
        env.reset(seed=0)
        started = time.process_time()
        for _ in range(steps):
            *_, terminated, truncated, _ = env.step(draw.randrange(3))
            if terminated or truncated:
                env.reset()
        return steps, time.process_time() - started
    return run


def enki() -> Steps:
    """Enki (Debian: libenki-dev), a program of a page compiled on the spot; it prints its own CPU seconds."""
    if shutil.which("g++") is None or not any(Path(root, "enki/PhysicalEngine.h").exists()
                                              for root in ("/usr/include", "/usr/local/include")):
        raise Missing("not installed (apt-get install libenki-dev g++)")
    folder = Path(tempfile.mkdtemp())
    built = subprocess.run(["g++", "-O2", "-std=c++14", str(Path(__file__).with_name("enki.cpp")), "-o",
                            str(folder / "enki"), "-lenki"], capture_output=True, text=True)
    if built.returncode:
        raise Missing(f"does not compile: {built.stderr.strip().splitlines()[0]}")

    def run(steps: int) -> tuple[int, float]:
        done = subprocess.run([str(folder / "enki"), str(steps)], capture_output=True, text=True, check=True)
        return steps, float(done.stdout)
    return run


def envpool(task: str, robots: int) -> Callable[[], Steps]:
    """A task of EnvPool with random actions, on one thread."""
    def make() -> Steps:
        import envpool as package
        import numpy as np
        env = package.make(task, env_type="gymnasium", num_envs=robots, num_threads=1, seed=0)
        env.reset()
        env.action_space.seed(0)
        actions = [np.stack([env.action_space.sample() for _ in range(robots)]) for _ in range(100)]

        def run(steps: int) -> tuple[int, float]:
            calls = -(-steps // robots)
            started = time.process_time()
            for i in range(calls):
                env.step(actions[i % 100])
            return calls * robots, time.process_time() - started
        return run
    return make


PEERS: dict[str, tuple[Callable[[], Steps], int]] = {  # what makes it, and steps of a turn
    "ir-sim": (irsim, 2_000), "MiniGrid": (minigrid, 20_000), "Enki": (enki, 200_000),
    "EnvPool CartPole": (envpool("CartPole-v1", 64), 200_000), "EnvPool Ant": (envpool("Ant-v4", 8), 4_000)}


def entry(name: str, python: str, scale: float) -> Callable[[], tuple[int, float]]:
    """A turn of a peer, which waits in a process of its own; ``scale``: of how many steps that is. Raises Missing."""
    process = subprocess.Popen([python, __file__, name], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                               stderr=subprocess.DEVNULL)
    said, asked = process.stdout, process.stdin
    assert said is not None and asked is not None

    def answer() -> dict:
        for line in said:  # packages may greet whoever imports them
            if line.startswith("{"):
                return json.loads(line)
        raise Missing(f"its process ended with {process.wait()}")
    if why := answer().get("missing"):
        process.wait()
        raise Missing(why)
    steps = max(1, int(scale * PEERS[name][1]))

    def turn() -> tuple[int, float]:
        print(steps, file=asked, flush=True)
        found = answer()
        return found["steps"], found["seconds"]
    return turn


def versions(python: str) -> dict[str, str]:
    """Of the peers' packages in their Python."""
    code = ("import importlib.metadata as m, json; found = {d.metadata['Name'].lower(): d.version for d in "
            "m.distributions()}; print(json.dumps({n: found[n] for n in ('ir-sim', 'minigrid', 'envpool') "
            "if n in found}))")
    return json.loads(subprocess.run([python, "-c", code], capture_output=True, text=True, check=True).stdout)


def main() -> None:
    try:
        run = PEERS[sys.argv[1]][0]()
    except Missing as why:
        print(json.dumps({"missing": str(why)}))
        return
    except ImportError as why:
        print(json.dumps({"missing": INSTALL if why.name in ("irsim", "minigrid", "envpool", "gymnasium")
                          else f"does not start ({why})"}))
        return
    except Exception as why:  # noqa: BLE001  whatever a package does
        print(json.dumps({"missing": f"does not start ({type(why).__name__}: {str(why).splitlines()[0]})"}))
        return
    print(json.dumps({"ready": True}), flush=True)
    for line in sys.stdin:
        steps, seconds = run(int(line))
        print(json.dumps({"steps": steps, "seconds": seconds}), flush=True)


if __name__ == "__main__":
    main()
