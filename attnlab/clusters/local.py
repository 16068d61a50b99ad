"""Runs side by side on this machine, one process each: a crash of one, even in C, loses that one only."""

from __future__ import annotations

import multiprocessing
import time
from collections.abc import Sequence
from dataclasses import dataclass
from multiprocessing.connection import wait
from typing import TYPE_CHECKING

from attnlab.clusters.base import Cluster, Patience
from attnlab.clusters.child import Child, context_for
from attnlab.console import undisturbed
from attnlab.launch.jobs import Job
from attnlab.launch.progress import Display
from attnlab.launch.shared import Shared
from attnlab.registry import register
from attnlab.settings import setting
from attnlab.tables.claim import Claim
from attnlab.tables.processes import cores

if TYPE_CHECKING:
    from attnlab.clusters.child import Context

TRIES = 3  # at a run whose fork server was killed
SPARE_S = 5.0  # to stop in before the time is up


@register("cluster", "local")
class Local(Cluster):
    """All cores of this machine, one process a run."""

    @dataclass
    class Params(Patience):
        jobs: int | None = setting(None, "runs side by side; all cores if left out", low=1, high=1024)
        minutes_a_run: float | None = setting(None, "a run that takes longer is stopped, and where it was is said; no "
                                              "limit if left out", unit="min", above=0)

    until: float | None = None  # on the monotonic clock (s): by then all is given back

    def at_once(self, jobs: Sequence[Job]) -> int:
        return min(self.params.jobs or cores(), len(jobs))

    def run(self, jobs: Sequence[Job], display: Display) -> None:
        """Ctrl-C stops the running ones, marks them failed (interrupted), and is raised again."""
        self._context: Context = context_for(jobs)
        shared = Shared(jobs, display, self.waits)
        running: list[Child] = []
        lost: dict[str, int] = {}
        at_once, longest = self.at_once(jobs), 0.0
        try:
            while shared or running:
                if self.until is not None and time.monotonic() + longest + SPARE_S > self.until:
                    shared.give_up()  # another run would not be done in time
                    if time.monotonic() + SPARE_S > self.until:
                        break
                while len(running) < at_once and (found := shared.next()):
                    running.append(self._child(*found))
                ready = wait([r.pipe for r in running] + [r.process.sentinel for r in running], timeout=0.5)
                for run in list(running):
                    if run.pipe in ready:
                        run.hear(display)
                    run.beat()
                    if self.params.minutes_a_run is not None:
                        run.check_time(self.params.minutes_a_run)
                    if not run.process.is_alive():
                        running.remove(run)
                        longest = max(longest, time.monotonic() - run.started)
                        lost[run.job.key] = lost.get(run.job.key, 0) + 1
                        shared.elsewhere += run.finish(display, again=lost[run.job.key] < TRIES)
                display.tick()
        finally:
            with undisturbed():
                for run in running:
                    run.kill()
                for run in running:
                    run.interrupt()

    def _child(self, job: Job, claim: Claim) -> Child:
        try:
            return Child(self._context, job, claim)
        except (EOFError, ConnectionError):  # no fork server can live here (too little memory, say)
            self._context = multiprocessing.get_context("spawn")
            return Child(self._context, job, claim)
