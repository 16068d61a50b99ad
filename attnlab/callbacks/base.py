"""What a callback is."""

from __future__ import annotations

from abc import ABC
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from attnlab.probes.base import Lived


@dataclass(frozen=True)
class CallbackContext:
    """What a callback is built from: the run's name, and its folder (None if nothing is stored)."""
    run: str
    folder: Path | None


class Callback(ABC):
    """Watches a run. It changes no number and is in no run's key; one that raises is left out from there on, and named
    in run.json. Overrides what it needs."""
    name: str

    def __init__(self, params: Any, context: CallbackContext):
        self.params, self.run, self.folder = params, context.run, context.folder

    def start(self, config: Mapping[str, Any]) -> None:
        """The run begins; ``config``: its resolved config."""

    def episode(self, lived: Lived) -> None:
        """An episode has ended."""

    def end(self, status: str) -> None:
        """The run has ended, ``complete`` or ``failed``."""
