"""One run after the other, in this process."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from attnlab.clusters.base import Cluster, Patience
from attnlab.launch.jobs import Job
from attnlab.launch.progress import Display
from attnlab.launch.shared import LOOK_S, Shared
from attnlab.registry import register
from attnlab.robot.episodes import Progress
from attnlab.robot.folder import ClaimLostError, run_to_folder
from attnlab.tables.claim import Claim, beating
from attnlab.tables.files import read_json


def do(job: Job, claim: Claim, progress: Progress) -> dict[str, Any] | None:
    """Do a run in this process and give its claim back: what its run.json says, None if the claim was lost."""
    try:
        with beating(claim) as far:
            def told(episodes: int, cycles: int) -> None:
                far[:] = episodes, cycles
                progress(episodes, cycles)
            run_to_folder(dict(job.config), job.folder, job.info, told, claim)
        return read_json(job.folder / "run.json") or {}
    except ClaimLostError:
        return None
    except OSError as cause:  # no room for the run, nor for the reason
        return {"status": "failed", "error": f"{cause.filename or job.run}: {cause.strerror}"}
    finally:
        claim.release()


@register("cluster", "serial")
class Serial(Cluster):
    """One run after the other, in this process: for debuggers, profilers, and machines that allow no processes. A run
    that crashes in C takes the rest with it; the same command goes on."""

    @dataclass
    class Params(Patience):
        pass

    def run(self, jobs: Sequence[Job], display: Display) -> None:
        shared = Shared(jobs, display, self.waits)
        while shared:
            found = shared.next()
            if found is None:
                time.sleep(LOOK_S)
                continue
            job, claim = found
            done = [0, 0]

            def progress(episodes: int, cycles: int, done: list[int] = done) -> None:
                display.advance(episodes - done[0], cycles - done[1])
                done[:] = episodes, cycles
                display.tick()
            about = do(job, claim, progress)
            if about is None:
                shared.elsewhere.append(job)
                continue
            display.advance(job.episodes - done[0], 0)
            display.run_done(job, about)
