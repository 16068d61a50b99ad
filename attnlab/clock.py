"""A learned clock to take away: this one file needs nothing but Python, on a robot as well as here.

    clock = Clock.from_run("outputs/STUDY/RUN", "avoid")     # where attnlab is
    clock.save("avoid.json")

    clock = Clock.load("avoid.json")                         # on the robot, with this file beside it
    clock.start()
    cycles = clock.next(clock.percept(nearest_m))            # look again after so many cycles
"""

from __future__ import annotations

import json

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

FORMAT = "attnlab clock 1"


class Clock:
    """The greedy policy of one behaviour: for each curiosity level, period in force and percept, the next period.

    ``periods``: that it may grant, machine cycles; ``levels``: names of the curiosity levels; ``low``, ``high``,
    ``bins``: how a measured sigma becomes a percept 1 ... bins; ``table[level][period][percept - 1]``: index of the
    next period; ``about``: where it comes from. Raises ValueError, in one line, for what cannot be.
    """

    def __init__(self, periods: Sequence[int], levels: Sequence[str], low: float, high: float, bins: int,
                 table: Sequence[Sequence[Sequence[int]]], about: Mapping[str, object] | None = None):
        self.periods, self.levels = [int(p) for p in periods], [str(level) for level in levels]
        self.low, self.high, self.bins, self.about = float(low), float(high), int(bins), dict(about or {})
        self.table = [[[int(action) for action in row] for row in level] for level in table]
        shape = [len(self.table), {len(level) for level in self.table}, {len(r) for level in self.table for r in level}]
        if shape != [len(self.levels), {len(self.periods)}, {self.bins}] or not self.low < self.high:
            raise ValueError(f"a clock of {len(self.levels)} levels, {len(self.periods)} periods and {self.bins} "
                             f"percepts within [{self.low}, {self.high}] cannot have a table of {shape}")
        if not all(0 <= action < len(self.periods) for level in self.table for row in level for action in row):
            raise ValueError("the table names a period that is not there")
        self._level = dict(zip(self.levels, self.table, strict=True))
        self.start()

    def start(self) -> None:
        """As at the start of an episode: the shortest period is in force."""
        self._action = self.periods.index(min(self.periods))

    def percept(self, sigma: float) -> int:
        """The percept (1 ... bins) of a measured value; values outside of [low, high] are in the first or last."""
        if sigma != sigma:
            raise ValueError("sigma is no number")
        place = (min(self.high, max(self.low, sigma)) - self.low) / (self.high - self.low)
        return min(self.bins, int(place * self.bins) + 1)

    def next(self, percept: int, level: str | None = None) -> int:
        """Machine cycles until the next look. ``level``: of curiosity, the first one (nothing drives it) if left
        out."""
        if not 0 < percept <= self.bins:
            raise ValueError(f"percept {percept} is not one of 1 to {self.bins}")
        try:
            rows = self.table[0] if level is None else self._level[level]
        except KeyError:
            raise ValueError(f"no level is called '{level}'; known: {', '.join(self.levels)}") from None
        self._action = rows[self._action][percept - 1]
        return self.periods[self._action]

    def to_json(self) -> str:
        """All of it as text; the same clock gives the same text."""
        return json.dumps({"format": FORMAT, "periods_mc": self.periods, "levels": self.levels, "low": self.low,
                           "high": self.high, "bins": self.bins, "table": self.table, "about": self.about},
                          indent=1, sort_keys=True) + "\n"

    @classmethod
    def from_json(cls, text: str) -> Clock:
        """A clock from its text."""
        try:
            found = json.loads(text)
            if found["format"] != FORMAT:
                raise KeyError("format")
            return cls(found["periods_mc"], found["levels"], found["low"], found["high"], found["bins"], found["table"],
                       found.get("about"))
        except (KeyError, TypeError, json.JSONDecodeError) as cause:
            raise ValueError(f"this is no {FORMAT}: {type(cause).__name__} {cause}") from None

    def save(self, path: str) -> None:
        """Write it to a file."""
        with open(path, "w", encoding="utf-8") as file:  # noqa: PTH123  one file, few imports
            file.write(self.to_json())

    @classmethod
    def load(cls, path: str) -> Clock:
        """Read it from a file."""
        with open(path, encoding="utf-8") as file:  # noqa: PTH123
            return cls.from_json(file.read())

    @classmethod
    def from_run(cls, run: str, behaviour: str) -> Clock:
        """The clock that a behaviour has learned in a complete run (its folder). Needs attnlab; raises its
        ConfigError if there is no such run or behaviour, or if what its learner does next is not told by the state
        alone (a random period, a change of percepts)."""
        from attnlab.robot.taken import taken
        return cls(**taken(run, behaviour))
