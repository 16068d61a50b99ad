"""What a user waits for: help, a smoke run, the full study, each as a command in an empty folder."""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def timed(*arguments: str) -> dict[str, float | str]:
    """Wall and CPU seconds of ``python -m attnlab ...``, children included."""
    with tempfile.TemporaryDirectory() as folder:
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        started = time.perf_counter()
        done = subprocess.run([sys.executable, "-m", "attnlab", *arguments], cwd=folder, capture_output=True, text=True,
                              env={**os.environ, "PYTHONPATH": str(ROOT)})
        wall = time.perf_counter() - started
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        raise RuntimeError(f"{' '.join(arguments)} exited with {done.returncode}: {done.stderr.strip()[-300:]}")
    return {"command": " ".join(["python -m attnlab", *arguments]), "wall_s": wall,
            "cpu_s": after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime}


COMMANDS = {"help": ("--help",), "smoke": ("+experiment=smoke",)}
STUDY = ("+experiment=cr_vs_ncr", "-m", "seed=0-19", "simulator=planar", "report=false")
