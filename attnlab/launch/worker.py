"""What a run's own process does."""

from __future__ import annotations

import os
import signal
import time
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from attnlab.loading import load_all
from attnlab.robot.folder import run_to_folder

REPORT_S = 0.25


def work(config: dict[str, Any], folder: str, info: dict[str, Any], pipe: Connection) -> None:
    """Run, and tell the parent how far (episodes, cycles) about four times a second; exit code 0 if complete."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the parent's; it ends this process
    load_all()
    last = 0.0

    def progress(episodes: int, cycles: int) -> None:
        nonlocal last
        now = time.monotonic()
        if now - last >= REPORT_S:
            last = now
            try:
                pipe.send((episodes, cycles))
            except OSError:  # the parent is gone: stop too, leaving a run that says it was running
                os._exit(3)
    complete = run_to_folder(config, Path(folder), info, progress)
    os._exit(0 if complete else 1)  # no clean-up in C libraries that could crash after the results are safe
