"""Is there room for a study's results, and for a run?"""

from __future__ import annotations

import os
import shutil
from collections.abc import Sequence

from attnlab.errors import ConfigError
from attnlab.launch.jobs import Job
from attnlab.tables.processes import address_space
from attnlab.tables.schema import row_bytes

LEAST_BYTES = 1e9  # of address space; with less, BLAS tries for ever to get what it needs
PACKED = 4  # times that a row of a cycle is smaller in its file


def check_place(jobs: Sequence[Job]) -> None:
    """Raise ConfigError if the results cannot be written or would not fit, or a run has no memory to live in. Leaves
    nothing behind."""
    if address_space() < LEAST_BYTES:
        raise ConfigError("ulimit -v", f"allows a process {address_space() / 1e6:.0f} MB, and a run takes more than "
                          f"{LEAST_BYTES / 1e6:.0f} MB", "ulimit -v unlimited")
    folder = jobs[0].folder.parent
    try:
        there = next(path for path in (folder, *folder.parents) if path.exists())
        probe = there / f".probe.{os.getpid()}"  # a name of its own: another command may be checking the same place
        probe.mkdir()
        probe.rmdir()
    except OSError as cause:
        raise ConfigError("outputs", f"{folder} cannot be written ({cause.strerror or cause})",
                          "Choose a folder of yours: outputs=...") from None
    free = shutil.disk_usage(there).free
    largest = max(jobs, key=lambda job: job.episodes)
    s = largest.settings
    a_row = row_bytes("episodes", len(s.behaviours)) + row_bytes("behaviours", len(s.behaviours))
    a_cycle = row_bytes("cycles", len(s.behaviours))
    disk = sum(job.episodes * a_row + a_cycle * _recorded(job) / PACKED for job in jobs)
    memory = 6 * (largest.episodes * a_row + a_cycle * _recorded(largest))
    for need, have, what in ((disk, free, "disk, free are"), (memory, _memory(), "memory, there are")):
        if need > have:
            if _recorded(largest) * a_cycle > largest.episodes * a_row:
                raise ConfigError("record", f"'{s.record}' of {largest.episodes} episodes a run, up to {s.max_cycles} "
                                  f"cycles each, would need about {size(need)} of {what} {size(have)}", "record=last")
            setting = "train_episodes" if s.train_episodes >= s.validation_episodes else "validation_episodes"
            raise ConfigError(setting, f"{largest.episodes} episodes a run would need about {size(need)} of "
                              f"{what} {size(have)}", "Ask for fewer, or make room")


def size(n: float) -> str:
    """So many bytes, in a unit that shows them: ``12 kB``."""
    unit, word = next(found for found in ((1e9, "GB"), (1e6, "MB"), (1e3, "kB"), (0.0, "B")) if n >= found[0])
    return f"{n / (unit or 1):,.0f} {word}"


def _recorded(job: Job) -> int:
    """Cycles that a run stores at most, if they are those of many episodes."""
    s = job.settings
    return s.max_cycles * {"validation": s.validation_episodes, "all": job.episodes}.get(s.record, 0)


def _memory() -> int:
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (ValueError, OSError, AttributeError):
        return 2**62
