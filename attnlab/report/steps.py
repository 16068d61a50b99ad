"""How far a job of some seconds is, on the line where a study's progress is shown."""

from __future__ import annotations

import sys
import time
from typing import TYPE_CHECKING, Any, Self

if TYPE_CHECKING:
    from rich.progress import Progress

PLAIN_EVERY_S = 5.0


class Steps:
    """``what`` is done, how many steps of how many, and about how long the others take: a bar where standard error is a
    terminal, a plain line at the start and now and then where it is not.

    Use as a context manager around the work, and as the function that the work tells: nothing is shown before it does,
    so that bad input is one line. It starts no thread, so that the work may fork.
    """

    def __init__(self, what: str, unit: str):
        self.what, self.unit = what, unit
        self._bar: Progress | None = None
        self._task: Any = None  # rich's word for the bar's line
        self._shown = False
        self._started = self._last = time.monotonic()

    def __enter__(self) -> Self:
        return self

    def _show(self) -> None:
        self._shown = True
        if sys.stderr.isatty():
            from rich.console import Console
            from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn
            self._bar = Progress(TextColumn("{task.description}"), BarColumn(bar_width=None),
                                 TextColumn("{task.completed:.0f}/{task.total} " + self.unit), TextColumn("left"),
                                 TimeRemainingColumn(), console=Console(stderr=True), auto_refresh=False)
            self._task = self._bar.add_task(self.what, total=None)
            self._bar.start()
        else:
            print(self.what, file=sys.stderr, flush=True)

    def __exit__(self, *_: object) -> None:
        if self._bar:
            self._bar.stop()
            self._bar = None

    def __call__(self, done: int, of: int) -> None:
        """So many steps of so many are done."""
        if not self._shown:
            self._show()
        now = time.monotonic()
        if done == 0:
            self._started = self._last = now  # what comes before the first step says nothing of their pace
        if self._bar:
            self._bar.update(self._task, completed=done, total=of, refresh=True)
            if done == of:
                self.__exit__()  # what is printed now comes below it
        elif 0 < done < of and now - self._last > PLAIN_EVERY_S:
            self._last = now
            print(f"  {done}/{of} {self.unit}, about {(now - self._started) * (of - done) / done:.0f} s left",
                  file=sys.stderr, flush=True)
