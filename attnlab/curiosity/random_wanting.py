"""A control: wanting that hangs on nothing."""

from __future__ import annotations

from typing import Any

from attnlab.curiosity.base import Curiosity, CuriosityContext
from attnlab.curiosity.litman import Litman
from attnlab.curiosity.window import Window
from attnlab.registry import register
from attnlab.simulators.base import Surroundings


class Urge:
    """What a behaviour remembers: the ``window`` of its last percepts, and its ``wanting`` at the next look."""

    def __init__(self, window: Window):
        self.window, self.wanting = window, 0.5


@register("curiosity", "random_wanting")
class RandomWanting(Curiosity):
    """The curious robot with random wanting, ours: in place of the residual energy, eq (11), each look's w is drawn
    uniformly from [0, 1), whatever the robot has eaten; liking, levels and eq (4) are as ever.

    An episode's first look, which nothing is paid for, has w = 0.5. As w is never 0 but by chance, the level is LH or
    HH. Memory: :class:`Urge`. Draws one number a look (stream ``curiosity``).
    """

    def __init__(self, params: Any, context: CuriosityContext):
        super().__init__(params, context)
        self._novelty = Litman(params, context)

    def attach(self, now: Surroundings) -> None:
        self.now = now
        self._novelty.attach(now)

    def memory(self) -> Urge:
        return Urge(self._novelty.memory())

    def wanting(self, memory: Urge, energy: float) -> float:
        return memory.wanting

    def liking(self, memory: Urge, percept: int) -> float:
        return self._novelty.liking(memory.window, percept)

    def observe(self, memory: Urge, percept: int) -> None:
        self._novelty.observe(memory.window, percept)
        memory.wanting = self.draw.random()
