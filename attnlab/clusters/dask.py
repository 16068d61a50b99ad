"""Runs as tasks of Dask."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

from attnlab.clusters.elsewhere import LOOK_S, TaskParams, Tasks, work_on
from attnlab.launch.jobs import Job
from attnlab.registry import register
from attnlab.settings import setting
from attnlab.tables.processes import cores


@register("cluster", "dask")
class Dask(Tasks):
    """Tasks of any Dask cluster by its address (pip install 'attnlab[dask]'), and so of PBS, SGE, LSF, HTCondor and
    Kubernetes; docs/clusters.md shows how."""
    requires, extra = ("distributed",), "dask"

    @dataclass
    class Params(TaskParams):
        retries: int = setting(3, "of a task whose worker died", low=0)

    def at_once(self, jobs: Sequence[Job]) -> int:
        return min(cores(), -(-len(jobs) // int(self.params.runs_per_job)))

    def tasks(self, study: Path, chunks: Sequence[Sequence[str]]) -> Iterator[list[int]]:
        dask: Any = import_module("distributed")
        if self.params.address:
            with dask.Client(self.params.address) as client:
                yield from self._tasks(client, dask.wait, study, chunks)
            return
        with dask.LocalCluster(n_workers=cores(), threads_per_worker=1, dashboard_address=None) as cluster, \
                dask.Client(cluster) as client:
            yield from self._tasks(client, dask.wait, study, chunks)

    def _tasks(self, client: Any, wait: Any, study: Path, chunks: Sequence[Sequence[str]]) -> Iterator[list[int]]:
        numbers = {client.submit(work_on, str(study), list(chunk), pure=False, retries=self.params.retries): i
                   for i, chunk in enumerate(chunks)}
        try:
            while numbers:
                with suppress(TimeoutError):
                    wait(list(numbers), timeout=LOOK_S, return_when="FIRST_COMPLETED")
                yield [numbers.pop(future) for future in [future for future in numbers if future.done()]]
        finally:
            client.cancel(list(numbers))
