"""What a cluster is."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from attnlab.launch.jobs import Job
from attnlab.launch.progress import Display
from attnlab.settings import setting


@dataclass
class Patience:
    """A setting of every cluster."""
    stop_after: int = setting(10, "runs that failed with the same last line after which the sweep stops; 0: never",
                              unit="runs", low=0)


class Cluster(ABC):
    """Does the runs of a study, somewhere. It changes no number: it is in no run's key. ``waits``: for the runs that
    other commands are at, until all are done."""
    name: str
    waits = True

    def __init__(self, params: Any, context: None = None):
        self.params = params

    def at_once(self, jobs: Sequence[Job]) -> int:
        """How many of these runs are done side by side."""
        return 1

    def check(self) -> None:
        """Raise ConfigError if nothing can be done here; before anything is written."""

    @abstractmethod
    def run(self, jobs: Sequence[Job], display: Display) -> None:
        """Do all jobs; what became of each is in its folder. ``display`` is told of episodes and cycles as they come
        (``advance``), of every run that ended (``run_done``), and a few times a second (``tick``)."""
