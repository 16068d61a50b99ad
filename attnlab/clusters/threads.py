"""Runs side by side on threads of this process: compiled episodes wait for nobody, all else of a run takes turns."""

from __future__ import annotations

import threading
import time
from collections.abc import Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass
from typing import Any

from attnlab.clusters.base import Cluster, Patience
from attnlab.clusters.serial import do
from attnlab.console import undisturbed
from attnlab.launch.jobs import Job
from attnlab.launch.progress import Display
from attnlab.launch.shared import LOOK_S, Shared
from attnlab.registry import register
from attnlab.settings import setting
from attnlab.tables.claim import Claim
from attnlab.tables.processes import cores


@register("cluster", "threads")
class Threads(Cluster):
    """Threads of this process: for many short runs that compile, which are over sooner than a process of their own has
    begun. What runs as Python takes turns. A run that crashes in C takes the rest with it; the same command goes on."""

    @dataclass
    class Params(Patience):
        jobs: int | None = setting(None, "runs side by side; all cores if left out", low=1, high=1024)

    def at_once(self, jobs: Sequence[Job]) -> int:
        return min(self.params.jobs or cores(), len(jobs))

    def run(self, jobs: Sequence[Job], display: Display) -> None:
        """Ctrl-C stops the running ones after their episode, marks them failed (interrupted), and is raised again."""
        shared, stop, at_once = Shared(jobs, display, self.waits), threading.Event(), self.at_once(jobs)
        running: dict[Future[dict[str, Any] | None], _Run] = {}
        pool = ThreadPoolExecutor(at_once)
        try:
            while shared or running:
                while len(running) < at_once and (found := shared.next()):
                    run = _Run(*found, stop)
                    running[pool.submit(run)] = run
                if not running:
                    time.sleep(LOOK_S)
                    continue
                ended, _ = wait(running, timeout=0.5, return_when=FIRST_COMPLETED)
                for run in running.values():
                    run.tell(display)
                for future in ended:
                    run, about = running.pop(future), future.result()
                    if about is None:
                        shared.elsewhere.append(run.job)
                    else:
                        run.far = [run.job.episodes, run.far[1]]
                        run.tell(display)
                        display.run_done(run.job, about)
                display.tick()
        finally:
            with undisturbed():
                stop.set()
                pool.shutdown()


class _Run:
    """A run on a thread. ``far``: episodes and cycles done."""

    def __init__(self, job: Job, claim: Claim, stop: threading.Event):
        self.job, self.claim, self.stop = job, claim, stop
        self.far, self._told = [0, 0], [0, 0]

    def __call__(self) -> dict[str, Any] | None:
        return do(self.job, self.claim, self._progress)

    def _progress(self, episodes: int, cycles: int) -> None:
        if self.stop.is_set():
            raise KeyboardInterrupt  # as it comes to the run of a process of its own
        self.far = [episodes, cycles]

    def tell(self, display: Display) -> None:
        """How far it is, since this was last asked."""
        far = self.far
        display.advance(far[0] - self._told[0], far[1] - self._told[1])
        self._told = far
