"""Litman's wanting and liking as the paper has them: residual energy, and novelty in a window."""

from __future__ import annotations

from attnlab.curiosity.base import Curiosity
from attnlab.curiosity.window import Window
from attnlab.equations import liking
from attnlab.registry import register


@register("curiosity", "litman")
class Litman(Curiosity):
    """Eqs (11), as in every model that has no wanting of its own, and (12) of Di Nocera et al. 2014, after Litman 2005
    (Cognition & Emotion 19:793).

    The memory is the window of the behaviour's last NV_tot percepts (``reading.novelty_window``); whether the current
    one counts is ``reading.novelty_counts_current``. Draws nothing at random.
    """

    def memory(self) -> Window:
        return Window(self.reading.novelty_window, self.bins)

    def liking(self, memory: Window, percept: int) -> float:
        return liking(self.seen(memory, percept), self.reading.novelty_window)

    def seen(self, memory: Window, percept: int) -> int:
        """NV of eq (12): how many of the NV_tot observations are this percept."""
        visits = memory.visits[percept]
        if self.reading.novelty_counts_current:  # it pushes the oldest out of a full window
            visits += 0 if memory.oldest() == percept else 1
        return visits

    def observe(self, memory: Window, percept: int) -> None:
        memory.add(percept)
