"""Callbacks at work: each is told what happens, and none can do harm."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from attnlab.callbacks.base import Callback
from attnlab.probes.base import Lived
from attnlab.robot.guards import verdict


class Observers:
    """The callbacks of a run; ``errors``: name -> what it raised, for run.json. One that raised is not called again."""

    def __init__(self, callbacks: Sequence[Callback] = ()):
        self._watching = list(callbacks)
        self.errors: dict[str, str] = {}

    def __bool__(self) -> bool:
        return bool(self._watching)

    def start(self, config: Mapping[str, Any]) -> None:
        self._tell(lambda callback: callback.start(config))

    def episode(self, lived: Lived) -> None:
        self._tell(lambda callback: callback.episode(lived))

    def end(self, status: str) -> None:
        self._tell(lambda callback: callback.end(status))

    def _tell(self, what: Callable[[Callback], None]) -> None:
        for callback in list(self._watching):
            try:
                what(callback)
            except Exception as cause:  # noqa: BLE001  whoever watches must not stop the robot
                self._watching.remove(callback)
                self.errors[callback.name] = verdict(cause)
                print(f"attnlab: callback={callback.name} is left out from here on: {self.errors[callback.name]}",
                      file=sys.stderr, flush=True)
