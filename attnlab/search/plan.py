"""How many readings each rung can try in the time there is, from the speed that was measured."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

from attnlab.errors import ConfigError
from attnlab.search.rungs import Rung
from attnlab.search.score import WHOLE

SHAPE = ((2, 120), (3, 150), (4, 250), (4, WHOLE), (6, WHOLE))  # (seeds, episodes) of each rung; equal times
FEWEST = 8  # readings a rung
START = 0.35  # of what a whole run takes, what one takes that hardly lives
AT_FIRST = 1.25  # roles that play a reading of the first rung: of four, three are not sound, and only the control plays
RESERVE = 0.9  # share of the time that is given out: loading and judging take the rest


def run_cost(episodes: int) -> float:
    """What a run takes, in whole runs."""
    return START + (1 - START) * episodes / WHOLE


@dataclass
class Clock:
    """``run_s``: wall time of a whole run among those beside it; ``ends``: whole runs that the finalists take;
    ``tempo``: how much longer than foreseen rungs took, loading and scoring included."""
    minutes: float
    run_s: float = 0.0
    ends: float = 0
    spent_s: float = 0.0
    tempo: float = 1.0
    foreseen: float = field(default=0.0)  # s, of the rung that was given out last

    def rung(self, place: int, roles: int) -> Rung | None:
        """The rung at this place, as large as its share of the time left allows. Raises ConfigError if none is."""
        if place >= len(SHAPE):
            return None
        left = RESERVE * 60 * self.minutes - self.spent_s - self.ends * self.run_s
        seeds, episodes = SHAPE[place]
        share = left / (len(SHAPE) - place)
        players = AT_FIRST if place == 0 else roles
        readings = int(share / (self.run_s * self.tempo * players * seeds * run_cost(episodes)))
        if readings < FEWEST and place == 0:
            need = math.ceil((self.spent_s + self.ends * self.run_s + len(SHAPE) * share_s(self, roles)) / RESERVE / 60)
            raise ConfigError("--minutes", f"{self.minutes:g} are too few at {self.run_s:.2f} s a run",
                              f"About {need} would do; or name the rungs: --rungs 400:2:120,...")
        rung = Rung(max(FEWEST, readings), seeds, episodes)
        self.foreseen = rung.readings * seeds * players * run_cost(episodes) * self.run_s
        return rung

    def took(self, seconds: float) -> None:
        """The rung that was given out last took so long."""
        self.spent_s += seconds
        if self.foreseen > 0:
            self.tempo = max(0.2, seconds / self.foreseen)


def share_s(clock: Clock, roles: int) -> float:
    """What the dearest rung takes at least, in s."""
    return max(FEWEST * seeds * roles * run_cost(episodes) for seeds, episodes in SHAPE) * clock.run_s


def told(rungs: Sequence[Rung]) -> str:
    """Rungs as they are typed."""
    return ",".join(map(str, rungs))
