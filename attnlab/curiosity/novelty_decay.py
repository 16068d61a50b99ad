"""Novelty that comes back gradually."""

from __future__ import annotations

from dataclasses import dataclass

from attnlab.curiosity.base import Curiosity, CuriosityContext
from attnlab.registry import register
from attnlab.settings import setting


@register("curiosity", "novelty_decay")
class NoveltyDecay(Curiosity):
    """Liking 1 - z_i, where z_i <- k z_i + (1 - k)[i was seen] and k = 0.5^(1/half_life): eq (12) of Di Nocera et al.
    2014 with an exponential window in place of a sharp one. Memory: the traces z. Draws nothing at random."""

    @dataclass
    class Params:
        half_life: float = setting(7.0, "after which a view counts half", unit="observations", above=0, high=1e6)
        persists: bool = setting(False, "keep the traces from one episode to the next")

    params: Params

    def __init__(self, params: Params, context: CuriosityContext):
        super().__init__(params, context)
        self._keep = 0.5 ** (1.0 / params.half_life)

    def memory(self) -> list[float]:
        return [0.0] * self.bins

    def liking(self, memory: list[float], percept: int) -> float:
        return 1.0 - memory[percept]

    def observe(self, memory: list[float], percept: int) -> None:
        keep = self._keep
        for i in range(self.bins):
            memory[i] *= keep
        memory[percept] += 1.0 - keep
