"""One run after the other, in this process."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass

from attnlab.clusters.base import Cluster, Patience
from attnlab.launch.jobs import Job
from attnlab.launch.progress import Display
from attnlab.launch.shared import LOOK_S, Shared
from attnlab.registry import register
from attnlab.robot.folder import ClaimLostError, run_to_folder
from attnlab.tables.claim import beating
from attnlab.tables.files import read_json


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
            try:
                with beating(claim) as far:
                    def progress(episodes: int, cycles: int, far: list[int] = far) -> None:
                        display.advance(episodes - far[0], cycles - far[1])
                        far[:] = episodes, cycles
                        display.tick()
                    run_to_folder(dict(job.config), job.folder, job.info, progress, claim)
            except ClaimLostError:
                shared.elsewhere.append(job)
                continue
            except OSError as cause:  # no room for the run, nor for the reason
                display.run_done(job, {"status": "failed", "error": f"{cause.filename or job.run}: {cause.strerror}"})
                continue
            finally:
                claim.release()
            display.advance(job.episodes - far[0], 0)
            display.run_done(job, read_json(job.folder / "run.json") or {})
