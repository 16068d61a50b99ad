"""Runs done by others: what every engine gets is one idempotent command, ``python -m attnlab.work STUDY``.

Where and when is the engine's; which run, and that none is done twice, is the claims'. So an engine may retry, kill and
move its tasks as it likes. The study's folder must be on a file system that all its machines share.
"""

from __future__ import annotations

import subprocess
import sys
from abc import abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from attnlab.clusters.base import Cluster, Patience
from attnlab.launch.jobs import Job
from attnlab.launch.progress import Display
from attnlab.settings import setting
from attnlab.tables.files import read_json, write_json

LOOK_S = 1.0  # between two looks at tasks


@dataclass
class TaskParams(Patience):
    """Settings of every engine of tasks."""
    address: str | None = setting(None, "of a cluster that is there; one on this machine if left out")
    runs_per_job: int = setting(4, "runs that a task does, one after the other", unit="runs", low=1)


def work_on(study: str, runs: Sequence[str]) -> int:
    """What a task does, wherever it is: these runs, in a command of its own, so that no crash reaches the engine; its
    exit code."""
    command = [sys.executable, "-m", "attnlab.work", study, "--jobs", "1"]
    return subprocess.run([*command, *(f"--run={run}" for run in runs)], check=False, stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL).returncode


def reopen(jobs: Sequence[Job]) -> None:
    """Let a command see that these runs are asked for, though they have ended before."""
    for job in jobs:
        about = read_json(job.folder / "run.json")
        if about and about.get("status") in ("complete", "failed"):
            about.update(status="failed", interrupted=True, error="asked for again")
            write_json(job.folder / "run.json", about)


class Tasks(Cluster):
    """An engine that takes functions and gives back what they return."""

    @abstractmethod
    def tasks(self, study: Path, chunks: Sequence[Sequence[str]]) -> Iterator[list[int]]:
        """Begin a task for each chunk of runs; every second or so, which have ended. Closing the iterator ends all."""

    def run(self, jobs: Sequence[Job], display: Display) -> None:
        reopen(jobs)
        size = self.params.runs_per_job
        chunks = [list(jobs[i:i + size]) for i in range(0, len(jobs), size)]
        ended = self.tasks(jobs[0].folder.parent.resolve(), [[job.run for job in chunk] for chunk in chunks])
        try:
            for numbers in ended:
                for job in (job for number in numbers for job in chunks[number]):
                    about = read_json(job.folder / "run.json") or {}
                    display.advance(job.episodes, about.get("cycles") or 0)
                    display.run_done(job, about)
                display.tick()
                if display.hopeless:
                    break
        finally:
            ended.close()  # type: ignore[attr-defined]  # a generator
