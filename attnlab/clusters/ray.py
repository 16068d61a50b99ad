"""Runs as tasks of Ray."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

from attnlab.clusters.elsewhere import LOOK_S, TaskParams, Tasks, work_on
from attnlab.launch.jobs import Job
from attnlab.registry import register
from attnlab.settings import setting
from attnlab.tables.processes import cores


@register("cluster", "ray")
class Ray(Tasks):
    """Tasks of a Ray cluster (pip install 'attnlab[ray]'), retried when their node dies."""
    requires, extra = ("ray",), "ray"

    @dataclass
    class Params(TaskParams):
        cpus: float = setting(1.0, "that a task takes", above=0)
        retries: int = setting(3, "of a task whose node died", low=0)

    def at_once(self, jobs: Sequence[Job]) -> int:
        return min(cores(), -(-len(jobs) // int(self.params.runs_per_job)))

    def tasks(self, study: Path, chunks: Sequence[Sequence[str]]) -> Iterator[list[int]]:
        ray: Any = import_module("ray")
        ray.init(address=self.params.address, include_dashboard=False, log_to_driver=False, configure_logging=False,
                 logging_level="error", **({} if self.params.address else {"num_cpus": cores()}))
        try:
            task = ray.remote(num_cpus=self.params.cpus, max_retries=self.params.retries)(work_on)
            numbers = {task.remote(str(study), list(chunk)): i for i, chunk in enumerate(chunks)}
            while numbers:
                ready, _ = ray.wait(list(numbers), num_returns=1, timeout=LOOK_S)
                yield [numbers.pop(ref) for ref in ready]
        finally:
            ray.shutdown()
