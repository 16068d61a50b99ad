"""Novelty in a window of any length."""

from __future__ import annotations

from dataclasses import dataclass

from attnlab.curiosity.base import Curiosity
from attnlab.curiosity.window import Window
from attnlab.equations import liking
from attnlab.registry import register
from attnlab.settings import setting


@register("curiosity", "novelty_window")
class NoveltyWindow(Curiosity):
    """Liking 1 - NV/length: eq (12) of Di Nocera et al. 2014 with a length of its own, over the behaviour's last
    percepts, the current one left out. Memory: a window of percepts. Draws nothing at random."""

    @dataclass
    class Params:
        length: int = setting(20, "percepts remembered", unit="observations", low=1, high=100_000)
        persists: bool = setting(False, "keep the window from one episode to the next")

    params: Params

    def memory(self) -> Window:
        return Window(self.params.length, self.bins)

    def liking(self, memory: Window, percept: int) -> float:
        return liking(memory.visits[percept], self.params.length)

    def observe(self, memory: Window, percept: int) -> None:
        memory.add(percept)
