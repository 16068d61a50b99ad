"""Runs side by side on this machine, one process each: a crash of one, even in C, loses that one only."""

from __future__ import annotations

import contextlib
import multiprocessing
import signal
import time
from collections.abc import Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import TYPE_CHECKING

from attnlab.clusters.base import Cluster, cores
from attnlab.launch.jobs import Job
from attnlab.launch.progress import Display
from attnlab.launch.worker import work
from attnlab.registry import register
from attnlab.settings import setting
from attnlab.tables.files import read_json, write_json

if TYPE_CHECKING:
    from multiprocessing.context import ForkServerContext, SpawnContext

    Context = ForkServerContext | SpawnContext


@dataclass
class _Running:
    """A run at work, and how far it said it is."""
    job: Job
    process: BaseProcess
    pipe: Connection
    episodes: int = 0
    cycles: int = 0


@register("cluster", "local")
class Local(Cluster):
    """All cores of this machine, one process a run."""

    @dataclass
    class Params:
        jobs: int | None = setting(None, "runs side by side; all cores if left out", low=1, high=1024)

    def at_once(self, jobs: Sequence[Job]) -> int:
        return min(self.params.jobs or cores(), len(jobs))

    def run(self, jobs: Sequence[Job], display: Display) -> None:
        """Ctrl-C stops the running ones, marks them failed (interrupted), and is raised again."""
        context, waiting = _context(jobs), list(jobs)
        running: list[_Running] = []
        at_once = self.at_once(jobs)
        try:
            while waiting or running:
                while waiting and len(running) < at_once:
                    running.append(_start(context, waiting.pop(0)))
                ready = wait([r.pipe for r in running] + [r.process.sentinel for r in running], timeout=0.5)
                for run in list(running):
                    if run.pipe in ready:
                        _hear(run, display)
                    if not run.process.is_alive():
                        running.remove(run)
                        _finish(run, display)
                display.tick()
        except BaseException:
            for run in running:
                run.process.kill()
            for run in running:
                run.process.join()
                _mark_failed(run.job, "interrupted before it was complete")
            raise


def _hear(run: _Running, display: Display) -> None:
    """How far a run is."""
    with contextlib.suppress(EOFError, OSError):
        while run.pipe.poll():
            episodes, cycles = run.pipe.recv()
            display.advance(episodes - run.episodes, cycles - run.cycles)
            run.episodes, run.cycles = episodes, cycles


def _context(jobs: Sequence[Job]) -> Context:
    """Processes forked from a server that has the imports, and nothing else, done already: a run starts in
    milliseconds and no thread or lock of ours is copied. Where there is no fork, fresh processes."""
    if "forkserver" not in multiprocessing.get_all_start_methods():
        return multiprocessing.get_context("spawn")
    context = multiprocessing.get_context("forkserver")
    heavy = ["attnlab.kernels.planar"] if any(job.config["simulator"].get("name") == "planar" for job in jobs) else []
    context.set_forkserver_preload(["attnlab.launch.preload", *heavy])
    return context


def _start(context: Context, job: Job) -> _Running:
    receive, send = context.Pipe(duplex=False)
    process = context.Process(target=work, args=(dict(job.config), str(job.folder), job.info, send), daemon=True)
    process.start()
    send.close()
    return _Running(job, process, receive)


def _finish(run: _Running, display: Display) -> None:
    run.process.join()
    code = run.process.exitcode or 0
    about = read_json(run.job.folder / "run.json") or {}
    if code != 0 and about.get("status") != "failed":
        _mark_failed(run.job, f"the process died of {_signal_name(-code)}" if code < 0 else
                     f"the process ended with exit code {code}")
        about = read_json(run.job.folder / "run.json") or {}
    cycles = about.get("cycles") or run.cycles
    display.advance(run.job.episodes - run.episodes, cycles - run.cycles)
    display.run_done(run.job, about)
    run.pipe.close()


def _signal_name(number: int) -> str:
    try:
        return f"{signal.Signals(number).name} (signal {number})"
    except ValueError:
        return f"signal {number}"


def _mark_failed(job: Job, why: str) -> None:
    """run.json of a run whose process could not write it itself."""
    job.folder.mkdir(parents=True, exist_ok=True)
    about = read_json(job.folder / "run.json") or {"key": job.key, "seed": job.config["seed"], "swept": job.swept,
                                                   "curiosity": job.config["curiosity"]["name"],
                                                   "overrides": job.overrides}
    if about.get("status") != "complete":
        about.update(status="failed", error=why, ended=time.strftime("%Y-%m-%dT%H:%M:%S"))
        write_json(job.folder / "run.json", about)
