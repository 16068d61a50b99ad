"""attnlab's own entries: the whole learning loop, the sensors alone, worlds of many boxes, memory, two processes."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from random import Random
from typing import Any

from attnlab.certify import compose
from attnlab.loading import load_all
from attnlab.robot.episodes import play_run
from attnlab.robot.plan import RunPlan
from attnlab.simulators.base import Simulator, SimulatorContext
from attnlab.worlds.base import Layout, outer_walls
from attnlab.worlds.geometry import Solid

Entry = Callable[[], tuple[int, float]]  # -> machine cycles, CPU seconds


def config(simulator: str, train: int, validation: int, **more: Any) -> dict:
    """The default run: AVOID, EAT, DRINK, Litman, Q-learning, softmax, in the paper's world."""
    return {**compose("paper", 0, simulator, train, []), "validation_episodes": validation, "record": "last", **more}


def learning_loop(simulator: str, train: int, validation: int, **settings: Any) -> Entry:
    """Whole runs, tables included, without starting the process."""
    plain = config(simulator, train, validation)
    plain["simulator"] = {**plain["simulator"], **settings}

    def entry() -> tuple[int, float]:
        experiment = RunPlan(plain)
        started = time.process_time()
        cycles = play_run(experiment)[1]
        return cycles, time.process_time() - started
    return entry


def reads_a_cycle(train: int = 20) -> dict[str, float]:
    """How often a learning robot reads its sonars and its camera and sets its speed, a machine cycle."""
    experiment, counts = RunPlan(config("planar", train, 5)), Counter()
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


def simulator(name: str, layout: Layout | None = None, cycles: int = 1150, **settings: Any) -> Simulator:
    """A simulator of the default run, in its world or another."""
    experiment = RunPlan(config(name, 1, 0))
    spec, params = experiment.simulator_spec
    for key, value in settings.items():
        setattr(params, key, value)
    return spec.cls(params, SimulatorContext(layout or experiment.layout, experiment.reading.dt_s, cycles))


def profile_by_part() -> dict[str, float]:
    """Share of a run's time spent in each module of attnlab itself (what it calls in Python and C counts with it);
    the profiler makes calls dearer than they are."""
    import cProfile
    import pstats
    experiment = RunPlan(config("planar", 60, 20))
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
    play_run(RunPlan(config("planar", episodes - 1, 1)), progress=progress)
    return {"episodes": episodes, "mb_after_a_fifth": marks[0], "mb_at_the_end": marks[1]}


def _work(seed: int) -> tuple[int, float]:
    started = time.process_time()
    cycles = play_run(RunPlan({**config("planar", 60, 20), "seed": seed}))[1]
    return cycles, time.process_time() - started


def parallel_efficiency(runs: int = 4) -> dict[str, float]:
    """Two processes against one, after imports and compiling: speed of wall time over twice that of one, and speed a
    CPU-second over that of one (which a machine that is busy with other work disturbs less)."""
    wall, cpu = {}, {}
    for processes in (1, 2):
        with ProcessPoolExecutor(processes, initializer=_warm) as pool:
            list(pool.map(_idle, range(processes)))
            started = time.perf_counter()
            done = list(pool.map(_work, range(runs)))
            cycles = sum(n for n, _ in done)
            wall[processes] = cycles / (time.perf_counter() - started)
            cpu[processes] = cycles / sum(seconds for _, seconds in done)
    return {"one": wall[1], "two": wall[2], "efficiency": wall[2] / wall[1] / 2, "efficiency_cpu": cpu[2] / cpu[1]}


def _warm() -> None:
    load_all()
    play_run(RunPlan(config("planar", 1, 0)))


def _idle(_: int) -> None:
    time.sleep(0.5)
