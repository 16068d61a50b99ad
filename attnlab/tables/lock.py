"""One at a time: a lock on a folder that a dead process does not keep."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

FILE = ".lock"


@contextmanager
def locked(folder: Path, patience_s: float = 60.0) -> Iterator[None]:
    """Hold the folder's lock. The system gives it back when its holder ends, however that is. Raises TimeoutError if
    somebody else holds it for longer than ``patience_s``."""
    try:
        import fcntl
    except ImportError:  # no such locks on this system: two commands that grow a study at once are on their own
        yield
        return
    with (folder / FILE).open("a") as file:
        until = time.monotonic() + patience_s
        while True:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                break
            except BlockingIOError:
                if time.monotonic() > until:
                    raise TimeoutError(f"{folder}: another command has held {FILE} for {patience_s:.0f} s "
                                       f"(this is process {os.getpid()})") from None
                time.sleep(0.02)
        yield
