"""A run in a process of its own, seen from the process that wanted it."""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import re
import signal
import time
from collections.abc import Sequence
from multiprocessing import forkserver, util
from pathlib import Path
from typing import TYPE_CHECKING, Any

from attnlab import registry
from attnlab.launch.jobs import Job
from attnlab.launch.progress import Display
from attnlab.launch.worker import FAILED, LOST, WHERE, work
from attnlab.paths import PACKAGE
from attnlab.tables.claim import BEAT_S, Claim
from attnlab.tables.files import read_json, write_json
from attnlab.tables.processes import address_space, signal_name
from attnlab.tables.scratch import sign, sweep_scratch

if TYPE_CHECKING:
    from multiprocessing.context import ForkServerContext, SpawnContext

    Context = ForkServerContext | SpawnContext

START_S = 120.0  # that a process may take to begin its run on a busy machine
SERVER_BYTES = 4e9  # of address space that the server of all imports, and a run beside it, certainly fit in
UNKNOWN = 255  # the exit code of a process whose fork server was killed


def context_for(jobs: Sequence[Job]) -> Context:
    """Processes forked from a server that has the imports, and nothing else, done already: a run starts in
    milliseconds and no thread or lock of ours is copied. Where there is no fork, or too little memory for all imports
    at once, fresh processes."""
    if "forkserver" not in multiprocessing.get_all_start_methods() or address_space() < SERVER_BYTES:
        return multiprocessing.get_context("spawn")
    context = multiprocessing.get_context("forkserver")
    compiled = any(job.engine is not None and job.engine.name == "compiled" for job in jobs)
    planar = any(job.config["simulator"].get("name") == "planar" for job in jobs)
    heavy = ["attnlab.kernels.planar"] * planar + ["attnlab.compiled.engine", "attnlab.compiled.summary"] * compiled
    context.set_forkserver_preload(["attnlab.launch.preload", *heavy])
    try:
        sweep_scratch()
        forkserver.ensure_running()
        sign(Path(util.get_temp_dir()))  # where its socket is
    except OSError:  # the path of its socket is too long (TMPDIR)
        return multiprocessing.get_context("spawn")
    return context


class Child:
    """A run at work: ``episodes`` and ``cycles`` are how far it said it is. Raises EOFError or ConnectionError if the
    context cannot make processes."""

    def __init__(self, context: Context, job: Job, claim: Claim):
        self.job, self.claim = job, claim
        self.episodes = self.cycles = 0
        self.why = ""
        self.started = self._beaten = time.monotonic()
        self._began: float | None = None  # when the process said that it is there
        self.pipe, send = context.Pipe(duplex=False)
        # No daemon, for a daemon may have no processes of its own; it ends with its parent by itself (see work).
        self.process = context.Process(target=work, args=(dict(job.config), str(job.folder.absolute()), job.info, send,
                                                          claim))
        try:
            self.process.start()
        except BaseException:
            self.pipe.close()
            raise
        finally:
            send.close()

    def hear(self, display: Display) -> None:
        """How far the run is."""
        with contextlib.suppress(EOFError, OSError):
            while self.pipe.poll():
                said = self.pipe.recv()
                self._began = self._began or time.monotonic()
                if isinstance(said, str):
                    self.why = said
                    continue
                episodes, cycles = said
                display.advance(episodes - self.episodes, cycles - self.cycles)
                self.episodes, self.cycles = episodes, cycles

    def beat(self) -> None:
        """A sign of life, now and then."""
        if time.monotonic() - self._beaten > BEAT_S:
            self.claim.beat(self.episodes, self.cycles)
            self._beaten = time.monotonic()

    def kill(self) -> None:
        """End the process, also if its fork server is gone and can tell us nothing of it."""
        if self.process.pid:
            with contextlib.suppress(OSError):
                os.kill(self.process.pid, signal.SIGKILL)

    def check_time(self, minutes: float) -> None:
        """End a run that took longer than so many minutes, and find out where it is."""
        late = self.started + START_S if self._began is None else self._began
        if self.why or time.monotonic() < late + 60 * minutes or not self.process.is_alive():
            return
        file = self.job.folder / WHERE
        with contextlib.suppress(OSError, AttributeError):  # a system without that signal
            os.kill(self.process.pid or 0, signal.SIGUSR1) if self.process.pid else None
            until = time.monotonic() + 2.0
            while time.monotonic() < until and "File" not in file.read_text():
                time.sleep(0.05)
        self.why = f"was not done within {minutes:g} minutes (cluster.minutes_a_run): it was in {_innermost(file)}"
        self.kill()

    def interrupt(self) -> None:
        """End the run before it is complete, and give it back."""
        self.kill()
        self.process.join()
        if self.claim.held():
            with contextlib.suppress(OSError):
                self._mark_failed("interrupted before it was complete", interrupted=True)
        self.claim.release()

    def finish(self, display: Display, again: bool) -> list[Job]:
        """What became of a run whose process ended; the job, if it is still to be done. ``again``: may one be that
        only lost its fork server?"""
        self.process.join()
        self.hear(display)
        self.pipe.close()
        code = self.process.exitcode or 0
        if code == UNKNOWN:
            self.kill()
        if code == LOST or not self.claim.held() or (code == UNKNOWN and again):
            display.advance(-self.episodes, -self.cycles)
            self.claim.release()
            return [self.job]
        about = read_json(self.job.folder / "run.json") or {}
        if about.get("status") == "running" or about.get("claim") != self.claim.token:
            why = self.why or (f"the process died of {signal_name(-code)}" if code < 0 else
                               f"the process ended with exit code {code}" +
                               ("" if code == FAILED else " before the run was complete"))
            try:
                about = self._mark_failed(why)
            except OSError as cause:  # a full disk
                about = {"status": "failed", "error": self.why or f"{cause.filename}: {cause.strerror}"}
        self.claim.release()
        cycles = about.get("cycles") or self.cycles
        display.advance(self.job.episodes - self.episodes, cycles - self.cycles)
        display.run_done(self.job, about)
        return []

    def _mark_failed(self, why: str, **more: bool) -> dict[str, Any]:
        """run.json of a run whose process could not write it itself."""
        job = self.job
        job.folder.mkdir(parents=True, exist_ok=True)
        (job.folder / WHERE).unlink(missing_ok=True)
        about = read_json(job.folder / "run.json") or {}
        if about.get("claim") != self.claim.token:  # of an earlier time
            about = {"run": job.run, "key": job.key, "seed": job.config["seed"], "swept": job.swept,
                     "curiosity": job.config["curiosity"]["name"], "overrides": job.overrides,
                     "claim": self.claim.token}
        if about.get("status") != "complete":
            about.update(status="failed", error=why, ended=time.strftime("%Y-%m-%dT%H:%M:%S"), **more)
            write_json(job.folder / "run.json", about)
        return about


def _innermost(file: Path) -> str:
    """``file:line (function)`` of the innermost frame of a part that is not ours, or else of ours, from what
    :mod:`faulthandler` wrote."""
    try:
        main = file.read_text().rpartition("Current thread")[2]
    except OSError:
        main = ""
    frames = re.findall(r'File "(.+)", line (\d+) in (\S+)', main)
    theirs = {str(Path(spec.origin).parent) for spec in registry.parts.values()
              if not Path(spec.origin).is_relative_to(PACKAGE)}
    chosen = next((f for f in frames if str(Path(f[0]).parent) in theirs), None) or \
        next((f for f in frames if Path(f[0]).is_relative_to(PACKAGE)), None) or (frames[0] if frames else None)
    return f"{chosen[0]}:{chosen[1]} ({chosen[2]})" if chosen else "no place that could be told"
