"""``python benchmarks/run.py``: measure all of it side by side, and add the result to benchmarks/results/.

    python benchmarks/run.py --peers /tmp/peers/bin/python    about seven minutes on a quiet machine
    python benchmarks/run.py --rounds 1 --quick               does it work? a minute or two, figures mean nothing
    python benchmarks/run.py --long                           the study on pybullet too, five minutes more
    python benchmarks/run.py --page                           write docs/benchmarks.md and its picture from the results

Entries take turns in every round, so that a busy machine is busy for all of them; figures are medians over rounds, and
what is compared over commits are ratios within one result. Peers (benchmarks/requirements.txt, Debian's libenki-dev)
run in a Python of their own; what is missing is named in the result.
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

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))
RESULTS = ROOT / "benchmarks" / "results"
LIMIT = "fused kernel"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=5, help="turns of every entry (5)")
    parser.add_argument("--quick", action="store_true", help="leave out the studies, and make turns a tenth as long")
    parser.add_argument("--long", action="store_true", help="time the study on pybullet as well")
    parser.add_argument("--peers", default=sys.executable, help="a Python that has the peers' packages (this one)")
    parser.add_argument("--out", type=Path, default=RESULTS, help="folder of results")
    parser.add_argument("--page", action="store_true", help="write the page of what is stored, measure nothing")
    arguments = parser.parse_args()
    if arguments.page:
        from benchmarks.page import publish
        publish()
        return 0
    if arguments.rounds < 1:
        parser.error("--rounds must be at least 1")
    found = measure(arguments.rounds, arguments.peers, arguments.quick, arguments.long)
    arguments.out.mkdir(parents=True, exist_ok=True)
    path = arguments.out / f"{found['date'].replace(' ', '-').replace(':', '')}.json"
    path.write_text(json.dumps(found, indent=1) + "\n")
    show(found)
    print(f"stored in {path}")
    return 0


def measure(rounds: int, python: str, quick: bool, long: bool) -> dict[str, Any]:
    """Everything, as it is stored."""
    from attnlab.loading import load_all
    from attnlab.tables.code import code, versions
    from benchmarks import costs, loops, peers
    began = time.monotonic()
    found: dict[str, Any] = {"date": time.strftime("%Y-%m-%d %H:%M:%S", time.gmtime()), "code": code(),
                             "machine": machine(), "versions": {**versions(), **peers.versions(python)},
                             "rounds": rounds}
    few = 1 if quick else 3
    say("commands")
    found["starts"] = costs.starts(few)  # commands first: no process of ours waits beside them
    if not quick:
        say("studies of many runs, of one and more cores")
        found["runs"], found["cores"] = costs.of_runs(), costs.of_cores()
        say("the full study")
        found["study"] = {"planar": costs.study("simulator=planar")}
    if long:
        say("the full study on pybullet")
        found.setdefault("study", {})["pybullet"] = costs.study()
    load_all()
    found["reads_a_cycle"] = reads = loops.reads_a_cycle()
    say("compiling what is not yet")
    behaviours = take_turns(costs.of_behaviours(), min(rounds, few), "behaviours")
    entries, found["missing"] = contest(reads, python, 0.1 if quick else 1.0)
    found["contest"] = take_turns(entries, rounds, "contest")
    found["behaviours"] = behaviours
    found["boxes"] = take_turns(costs.of_boxes(reads), min(rounds, few), "boxes")
    found["calls"] = take_turns(loops.calls(), min(rounds, few), "calls")
    found["profile"] = loops.profile_by_part()
    found["memory"] = loops.memory_over_episodes(100 if quick else 1000)
    found["machine"]["load_after"] = os.getloadavg()[0]
    found["minutes"] = (time.monotonic() - began) / 60
    return found


def contest(reads: dict[str, float], python: str, scale: float) -> tuple[dict[str, Callable], dict[str, str]]:
    """Entries by name, and the peers that cannot run with the reason; ``scale``: of the length of a turn."""
    from benchmarks import fused, loops, peers
    plane, bullet = loops.simulator("planar"), loops.simulator("pybullet")
    plane.place(2.0, 2.0, 0.3)

    def limit() -> tuple[int, float]:
        started = time.process_time()
        return fused.limit(plane, reads, int(800_000 * scale)), time.process_time() - started

    def whole(engine: str, train: int, validation: int, *settings: str) -> Callable:
        return loops.whole(engine, max(1, int(train * scale)), max(1, int(validation * scale)), *settings)
    planar, pybullet = "simulator=planar", "simulator=pybullet"
    entries = {
        LIMIT: limit,
        "compiled, loop alone": loops.alone("compiled", int(300 * scale)),
        "compiled, whole run": whole("compiled", 200, 50, planar),
        "python, loop alone": loops.alone("python", int(60 * scale)),
        "python, whole run": whole("python", 60, 20, planar),
        "pybullet, whole run": whole("python", 15, 5, pybullet),
        "pybullet camera=rays, whole run": whole("python", 15, 5, pybullet, "simulator.camera=rays"),
        "pybullet 80x60, whole run": whole("python", 9, 3, pybullet, "simulator.camera_columns=80",
                                           "simulator.camera_rows=60"),
        "pybullet drive=wheels, whole run": whole("python", 1, 1, pybullet, "simulator.drive=wheels"),
        "planar, sensors and motion only": loops.sensors_only(plane, reads, int(60_000 * scale)),
        "pybullet, sensors and motion only": loops.sensors_only(bullet, reads, int(10_000 * scale))}
    missing = {}
    for name in peers.PEERS:
        try:
            entries[name] = peers.entry(name, python, scale)
        except peers.Missing as why:
            missing[name] = str(why)
            say(f"{name} is left out: {why}")
    return entries, missing


def take_turns(entries: dict[str, Callable], rounds: int, title: str) -> dict[str, dict[str, Any]]:
    """Cycles a CPU-second of every entry: median, least, most, all rounds."""
    speeds: dict[str, list[float]] = {name: [] for name in entries}
    for entry in entries.values():  # one turn that does not count: compiling, caches, first allocations
        entry()
    for number in range(rounds):
        say(f"{title}: round {number + 1} of {rounds}")
        for name, entry in entries.items():
            cycles, seconds = entry()
            speeds[name].append(cycles / seconds)
    return {name: {"median": statistics.median(all_), "least": min(all_), "most": max(all_), "rounds": all_}
            for name, all_ in speeds.items()}


def machine() -> dict[str, Any]:
    """What the figures were measured on."""
    model = platform.processor() or platform.machine()
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.exists():
        names = [line.split(":", 1)[1].strip() for line in cpuinfo.read_text().splitlines()
                 if line.startswith("model name")]
        model = names[0] if names else model
    return {"cpu": model, "cores": os.cpu_count(), "system": platform.system(), "load": os.getloadavg()[0]}


def show(found: dict[str, Any]) -> None:
    """The contest as a table, with ratios to the limit."""
    limit = found["contest"][LIMIT]["median"]
    print(f"{'machine cycles a CPU-second':40s} {'median':>11s} {'least':>11s} {'most':>11s} {'of the limit':>12s}")
    for name, speed in found["contest"].items():
        print(f"{name:40s} {speed['median']:11,.0f} {speed['least']:11,.0f} {speed['most']:11,.0f} "
              f"{speed['median'] / limit:12.4f}")
    for name, why in found["missing"].items():
        print(f"{name:40s} {why}")


def say(text: str) -> None:
    print(f"benchmarks: {text}", file=sys.stderr, flush=True)


if __name__ == "__main__":
    sys.exit(main())
