"""Runs side by side on this machine, one process each: a crash of one, even in C, loses that one only."""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import signal
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from multiprocessing import forkserver
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import TYPE_CHECKING, Any

from attnlab.clusters.base import Cluster, cores
from attnlab.launch.jobs import Job
from attnlab.launch.progress import Display
from attnlab.launch.shared import Shared
from attnlab.launch.worker import FAILED, LOST, work
from attnlab.registry import register
from attnlab.settings import setting
from attnlab.tables.claim import BEAT_S, Claim
from attnlab.tables.files import read_json, write_json

if TYPE_CHECKING:
    from multiprocessing.context import ForkServerContext, SpawnContext

    Context = ForkServerContext | SpawnContext


UNKNOWN = 255  # the exit code of a process whose fork server was killed
TRIES = 3  # at a run whose fork server was killed


@dataclass
class _Running:
    """A run at work, and how far it said it is."""
    job: Job
    claim: Claim
    process: BaseProcess
    pipe: Connection
    episodes: int = 0
    cycles: int = 0
    said: str = ""
    beaten: float = field(default_factory=time.monotonic)


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
        context, shared = _context(jobs), Shared(jobs, display)
        running: list[_Running] = []
        lost: dict[str, int] = {}
        at_once = self.at_once(jobs)
        try:
            while shared or running:
                while len(running) < at_once and (found := shared.next()):
                    try:
                        running.append(_start(context, *found))
                    except (EOFError, ConnectionError):  # no fork server can live here (too little memory, say)
                        context = multiprocessing.get_context("spawn")
                        running.append(_start(context, *found))
                ready = wait([r.pipe for r in running] + [r.process.sentinel for r in running], timeout=0.5)
                for run in list(running):
                    if run.pipe in ready:
                        _hear(run, display)
                    if time.monotonic() - run.beaten > BEAT_S:
                        run.claim.beat(run.episodes, run.cycles)
                        run.beaten = time.monotonic()
                    if not run.process.is_alive():
                        running.remove(run)
                        lost[run.job.key] = lost.get(run.job.key, 0) + 1
                        again = lost[run.job.key] < TRIES
                        shared.elsewhere += _finish(run, display, again)
                display.tick()
        except BaseException:
            _stop(running)
            raise


def _stop(running: Sequence[_Running]) -> None:
    """End what is running and give it back."""
    for run in running:
        _kill(run)
    for run in running:
        run.process.join()
        if run.claim.held():
            with contextlib.suppress(OSError):
                _mark_failed(run, "interrupted before it was complete", interrupted=True)
        run.claim.release()


def _kill(run: _Running) -> None:
    """End a run's process, also if its fork server is gone and can tell us nothing of it."""
    with contextlib.suppress(OSError):
        os.kill(run.process.pid or 0, signal.SIGKILL) if run.process.pid else None


def _hear(run: _Running, display: Display) -> None:
    """How far a run is."""
    with contextlib.suppress(EOFError, OSError):
        while run.pipe.poll():
            said = run.pipe.recv()
            if isinstance(said, str):
                run.said = said
                continue
            episodes, cycles = said
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
    try:
        forkserver.ensure_running()
    except OSError:  # the path of its socket is too long (TMPDIR)
        return multiprocessing.get_context("spawn")
    return context


def _start(context: Context, job: Job, claim: Claim) -> _Running:
    receive, send = context.Pipe(duplex=False)
    # No daemon, for a daemon may have no processes of its own; it ends with its parent by itself (see work).
    process = context.Process(target=work, args=(dict(job.config), str(job.folder.absolute()), job.info, send, claim))
    try:
        process.start()
    except BaseException:
        receive.close()
        raise
    finally:
        send.close()
    return _Running(job, claim, process, receive)


def _finish(run: _Running, display: Display, again: bool) -> list[Job]:
    """What became of a run whose process ended; the job, if it is still to be done. ``again``: may one be that only
    lost its fork server?"""
    run.process.join()
    _hear(run, display)
    run.pipe.close()
    code = run.process.exitcode or 0
    if code == UNKNOWN:
        _kill(run)
    if code == LOST or not run.claim.held() or (code == UNKNOWN and again):
        display.advance(-run.episodes, -run.cycles)
        run.claim.release()
        return [run.job]
    about = read_json(run.job.folder / "run.json") or {}
    if about.get("status") == "running" or about.get("claim") != run.claim.token:
        why = run.said or (f"the process died of {_signal_name(-code)}" if code < 0 else
                           f"the process ended with exit code {code}" +
                           ("" if code == FAILED else " before the run was complete"))
        try:
            about = _mark_failed(run, why)
        except OSError as cause:
            about = {"status": "failed", "error": run.said or f"{cause.filename}: {cause.strerror}"}
    run.claim.release()
    cycles = about.get("cycles") or run.cycles
    display.advance(run.job.episodes - run.episodes, cycles - run.cycles)
    display.run_done(run.job, about)
    return []


def _signal_name(number: int) -> str:
    try:
        return f"{signal.Signals(number).name} (signal {number})"
    except ValueError:
        return f"signal {number}"


def _mark_failed(run: _Running, why: str, **more: bool) -> dict[str, Any]:
    """run.json of a run whose process could not write it itself."""
    job = run.job
    job.folder.mkdir(parents=True, exist_ok=True)
    about = read_json(job.folder / "run.json") or {}
    if about.get("claim") != run.claim.token:  # of an earlier time
        about = {"run": job.run, "key": job.key, "seed": job.config["seed"], "swept": job.swept,
                 "curiosity": job.config["curiosity"]["name"], "overrides": job.overrides, "claim": run.claim.token}
    if about.get("status") != "complete":
        about.update(status="failed", error=why, ended=time.strftime("%Y-%m-%dT%H:%M:%S"), **more)
        write_json(job.folder / "run.json", about)
    return about
