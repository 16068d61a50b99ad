"""What a run's own process does."""

from __future__ import annotations

import contextlib
import faulthandler
import os
import signal
import time
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from attnlab.console import lenient_streams
from attnlab.loading import load_all
from attnlab.robot.folder import ClaimLostError, run_to_folder
from attnlab.tables.claim import Claim
from attnlab.tables.processes import end_with_parent

REPORT_S = 0.25
WHERE = ".where"  # in the run's folder: where it was when somebody asked
COMPLETE, FAILED, ORPHAN, LOST = 0, 1, 3, 4  # exit codes


def work(config: dict[str, Any], folder: str, info: dict[str, Any], pipe: Connection, claim: Claim | None = None
         ) -> None:
    """Run, and tell the parent how far (episodes, cycles) about four times a second. Ends as soon as the parent is
    gone, leaving a run that says it was running."""
    for number in (signal.SIGINT, signal.SIGTERM):  # they are the parent's, who ends this process
        signal.signal(number, signal.SIG_IGN)
    lenient_streams()
    end_with_parent()
    load_all()
    last, where = 0.0, Path(folder) / WHERE
    with contextlib.suppress(OSError, AttributeError):  # a system without that signal
        where.parent.mkdir(parents=True, exist_ok=True)
        faulthandler.register(signal.SIGUSR1, where.open("w"))
        pipe.send((0, 0))  # from here on its time counts

    def progress(episodes: int, cycles: int) -> None:
        nonlocal last
        now = time.monotonic()
        if now - last >= REPORT_S:
            last = now
            try:
                pipe.send((episodes, cycles))
            except OSError:
                os._exit(ORPHAN)
    try:
        code = COMPLETE if run_to_folder(config, Path(folder), info, progress, claim) else FAILED
    except ClaimLostError:
        code = LOST
    except OSError as cause:  # the disk is full, say: there is no place for the reason
        with contextlib.suppress(OSError):
            pipe.send(f"{cause.filename or folder}: {cause.strerror}")
        code = FAILED
    with contextlib.suppress(OSError):
        where.unlink(missing_ok=True)
    os._exit(code)  # no clean-up in C libraries that could crash after the results are safe
