"""The runs that a command has to do, of which others may do some at the same time."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Sequence
from typing import Any

from attnlab.launch.jobs import Job
from attnlab.launch.progress import Display
from attnlab.tables.claim import Claim, standings, sweep, take
from attnlab.tables.files import read_json

LOOK_S = 1.0  # between two looks at what others do


class Shared:
    """Hands out jobs, each with a claim that nobody else has. What others did meanwhile counts as done.

    ``waits``: for what others are at, until it is done too. After too many runs that failed alike nothing more is
    handed out."""

    def __init__(self, jobs: Sequence[Job], display: Display, waits: bool = True):
        self.waiting, self.elsewhere = deque(jobs), list[Job]()
        self.display, self.waits = display, waits
        self._looked = time.monotonic()
        for study in {job.folder.parent for job in jobs}:
            sweep(study)

    def __bool__(self) -> bool:
        """Is anything left to do, or to wait for?"""
        return bool(self.waiting or self.elsewhere)

    def next(self) -> tuple[Job, Claim] | None:
        """A job to do now, None if there is none at this moment."""
        if self.display.hopeless:
            self.give_up()
        if not self.waiting and self.elsewhere:
            self._look()
        while self.waiting:
            job = self.waiting.popleft()
            claim = take(job.folder.parent, job.key)
            if claim is None:
                if self.waits:
                    self.elsewhere.append(job)
                continue
            about = done_by_others(job)
            if about is None:
                return job, claim
            claim.release()
            self.settle(job, about)
        return None

    def settle(self, job: Job, about: dict[str, Any]) -> None:
        """What became of a job that others did."""
        self.display.advance(job.episodes, about.get("cycles") or 0)
        self.display.run_done(job, about)

    def give_up(self) -> None:
        """Start nothing more."""
        self.waiting.clear()
        self.elsewhere.clear()

    def _look(self) -> None:
        """Runs of others that are free by now come back to the waiting ones."""
        if time.monotonic() - self._looked < LOOK_S:
            return
        busy = {key for study in {job.folder.parent for job in self.elsewhere}
                for key, standing in standings(study).items() if not standing.dead}
        self.waiting += [job for job in self.elsewhere if job.key not in busy]
        self.elsewhere = [job for job in self.elsewhere if job.key in busy]
        self._looked = time.monotonic()


def done_by_others(job: Job) -> dict[str, Any] | None:
    """run.json of a job that somebody finished since this command looked, well or not; None if it is to be done."""
    about = read_json(job.folder / "run.json") or {}
    over = about.get("status") == "complete" or (about.get("status") == "failed" and not about.get("interrupted"))
    return about if over and about.get("key") == job.key and about.get("claim") != job.seen else None


