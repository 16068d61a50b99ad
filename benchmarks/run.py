"""``python benchmarks/run.py``: all of it side by side, in machine cycles a CPU-second; stored in benchmarks/results/.

    python benchmarks/run.py                 the contest, boxes, memory, two processes, start-up (some minutes)
    python benchmarks/run.py --study         the full study of 40 runs too
    python benchmarks/run.py --publish       write docs/benchmarks.md and its figure from the newest result

Entries take turns in every round, so that a busy machine is busy for all of them; figures are medians over rounds.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import statistics
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from attnlab.loading import load_all

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))
RESULTS = ROOT / "benchmarks" / "results"
LOOP, LIMIT = "attnlab planar, whole loop", "fused kernel, same sensing"
BOXES = (2, 4, 8, 16, 32, 64)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=7, help="turns of every entry (7)")
    parser.add_argument("--study", action="store_true", help="time the full study as well")
    parser.add_argument("--publish", action="store_true", help="write the page of the newest result, measure nothing")
    parser.add_argument("--out", type=Path, default=RESULTS, help="folder of results")
    arguments = parser.parse_args()
    if arguments.rounds < 1:
        parser.error("--rounds must be at least 1")
    if arguments.publish:
        from benchmarks.page import publish
        publish(arguments.out)
        return 0
    found = measure(arguments.rounds, arguments.study)
    arguments.out.mkdir(parents=True, exist_ok=True)
    path = arguments.out / f"{time.strftime('%Y-%m-%d-%H%M%S', time.gmtime())}.json"
    path.write_text(json.dumps(found, indent=1) + "\n")
    show(found)
    print(f"stored in {path}")
    return 0


def measure(rounds: int, study: bool) -> dict[str, Any]:
    """Everything, as it is stored."""
    from attnlab.tables.code import versions
    from benchmarks import commands, loops
    load_all()
    reads = loops.reads_a_cycle()
    entries, missing = contest(reads)
    found = {"machine": machine(), "versions": {**versions(), **peer_versions()}, "rounds": rounds,
             "reads_a_cycle": reads, "missing": missing, "contest": take_turns(entries, rounds, "contest")}
    found["boxes"] = boxes(reads, max(2, rounds // 2))
    found["profile"] = loops.profile_by_part()
    say("memory over episodes")
    found["memory"] = loops.memory_over_episodes(1000)
    say("two processes")
    load = os.getloadavg()[0]
    tries = [loops.parallel_efficiency() for _ in range(3)]
    tries.sort(key=lambda t: t["efficiency"])
    found["parallel"] = tries[len(tries) // 2] | {"tries": [t["efficiency"] for t in tries], "load_before": load}
    found["commands"] = {}
    for name, command in commands.COMMANDS.items():
        say(f"command: {name}")
        found["commands"][name] = min((commands.timed(*command) for _ in range(3)), key=lambda t: t["wall_s"])
    if study:
        say("command: the full study")
        found["commands"]["study"] = commands.timed(*commands.STUDY)
    return found


def contest(reads: dict[str, float]) -> tuple[dict[str, Callable], dict[str, str]]:
    """Entries by name, and the peers that cannot run with the reason."""
    from benchmarks import fused, loops, peers
    plane, bullet = loops.simulator("planar"), loops.simulator("pybullet")
    rays = loops.simulator("pybullet", camera="rays")
    plane.place(2.0, 2.0, 0.3)

    def limit() -> tuple[int, float]:
        started = time.process_time()
        return fused.limit(plane, reads, 400_000), time.process_time() - started

    limit()  # compile
    entries = {
        LOOP: loops.learning_loop("planar", 60, 20),
        "attnlab pybullet, whole loop": loops.learning_loop("pybullet", 15, 5),
        "attnlab pybullet camera=rays, whole loop": loops.learning_loop("pybullet", 15, 5, camera="rays"),
        "attnlab pybullet 80x60, whole loop": loops.learning_loop("pybullet", 9, 3, camera_columns=80, camera_rows=60),
        "attnlab pybullet drive=wheels, whole loop": loops.learning_loop("pybullet", 2, 1, drive="wheels"),
        "attnlab planar, sensors and motion only": loops.sensors_only(plane, reads, 60_000),
        "attnlab pybullet, sensors and motion only": loops.sensors_only(bullet, reads, 10_000),
        "attnlab pybullet camera=rays, sensors and motion only": loops.sensors_only(rays, reads, 10_000),
        LIMIT: limit,
    }
    missing = {}
    for name, (make, steps) in peers.PEERS.items():
        try:
            entries[name] = make(steps)
        except peers.Missing as why:
            missing[name] = str(why)
            say(f"{name} is left out: {why}")
    return entries, missing


def take_turns(entries: dict[str, Callable], rounds: int, title: str) -> dict[str, dict[str, Any]]:
    """Cycles a CPU-second of every entry: median, least, most, all rounds."""
    speeds: dict[str, list[float]] = {name: [] for name in entries}
    for entry in entries.values():  # one turn that does not count: caches, first allocations
        entry()
    for number in range(rounds):
        say(f"{title}: round {number + 1} of {rounds}")
        for name, entry in entries.items():
            cycles, seconds = entry()
            speeds[name].append(cycles / seconds)
    return {name: {"median": statistics.median(all_), "least": min(all_), "most": max(all_), "rounds": all_}
            for name, all_ in speeds.items()}


def boxes(reads: dict[str, float], rounds: int) -> dict[str, dict[str, Any]]:
    """Sensors and motion against the number of boxes, for both simulators."""
    from benchmarks import loops
    entries = {f"{name} {count}": loops.sensors_only(loops.simulator(name, loops.crowd(count)), reads, cycles)
               for count in BOXES for name, cycles in (("planar", 20_000), ("pybullet", 4_000))}
    return take_turns(entries, rounds, "boxes")


def machine() -> dict[str, Any]:
    """What the figures were measured on."""
    model = platform.processor() or platform.machine()
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.exists():
        lines = cpuinfo.read_text().splitlines()
        names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
        model = names[0] if names else model
    return {"cpu": model, "cores": os.cpu_count(), "system": platform.system(), "load": os.getloadavg()[0]}


def peer_versions() -> dict[str, str]:
    from importlib.metadata import PackageNotFoundError, version
    found = {}
    for package in ("ir-sim", "minigrid"):
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            continue
    return found


def show(found: dict[str, Any]) -> None:
    """The contest as a table, with ratios to attnlab's whole loop on planar."""
    whole = found["contest"][LOOP]["median"]
    print(f"{'machine cycles a CPU-second':54s} {'median':>11s} {'least':>11s} {'most':>11s} {'ratio':>8s}")
    for name, speed in found["contest"].items():
        print(f"{name:54s} {speed['median']:11,.0f} {speed['least']:11,.0f} {speed['most']:11,.0f} "
              f"{speed['median'] / whole:8.3f}")
    for name, why in found["missing"].items():
        print(f"{name:54s} {why}")


def say(text: str) -> None:
    print(f"benchmarks: {text}", file=sys.stderr, flush=True)


if __name__ == "__main__":
    sys.exit(main())
