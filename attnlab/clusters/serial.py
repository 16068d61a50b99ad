"""One run after the other, in this process."""

from __future__ import annotations

from collections.abc import Sequence

from attnlab.clusters.base import Cluster
from attnlab.launch.jobs import Job
from attnlab.launch.progress import Display
from attnlab.registry import register
from attnlab.robot.folder import run_to_folder
from attnlab.tables.files import read_json


@register("cluster", "serial")
class Serial(Cluster):
    """One run after the other, in this process: for debuggers, profilers, and machines that allow no processes. A run
    that crashes in C takes the rest with it; the same command goes on."""

    def run(self, jobs: Sequence[Job], display: Display) -> None:
        for job in jobs:
            seen = [0, 0]

            def progress(episodes: int, cycles: int, seen: list[int] = seen) -> None:
                display.advance(episodes - seen[0], cycles - seen[1])
                seen[:] = episodes, cycles
                display.tick()
            run_to_folder(dict(job.config), job.folder, job.info, progress)
            display.advance(job.episodes - seen[0], 0)
            display.run_done(job, read_json(job.folder / "run.json") or {})
