"""What a log gives, and how what it cannot give is counted."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import IO, NamedTuple

from attnlab.settings import setting

Pose = tuple[float, float, float]  # x m, y m, heading rad


class Beams(NamedTuple):
    """Where a scan's beams look (rad in the robot's frame, left positive) and what they hear (m from the sensor)."""
    bearings_rad: tuple[float, ...]
    range_min_m: float
    range_max_m: float


class Scan(NamedTuple):
    """One sweep. ``ranges_m``: a range a beam, from the sensor; range_max where nothing was heard, NaN where the sensor
    gave no valid number. ``time_s``: of the log's own clock. ``pose``: from odometry, None if the log has none."""
    time_s: float
    ranges_m: tuple[float, ...]
    beams: Beams
    pose: Pose | None


class Raw(NamedTuple):
    """A scan as a reader found it: unchecked. ``place``: of it in the file."""
    time_s: float
    ranges_m: tuple[float, ...]
    beams: Beams
    pose: Pose | None
    place: str


@dataclass
class LogSettings:
    """What a file may leave unsaid."""
    rate_hz: float = setting(9.0, "rows a second of a CSV without times", unit="Hz", above=0, high=1000)
    first_deg: float = setting(0.0, "bearing of the first range of a CSV without a header", unit="deg", low=-360,
                               high=360)
    step_deg: float | None = setting(None, "from one range to the next, left positive; left out: clockwise, all round",
                                     unit="deg", low=-360, high=360)
    range_min_m: float = setting(0.0, "nearer than this is no echo, where the file does not say", unit="m", low=0)
    range_max_m: float | None = setting(None, "from here on nothing was heard; left out: as the file says, 5 m in "
                                        "a CSV, 80 m for the lasers of CARMEN logs", unit="m", above=0)
    topic: str = setting("", "the topic of an MCAP's laser scans; left out: the first one found")
    hole_s: float = setting(1.0, "a longer gap between two scans is a hole", unit="s", above=0)


@dataclass
class Ledger:
    """What was skipped, by reason: how often, and where first. A reason is a few plain words."""
    skipped: dict[str, int] = field(default_factory=dict)
    first: dict[str, str] = field(default_factory=dict)
    notes: dict[str, None] = field(default_factory=dict)

    def skip(self, reason: str, place: str, times: int = 1) -> None:
        """Count something that is not in the stream."""
        self.skipped[reason] = self.skipped.get(reason, 0) + times
        self.first.setdefault(reason, place)

    def note(self, text: str) -> None:
        """Something a reader of the log should know; said once."""
        self.notes.setdefault(text)

    def lines(self) -> list[str]:
        """A line a reason, most frequent first, then the notes."""
        ordered = sorted(self.skipped.items(), key=lambda item: (-item[1], item[0]))
        return [f"{count} x {reason} (first: {self.first[reason]})" for reason, count in ordered] + list(self.notes)


Reader = Callable[[IO[bytes], LogSettings, Ledger], Iterator[Raw]]
LONGEST_LINE = 1 << 20  # bytes: no scan has more, and a file without line ends must not fill the memory


def text_lines(stream: IO[bytes], ledger: Ledger) -> Iterator[tuple[int, str]]:
    """(number from 1, text) of each line that can be one; too long ones and such that are no text are counted."""
    number = 0
    while line := stream.readline(LONGEST_LINE):
        number += 1
        if len(line) == LONGEST_LINE and not line.endswith(b"\n"):
            while line and not line.endswith(b"\n"):
                line = stream.readline(LONGEST_LINE)
            ledger.skip("line of more than 1 MB", f"line {number}")
            continue
        try:
            text = line.decode().strip()
        except UnicodeDecodeError:
            ledger.skip("line that is no text", f"line {number}")
            continue
        if number == 1:
            text = text.removeprefix("\ufeff")  # of editors that mark their files
        if text:
            yield number, text
