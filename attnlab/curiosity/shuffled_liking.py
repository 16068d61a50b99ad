"""A control: liking that says nothing of what is seen."""

from __future__ import annotations

from typing import Any

from attnlab.curiosity.base import Curiosity, CuriosityContext
from attnlab.curiosity.litman import Litman
from attnlab.curiosity.window import Window
from attnlab.equations import liking
from attnlab.registry import register
from attnlab.simulators.base import Surroundings


class Past:
    """What a behaviour remembers: the ``window`` of its last percepts, ``counts[n]`` how often a percept was n of the
    NV_tot observations when it was seen (and so how often its liking was 1 - n / NV_tot), and the ``drawn`` one of
    these n."""

    def __init__(self, window: Window):
        self.window, self.counts, self.drawn = window, [0] * (len(window.last) + 1), 0


@register("curiosity", "shuffled_liking")
class ShuffledLiking(Curiosity):
    """The curious robot with liking shuffled, ours: in place of eq (12) of the percept that is seen, one drawn
    uniformly from all that the same behaviour has had before in the run. It is distributed as the curious robot's own,
    and says nothing of the percept; wanting, levels and eq (4) are as ever.

    The first look of a run has the liking of a new percept, as it must. The window is that of ``litman``, and forgets
    when it does. Memory: :class:`Past`. Draws one number a look (stream ``curiosity``).
    """

    def __init__(self, params: Any, context: CuriosityContext):
        super().__init__(params, context)
        self._novelty = Litman(params, context)
        self._forgets = not self.reading.novelty_persists
        self.persists = True  # the past does; the window is cleared here

    def attach(self, now: Surroundings) -> None:
        self.now = now
        self._novelty.attach(now)

    def memory(self) -> Past:
        return Past(self._novelty.memory())

    def liking(self, memory: Past, percept: int) -> float:
        return liking(memory.drawn, self.reading.novelty_window)

    def observe(self, memory: Past, percept: int) -> None:
        if self._forgets and self.now.cycle == 0:  # every behaviour looks in the first cycle of an episode
            memory.window.clear()
        memory.counts[self._novelty.seen(memory.window, percept)] += 1
        self._novelty.observe(memory.window, percept)
        looks = 0
        for count in memory.counts:
            looks += count
        place, memory.drawn = int(self.draw.random() * looks), 0
        while place >= memory.counts[memory.drawn]:
            place -= memory.counts[memory.drawn]
            memory.drawn += 1
