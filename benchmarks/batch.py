"""``python benchmarks/batch.py --publish``: studies of short compiled runs as processes and over threads.

CPU seconds of a whole command, its processes included, and wall seconds, which other work on the machine disturbs; the
share of a run that holds no lock; and what an environment's step costs when it is one of many. ``--publish`` stores
them, and writes the paragraphs of docs/engine.md and docs/gym.md.
"""

from __future__ import annotations

import argparse
import ctypes
import json
import os
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from attnlab.api import compose
from attnlab.robot.episodes import play_run
from attnlab.robot.plan import RunPlan

ROOT = Path(__file__).resolve().parents[1]
RESULT = ROOT / "benchmarks" / "results" / "batch" / "batch.json"
RUNS = 20
EPISODES = (24, 120, 600)  # of a run
CLUSTERS = ("local", "threads")
ROBOTS = 64
SUBREAPER = 36  # Linux: processes of a command whose parent is gone become ours


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--publish", action="store_true", help=f"store them in {RESULT.relative_to(ROOT)}")
    given = parser.parse_args()
    found: dict[str, Any] = {"runs": RUNS, "cores": len(os.sched_getaffinity(0)), "load_before": os.getloadavg()[0]}
    found["studies"] = {str(episodes): {cluster: study(cluster, episodes) for cluster in CLUSTERS}
                        for episodes in EPISODES}
    found["without_lock"] = {str(episodes): without_lock(episodes) for episodes in EPISODES}
    found["steps"] = steps()
    print(json.dumps(found, indent=1))
    if given.publish:
        RESULT.parent.mkdir(parents=True, exist_ok=True)
        RESULT.write_text(json.dumps(found, indent=1) + "\n")
        for page in (ROOT / "docs" / "engine.md", ROOT / "docs" / "gym.md"):
            page.write_text(said(page.read_text(), found))
    return 0


def study(cluster: str, episodes: int) -> dict[str, float]:
    """Seconds of a study; what one of a single run costs is taken off, for both start alike."""
    whole, start = (command(cluster, episodes, runs) for runs in (RUNS, 1))
    return {name: (whole[name] - start[name]) / (RUNS - 1) for name in whole}


def command(cluster: str, episodes: int, runs: int) -> dict[str, float]:
    """Wall and CPU seconds of a study. Raises RuntimeError if it fails."""
    return of_command(["-m", "simulator=planar", "engine=compiled", f"seed=0-{runs - 1}",
                       f"train_episodes={episodes * 5 // 6}", f"validation_episodes={episodes // 6}", "picture=false",
                       "report=false", f"cluster={cluster}"])


def of_command(typed: Sequence[str]) -> dict[str, float]:
    """Wall and CPU seconds of ``python -m attnlab`` in an empty folder, and of all its processes. Raises RuntimeError
    if it fails."""
    ctypes.CDLL(None).prctl(SUBREAPER, 1, 0, 0, 0)
    with tempfile.TemporaryDirectory() as home:
        begin, cpu, status = time.perf_counter(), 0.0, 1
        process = subprocess.Popen([sys.executable, "-m", "attnlab", *typed], cwd=home, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL, env={**os.environ, "PYTHONPATH": str(ROOT)})
        while True:
            try:
                pid, code, used = os.wait3(0)
            except ChildProcessError:
                break
            cpu += used.ru_utime + used.ru_stime
            status = code if pid == process.pid else status
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            raise RuntimeError(f"failed: {' '.join(typed)}")
    return {"wall_s": time.perf_counter() - begin, "cpu_s": cpu}


def without_lock(episodes: int) -> float:
    """Share of a run's CPU time that compiled code takes, during which other threads go on."""
    from attnlab.compiled import engine, summary
    spent, originals = [0.0], (engine.entries, summary.summary)

    def clocked(function: Any) -> Any:
        def timed(*given: Any) -> Any:
            begin = time.thread_time()
            found = function(*given)
            spent[0] += time.thread_time() - begin
            return found
        return timed
    plan = RunPlan(compose("simulator=planar", f"train_episodes={episodes * 5 // 6}",
                           f"validation_episodes={episodes // 6}"))
    play_run(plan, engine="compiled")
    engine.entries = lambda *given: tuple(map(clocked, originals[0](*given)))
    summary.summary = clocked(originals[1])
    begin = time.thread_time()
    play_run(plan, engine="compiled")
    share = spent[0] / (time.thread_time() - begin)
    engine.entries, summary.summary = originals
    return share


def steps(times: int = 300) -> dict[str, float]:
    """CPU microseconds of one robot's step, of ``ROBOTS`` in a vector."""
    import gymnasium
    import numpy as np

    import attnlab.gym  # noqa: F401  registers
    found: dict[str, float] = {"robots": ROBOTS}
    for mode in ("vector_entry_point", "sync"):
        env = gymnasium.make_vec("attnlab/Attention-v0", num_envs=ROBOTS, vectorization_mode=mode,
                                 overrides=["simulator=planar", "engine=auto"])
        env.reset(seed=0)
        draw = np.random.default_rng(0)
        begin = time.process_time()
        for _ in range(times):
            env.step(draw.integers(0, 4, ROBOTS))
        found[mode] = (time.process_time() - begin) / times / ROBOTS * 1e6
        env.close()
    return found


def said(text: str, found: dict[str, Any]) -> str:
    """A page with its paragraph."""
    for name, of in (("batch", batch), ("steps", vector)):
        text = re.sub(rf"(<!-- {name}: .*? -->\n).*?(<!-- end -->)", lambda m, of=of: m[1] + of(found) + m[2], text,
                      flags=re.S)
    return text


def batch(found: dict[str, Any]) -> str:
    rows = ""
    for episodes, row in found["studies"].items():
        share = found["without_lock"][episodes]
        rows += (f"| {episodes} | {row['local']['cpu_s']:.2f} | {row['threads']['cpu_s']:.2f} | {100 * share:.0f} % | "
                 f"{1 / (1 - share):.1f} |\n")
    return (f"Does it pay? CPU seconds of a compiled run, one of {found['runs']} of a study, all its processes "
            "counted:\n\n| episodes a run | a process each (`local`) | `threads` | of this in compiled code, without "
            "the lock | so at most this many threads are busy |\n|---|---|---|---|---|\n" + rows +
            "\nA process of its own costs a run the difference. Threads save it, but the rest of a run (tables, files) "
            "takes turns:\nmore cores than the last column bring nothing. So `local` stays one process a run, "
            "which a crash cannot take others along with;\n`cluster=threads` is for many short runs on few cores.\n")


def vector(found: dict[str, Any]) -> str:
    of = found["steps"]
    return (f"A step of one of {of['robots']} robots takes {of['vector_entry_point']:.0f} us of CPU time compiled, and "
            f"{of['sync']:.0f} us as Python.\n")


if __name__ == "__main__":
    sys.exit(main())
