"""Is there room for a study's results?"""

from __future__ import annotations

import os
import shutil
from collections.abc import Sequence
from pathlib import Path

from attnlab.errors import ConfigError
from attnlab.launch.jobs import Job
from attnlab.tables.schema import row_bytes


def check_place(jobs: Sequence[Job]) -> None:
    """Raise ConfigError if the results cannot be written or would not fit. Leaves nothing behind."""
    folder = jobs[0].folder.parent
    made = []
    try:
        for path in [*reversed(folder.parents), folder]:
            if not path.exists():
                path.mkdir()
                made.append(path)
        probe = folder / f".probe.{os.getpid()}"
        probe.touch()
        probe.unlink()
    except OSError as cause:
        raise ConfigError("outputs", f"{folder} cannot be written ({cause.strerror or cause})",
                          "Choose a folder of yours: outputs=...") from None
    finally:
        free = _free_bytes(folder)
        for path in reversed(made):
            path.rmdir()
    largest = max(jobs, key=lambda job: job.episodes)
    s = largest.settings
    a_row = row_bytes("episodes", len(s.behaviours)) + row_bytes("behaviours", len(s.behaviours))
    disk, memory = sum(job.episodes for job in jobs) * a_row, largest.episodes * a_row * 6
    for need, have, what in ((disk, free, "disk, free are"), (memory, _memory(), "memory, there are")):
        if need > have:
            setting = "train_episodes" if s.train_episodes >= s.validation_episodes else "validation_episodes"
            raise ConfigError(setting, f"{largest.episodes} episodes a run would need about {need / 1e9:.0f} GB of "
                              f"{what} {have / 1e9:.0f} GB", "Ask for fewer")


def _free_bytes(folder: Path) -> int:
    while not folder.exists():
        folder = folder.parent
    return shutil.disk_usage(folder).free


def _memory() -> int:
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (ValueError, OSError, AttributeError):
        return 2**62
