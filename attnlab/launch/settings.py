"""Where a sweep runs."""

from __future__ import annotations

from dataclasses import dataclass

from attnlab.settings import setting


@dataclass
class LocalCluster:
    """All cores of this machine, one process a run."""
    jobs: int | None = setting(None, "runs side by side; all cores if left out", low=1, high=1024)
