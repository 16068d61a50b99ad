"""Is there room for a study's results?"""

from __future__ import annotations

import os
import shutil
from collections.abc import Sequence

from attnlab.errors import ConfigError
from attnlab.launch.jobs import Job
from attnlab.tables.schema import row_bytes


def check_place(jobs: Sequence[Job]) -> None:
    """Raise ConfigError if the results cannot be written or would not fit. Leaves nothing behind."""
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
    disk, memory = sum(job.episodes for job in jobs) * a_row, largest.episodes * a_row * 6
    for need, have, what in ((disk, free, "disk, free are"), (memory, _memory(), "memory, there are")):
        if need > have:
            setting = "train_episodes" if s.train_episodes >= s.validation_episodes else "validation_episodes"
            raise ConfigError(setting, f"{largest.episodes} episodes a run would need about {need / 1e9:.0f} GB of "
                              f"{what} {have / 1e9:.0f} GB", "Ask for fewer")


def _memory() -> int:
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (ValueError, OSError, AttributeError):
        return 2**62
