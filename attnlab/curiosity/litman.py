"""Litman's wanting and liking as the paper has them: residual energy, and novelty in a window."""

from __future__ import annotations

from attnlab.behaviours.base import Senses
from attnlab.curiosity.base import Curiosity
from attnlab.curiosity.window import Window
from attnlab.equations import liking
from attnlab.registry import register


@register("curiosity", "litman")
class Litman(Curiosity):
    """Eqs (11), as in every model that has no wanting of its own, and (12) of Di Nocera et al. 2014, after Litman 2005
    (Cognition & Emotion 19:793).

    The memory is the window of the behaviour's last NV_tot percepts (``reading.novelty_window``); whether the current
    one counts is ``reading.novelty_counts_current``. With ``reading.novelty_over=state`` a percept seen with w > 0 and
    the same one seen with w = 0 are two. Draws nothing at random.
    """

    now: Senses

    def memory(self) -> Window:
        return Window(self.reading.novelty_window, self.bins * (2 if self.reading.novelty_over == "state" else 1))

    def liking(self, memory: Window, percept: int) -> float:
        return liking(self.seen(memory, percept), self.reading.novelty_window)

    def seen(self, memory: Window, percept: int) -> int:
        """NV of eq (12): how many of the NV_tot observations are this percept."""
        place = self.place(memory, percept)
        visits = memory.visits[place]
        if self.reading.novelty_counts_current:  # it pushes the oldest out of a full window
            visits += 0 if memory.oldest() == place else 1
        return visits

    def place(self, memory: Window, percept: int) -> int:
        """Under which number a percept is counted now: its own, or after all those if states count, and w > 0."""
        if self.reading.novelty_over == "state" and self.wanting(memory, self.now.body.energy) > self.high_wanting:
            return percept + self.bins
        return percept

    def observe(self, memory: Window, percept: int) -> None:
        memory.add(self.place(memory, percept))
