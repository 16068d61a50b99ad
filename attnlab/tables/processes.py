"""Processes: how many fit, is the one that began a run still at it, does this one still have somebody to work for?"""

from __future__ import annotations

import math
import os
import platform
import signal
import threading
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any


def cores() -> int:
    """Cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def cpu_s() -> float:
    """CPU seconds that this process has spent; on a thread beside the main one, that thread."""
    alone = threading.current_thread() is threading.main_thread()
    return time.process_time() if alone else time.thread_time()


def address_space() -> float:
    """Bytes that a process may map (``ulimit -v``); infinite where nothing limits it."""
    try:
        import resource
    except ImportError:  # Windows
        return math.inf
    limit = resource.getrlimit(resource.RLIMIT_AS)[0]
    return math.inf if limit == resource.RLIM_INFINITY else limit


def signal_name(number: int) -> str:
    """What a signal is called: ``SIGSEGV (signal 11)``."""
    try:
        return f"{signal.Signals(number).name} (signal {number})"
    except ValueError:
        return f"signal {number}"


def birth(pid: int) -> int | None:
    """When a process started, in clock ticks since boot, so that a number used again is not taken for the old process;
    None if it is gone (a zombie is), or 0 where the system does not tell."""
    if not Path("/proc/self/stat").exists():
        try:
            os.kill(pid, 0)
        except OSError:
            return None
        return 0
    try:
        fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return None
    return None if fields[0] in "ZX" else int(fields[19])


def is_running(about: Mapping[str, Any], patience_s: float = 1.0) -> bool:
    """Is the process of a run.json still there? Told on its own machine only; one that was just killed is given
    ``patience_s`` to go."""
    pid = about.get("pid")
    if os.name != "posix" or about.get("host") != platform.node() or not isinstance(pid, int):
        return False
    until = time.monotonic() + patience_s
    while (found := birth(pid)) is not None and found == about.get("pid_birth", found):
        if time.monotonic() >= until:
            return True
        time.sleep(0.05)
    return False


def end_with_parent() -> None:
    """End this process, which :mod:`multiprocessing` began, as soon as the one that wanted it is gone."""
    from multiprocessing import parent_process
    from multiprocessing.connection import wait
    parent = parent_process()
    if parent is None:
        return

    def watch() -> None:
        wait([parent.sentinel])
        os._exit(3)
    threading.Thread(target=watch, daemon=True).start()
