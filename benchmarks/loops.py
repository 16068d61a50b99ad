"""attnlab's own entries: whole runs and the loop alone by both engines, the sensors alone, single calls, memory."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any

from attnlab import compose
from attnlab.robot.engines import player
from attnlab.robot.episodes import play_run
from attnlab.robot.plan import RunPlan
from attnlab.simulators.base import Simulator, SimulatorContext
from attnlab.worlds.base import Layout, outer_walls
from attnlab.worlds.geometry import Solid

Entry = Callable[[], tuple[int, float]]  # -> machine cycles, CPU seconds


def plan(train: int, validation: int, *settings: str) -> RunPlan:
    """A run: AVOID, EAT, DRINK, Litman, Q-learning, softmax, in the paper's world, if the settings say nothing else."""
    return RunPlan(compose(f"train_episodes={train}", f"validation_episodes={validation}", *settings))


def whole(engine: str, train: int, validation: int, *settings: str) -> Entry:
    """Whole runs, tables included, without starting the process."""
    def entry() -> tuple[int, float]:
        run = plan(train, validation, *settings)
        started = time.process_time()
        cycles = play_run(run, engine=engine)[1]
        return cycles, time.process_time() - started
    return entry


def alone(engine: str, episodes: int) -> Entry:
    """Training episodes on planar without a table of theirs: what a cycle costs. The robot is made before."""
    run = plan(episodes, 0, "simulator=planar")

    def entry() -> tuple[int, float]:
        simulator = run.simulator()
        agent, exploration, cycles = run.agent(simulator), run.exploration("train"), 0
        play, _, _ = player(engine, agent, [exploration])
        started = time.process_time()
        for episode in range(episodes):
            exploration.start(episode)
            play(agent, exploration, run.start_pose("train", episode), True)
            cycles += simulator.cycle
        return cycles, time.process_time() - started
    return entry


def reads_a_cycle(train: int = 20) -> dict[str, float]:
    """How often a learning robot reads its sonars and its camera and sets its speed, a machine cycle."""
    experiment, counts = plan(train, 5, "simulator=planar"), Counter()
    simulator = experiment.simulator()
    def counting(what: str) -> Callable:
        inner = getattr(simulator, what)

        def counted(*arguments):
            counts[what] += 1
            return inner(*arguments)
        return counted

    for what in ("sonar", "blobs", "advance"):
        setattr(simulator, what, counting(what))
    experiment.simulator = lambda validation=False: simulator
    cycles = play_run(experiment)[1]
    return {what: count / cycles for what, count in counts.items()}


def sensors_only(simulator: Simulator, reads: dict[str, float], cycles: int) -> Entry:
    """The same sensing and moving through the protocol, from plain Python, with control of two lines."""
    def entry() -> tuple[int, float]:
        done, draw, place = 0, Random(0), Random(1)
        next_sonar = next_image = total = 0.0
        started = time.process_time()
        while done < cycles:
            simulator.place(*simulator.layout.random_start(place))
            v, w, base, crashed = 0.4, 0.0, done, False
            while not crashed and simulator.cycle + 13 < len(simulator.trace) and done < cycles:
                if done >= next_sonar:
                    nearest = min(simulator.sonar(8))
                    v, w = 0.4 * min(1.0, max(0.0, nearest - 0.2)), 1.0 if nearest < 0.5 else 0.0
                    next_sonar += 1.0 / reads["sonar"]
                if done >= next_image:
                    blobs = simulator.blobs()
                    w += 0.1 * blobs[0].bearing_rad if blobs else draw.uniform(-0.1, 0.1)
                    next_image += 1.0 / reads["blobs"]
                total += 1.0 / reads["advance"]
                _, crashed = simulator.advance(v, w, max(1, min(12, int(total) - done)))
                done = base + simulator.cycle
        return done, time.process_time() - started
    return entry


def crowd(boxes: int) -> Layout:
    """A square world that grows with its number of cubes: one for each 3 m2."""
    side = max(4.0, (3.0 * boxes) ** 0.5)
    across = int(boxes ** 0.5 + 0.999)
    step = side / across
    kinds = ("obstacle", "food", "water")
    solids = [Solid(kinds[i % 3], (i % across + 0.3) * step, (i // across + 0.3) * step, 0.5, 0.5)
              for i in range(boxes)]
    return Layout(side, side, (*outer_walls(side, side), *solids), (0.0, side, 0.0, side), 0.3)


def simulator(name: str, layout: Layout | None = None, *settings: str, cycles: int = 1150) -> Simulator:
    """A simulator of the default run, in its world or another."""
    experiment = plan(1, 0, f"simulator={name}", *settings)
    spec, params = experiment.simulator_spec
    return spec.cls(params, SimulatorContext(layout or experiment.layout, experiment.reading.dt_s, cycles))


def profile_by_part() -> dict[str, float]:
    """Share of a run's time spent in each module of attnlab itself (what it calls in Python and C counts with it);
    the profiler makes calls dearer than they are."""
    import cProfile
    import pstats
    experiment = plan(60, 20, "simulator=planar")
    profile = cProfile.Profile()
    profile.runcall(play_run, experiment)
    spent: Counter = Counter()
    for (file, *_), (_calls, _all, own, _total, callers) in pstats.Stats(profile).stats.items():
        if "attnlab" in file:
            spent[_part(file)] += own
        else:  # what is not ours counts for who called it
            for (caller, *_where), (_n, _m, share, _sum) in callers.items():
                spent[_part(caller)] += share
    total = sum(spent.values())
    return {part: seconds / total for part, seconds in spent.most_common()}


def _part(file: str) -> str:
    return file.split("attnlab/")[-1].removesuffix(".py") if "attnlab/" in file else "libraries"


def memory_over_episodes(episodes: int) -> dict[str, float]:
    """Resident memory (MB) after a fifth of a run and at its end: flat, but for rows of the tables."""
    marks: list[float] = []

    def progress(done: int, _: int) -> None:
        if done in (episodes // 5, episodes):
            marks.append(int(Path("/proc/self/statm").read_text().split()[1]) * 4096 / 1e6)
    play_run(plan(episodes - 1, 1, "simulator=planar"), progress=progress)
    return {"episodes": episodes, "mb_after_a_fifth": marks[0], "mb_at_the_end": marks[1]}


def calls() -> dict[str, Entry]:
    """Single calls of simulators, at poses of the paper's world that are drawn once; the "cycles" are calls."""
    def reading(made: Simulator, call: Callable[[], Any], times: int) -> Entry:
        def entry() -> tuple[int, float]:
            draw, poses = Random(0), 20
            spent = 0.0
            for _ in range(poses):
                made.place(*made.layout.random_start(draw))
                started = time.process_time()
                for _ in range(times):
                    call()
                spent += time.process_time() - started
            return poses * times, spent
        return entry

    def motion(made: Simulator, times: int) -> Entry:
        def entry() -> tuple[int, float]:
            draw, done, spent = Random(0), 0, 0.0
            while done < times:
                made.place(*made.layout.random_start(draw))
                started = time.process_time()
                done += made.advance(0.2, 0.3, 40)[0]
                spent += time.process_time() - started
            return done, spent
        return entry
    plane, bullet = simulator("planar"), simulator("pybullet")
    rays = simulator("pybullet", None, "simulator.camera=rays")
    fine = simulator("pybullet", None, "simulator.camera_columns=80", "simulator.camera_rows=60")
    whole = simulator("pybullet")
    mirrored: Any = whole
    mirrored._camera = type(mirrored._camera)(mirrored._p, mirrored._client, whole.camera, 15.0, False)
    return {"sonar planar": reading(plane, plane.sonar, 400), "sonar pybullet": reading(bullet, bullet.sonar, 100),
            "camera planar": reading(plane, plane.blobs, 400), "camera pybullet": reading(bullet, bullet.blobs, 60),
            "camera pybullet whole image": reading(whole, whole.blobs, 60),
            "camera pybullet 80x60": reading(fine, fine.blobs, 20),
            "camera pybullet rays": reading(rays, rays.blobs, 60),
            "motion planar": motion(plane, 4_000), "motion pybullet": motion(bullet, 1_000),
            "motion pybullet wheels": motion(simulator("pybullet", None, "simulator.drive=wheels"), 80)}
