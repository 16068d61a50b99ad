"""One progress display for a whole sweep."""

from __future__ import annotations

import sys
import time
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Any

from attnlab.launch.jobs import Job

if TYPE_CHECKING:
    from rich.progress import Progress

PLAIN_EVERY_S = 15.0
LONGEST = 400  # characters of an error that are shown


def shorten(text: str, most: int) -> str:
    """A line of bearable length."""
    return text if len(text) <= most else text[:most - 4] + " ..."


class Display:
    """Runs done, episodes, cycles a second, time left; plain lines now and then where there is no terminal.

    Use as a context manager around the work.
    """

    def __init__(self, runs: int, episodes: int, stop_after: int = 0):
        self.runs, self.episodes, self.stop_after = runs, episodes, stop_after
        self.done_runs = self.done_episodes = self.cycles = 0
        self.failed: list[tuple[Job, str]] = []
        self._started = self._last_plain = time.monotonic()
        self._bar: Progress | None = None
        self._task: Any = None  # rich's word for the bar's line

    def __enter__(self) -> Display:
        if sys.stderr.isatty():
            from rich.console import Console
            from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn
            console = Console(stderr=True)
            speed = [TextColumn("{task.fields[speed]}")] if console.width >= 100 else []
            self._bar = Progress(TextColumn("{task.description}"), BarColumn(bar_width=None),
                                 TextColumn("{task.completed:,.0f}/{task.total:,.0f}" + " episodes" * bool(speed)),
                                 *speed, TextColumn("elapsed"), TimeElapsedColumn(), TextColumn("left"),
                                 TimeRemainingColumn(elapsed_when_finished=False), console=console)
            self._task = self._bar.add_task("", total=self.episodes, speed="")
            self._bar.start()
        self.tick()
        return self

    def __exit__(self, *_: object) -> None:
        if self._bar:
            self._bar.stop()

    @property
    def cycles_per_s(self) -> float:
        """Machine cycles a second of wall time, over all runs."""
        return self.cycles / max(1e-9, time.monotonic() - self._started)

    @property
    def hopeless(self) -> str:
        """The last line that too many runs failed with; empty if there is none."""
        lines = Counter(line for _, line in self.failed)
        line, count = lines.most_common(1)[0] if lines else ("", 0)
        return line if self.stop_after and count >= self.stop_after else ""

    def advance(self, episodes: int, cycles: int) -> None:
        self.done_episodes += episodes
        self.cycles += cycles
        if self._bar:
            self._bar.update(self._task, advance=episodes)

    def tick(self) -> None:
        """Show how things stand."""
        if self._bar:
            failed = f", {len(self.failed)} failed" if self.failed else ""
            self._bar.update(self._task, description=f"run {self.done_runs}/{self.runs}{failed}",
                             speed=f"{self.cycles_per_s:,.0f} cycles/s")
        elif time.monotonic() - self._last_plain > PLAIN_EVERY_S:
            self._last_plain = time.monotonic()
            share = self.done_episodes / max(1, self.episodes)
            spent = self._last_plain - self._started
            left = f", about {spent * (1 - share) / share:.0f} s left" if share else ""
            print(f"  {self.done_runs}/{self.runs} runs, {self.done_episodes:,}/{self.episodes:,} episodes, "
                  f"{self.cycles_per_s:,.0f} cycles/s, {spent:.0f} s elapsed{left}", file=sys.stderr, flush=True)

    def run_done(self, job: Job, about: dict[str, Any]) -> None:
        """A run ended, well or not."""
        self.done_runs += 1
        if about.get("status") != "complete":
            lines = str(about.get("error") or "").strip().splitlines() or ["no reason was stored"]
            self.failed.append((job, shorten(lines[-1], LONGEST)))
            line = f"  failed: {job.run}: {self.failed[-1][1]}"
            if self._bar:
                self._bar.console.print(line, markup=False, highlight=False)
            else:
                print(line, file=sys.stderr, flush=True)
        self.tick()

    def print_failed(self, folder: Path) -> None:
        """On standard error: which runs failed, and why nothing more was begun."""
        for job, cause in self.failed[:10]:
            print(f"failed: {folder / job.run}: {cause}", file=sys.stderr)
        if self.hopeless:
            print(f"stopped: {self.stop_after} runs failed alike, and {self.runs - self.done_runs} were not begun: "
                  f"{self.hopeless}. cluster.stop_after=0 goes on", file=sys.stderr)
