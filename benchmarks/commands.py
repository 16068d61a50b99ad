"""What a user waits for: help, a smoke run, the full study, each as a command in an empty folder."""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def timed(*arguments: str) -> dict[str, float | str]:
    """Wall and CPU seconds of ``python -m attnlab ...``, and the load of the machine before and after.

    Runs are forked from a server, not from the command, so the system does not count them as its children: the CPU
    seconds of each come from its run.json. What a run's process does before and after those is left out.
    """
    load = os.getloadavg()[0]
    with tempfile.TemporaryDirectory() as folder:
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        started = time.perf_counter()
        done = subprocess.run([sys.executable, "-m", "attnlab", *arguments], cwd=folder, capture_output=True, text=True,
                              env={**os.environ, "PYTHONPATH": str(ROOT)})
        wall = time.perf_counter() - started
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        runs = [json.loads(path.read_text())["cpu_s"] for path in Path(folder).glob("outputs/*/*/run.json")]
    if done.returncode:
        raise RuntimeError(f"{' '.join(arguments)} exited with {done.returncode}: {done.stderr.strip()[-300:]}")
    return {"command": " ".join(["python -m attnlab", *arguments]), "wall_s": wall,
            "cpu_s": after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime + sum(runs), "runs": len(runs),
            "load_before": load, "load_after": os.getloadavg()[0]}


COMMANDS = {"help": ("--help",), "smoke": ("+experiment=smoke",)}
STUDY = ("+experiment=cr_vs_ncr", "-m", "seed=0-19", "simulator=planar", "report=true")
