"""Litman's wanting and liking as the paper has them: residual energy, and novelty in a window."""

from __future__ import annotations

from collections import deque

from attnlab.curiosity.base import Curiosity
from attnlab.equations import liking
from attnlab.registry import register


@register("curiosity", "litman")
class Litman(Curiosity):
    """Eqs (11), as in every model that has no wanting of its own, and (12) of Di Nocera et al. 2014, after Litman 2005
    (Cognition & Emotion 19:793).

    The memory is the window of the behaviour's last NV_tot percepts (``reading.novelty_window``); whether the current
    one counts is ``reading.novelty_counts_current``. Draws nothing at random.
    """

    def memory(self) -> deque[int]:
        return deque(maxlen=self.reading.novelty_window)

    def liking(self, memory: deque[int], percept: int) -> float:
        r, visits = self.reading, memory.count(percept)
        if r.novelty_counts_current:  # it pushes the oldest out of a full window
            visits += 1 - (len(memory) == r.novelty_window and memory[0] == percept)
        return liking(visits, r.novelty_window)

    def observe(self, memory: deque[int], percept: int) -> None:
        memory.append(percept)
