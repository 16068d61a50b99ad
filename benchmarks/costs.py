"""What it costs: more behaviours, boxes, runs and cores; to start, to compile; each as a user would notice."""

from __future__ import annotations

import ctypes
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from benchmarks.loops import Entry, crowd, sensors_only, simulator, whole

ROOT = Path(__file__).resolve().parents[1]
BEHAVIOURS = (("avoid",), ("avoid", "eat"), ("avoid", "eat", "drink"), ("avoid", "eat", "drink", "rest"))
BOXES = (2, 4, 8, 16, 32, 64)
RUNS = (1, 8, 64)
RUNS_OF_CORES = 12
CLUSTERS = ("local", "threads")
SHORT = ("simulator=planar", "train_episodes=20", "validation_episodes=10", "report=false", "picture=false")
STUDY = ("+experiment=cr_vs_ncr", "-m", "seed=0-19", "report=true")
_SUBREAPER = 36  # prctl(2): orphans become our children, whose CPU seconds the system adds up when they are waited for


def of_behaviours() -> dict[str, Entry]:
    """Whole runs on planar by number of behaviours and engine."""
    return {f"{engine} {len(names)}": whole(engine, *((100, 20) if engine == "compiled" else (20, 5)),
                                            "simulator=planar", f"behaviours=[{','.join(names)}]")
            for names in BEHAVIOURS for engine in ("python", "compiled")}


def of_boxes(reads: dict[str, float]) -> dict[str, Entry]:
    """Against the number of boxes in a floor of 3 m2 a cube: sensors and motion by both simulators, compiled runs."""
    entries: dict[str, Entry] = {}
    for count in BOXES:
        side = max(4.0, (3.0 * count) ** 0.5)
        entries |= {f"planar {count}": sensors_only(simulator("planar", crowd(count)), reads, 20_000),
                    f"pybullet {count}": sensors_only(simulator("pybullet", crowd(count)), reads, 4_000),
                    f"compiled {count}": whole("compiled", 60, 20, "simulator=planar", "world=random",
                                               f"world.width_m={side:.3f}", f"world.depth_m={side:.3f}",
                                               f"world.obstacles={count - 2}")}
    return entries


def of_runs() -> dict[str, dict[str, dict[str, Any]]]:
    """Studies of 1 to many short compiled runs by cluster, without a report, all cores."""
    return {cluster: {str(n): timed("-m", f"seed={seeds(n)}", "engine=compiled", f"cluster={cluster}", *SHORT)
                      for n in RUNS} for cluster in CLUSTERS}


def of_cores() -> dict[str, dict[str, dict[str, Any]]]:
    """The same runs by 1, 2, 4, ... processes or threads, up to the cores there are."""
    jobs = [1]
    while 2 * jobs[-1] <= (os.cpu_count() or 1):
        jobs.append(2 * jobs[-1])
    return {cluster: {str(n): timed("-m", f"seed={seeds(RUNS_OF_CORES)}", "simulator=planar", "engine=compiled",
                                    "report=false", "picture=false", f"cluster={cluster}", f"cluster.jobs={n}")
                      for n in jobs} for cluster in CLUSTERS}


def seeds(n: int) -> str:
    return f"0-{n - 1}" if n > 1 else "0"


def starts(rounds: int) -> dict[str, dict[str, Any]]:
    """Commands that a user waits for; of several tries, after one that fills the cache, the quickest. ``first compile``
    has an empty cache, ``cold start`` too and compiles the simulator alone."""
    def best(*arguments: str) -> dict[str, Any]:
        timed(*arguments)
        return min((timed(*arguments) for _ in range(rounds)), key=lambda t: t["wall_s"])
    found = {"help": best("--help"), "smoke": best("+experiment=smoke")}
    with tempfile.TemporaryDirectory() as cache:
        found["cold start"] = timed("engine=python", *SHORT, cache=cache)
    with tempfile.TemporaryDirectory() as cache:
        found["first compile"] = timed("engine=compiled", *SHORT, cache=cache)
    found |= {engine: best(f"engine={engine}", "seed=1", "simulator=planar", "train_episodes=1",
                           "validation_episodes=1", "report=false", "picture=false")
              for engine in ("python", "compiled")}
    return found


def study(*settings: str) -> dict[str, Any]:
    """The full study of 40 runs, from start to page."""
    return timed(*STUDY, *settings)


def timed(*arguments: str, cache: str | None = None) -> dict[str, Any]:
    """Wall and CPU seconds of ``python -m attnlab ...`` in an empty folder, runs' processes and the server they are
    forked from included (on Linux; elsewhere the command's own), and the machine's load before. Raises RuntimeError if
    it fails."""
    load, linux = os.getloadavg()[0], sys.platform == "linux"
    if linux:
        ctypes.CDLL(None).prctl(_SUBREAPER, 1, 0, 0, 0)
    more = {"NUMBA_CACHE_DIR": cache} if cache else {}
    with tempfile.TemporaryDirectory() as folder:
        before, started = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
        done = subprocess.run([sys.executable, "-m", "attnlab", *arguments], cwd=folder, capture_output=True, text=True,
                              env={**os.environ, **more, "PYTHONPATH": str(ROOT)})
        wall = time.perf_counter() - started
        if linux:
            _wait_for_orphans()
            ctypes.CDLL(None).prctl(_SUBREAPER, 0, 0, 0, 0)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        made = [json.loads(path.read_text()) for path in Path(folder).glob("outputs/*/*/run.json")]
    if done.returncode:
        raise RuntimeError(f"{' '.join(arguments)} exited with {done.returncode}: {done.stderr.strip()[-300:]}")
    return {"command": " ".join(["python -m attnlab", *arguments]), "wall_s": wall, "runs": len(made),
            "cpu_s": after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime,
            "cycles": sum(run["cycles"] for run in made), "engines": sorted({run["engine"] for run in made}),
            "load_before": load}


def _wait_for_orphans() -> None:
    """Servers outlive their command by a moment; nobody waits for a child of ours that stays for longer."""
    until = time.monotonic() + 3.0
    while time.monotonic() < until:
        try:
            pid, _ = os.waitpid(-1, os.WNOHANG)
        except ChildProcessError:
            return
        if not pid:
            time.sleep(0.02)
