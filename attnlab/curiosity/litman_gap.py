"""Litman's own wanting: what one does not know."""

from __future__ import annotations

from dataclasses import dataclass
from math import log

from attnlab.curiosity.base import HH, LH, LOW, Curiosity, CuriosityContext
from attnlab.curiosity.formulas import entropy
from attnlab.curiosity.window import Window
from attnlab.equations import liking
from attnlab.registry import register
from attnlab.settings import setting


@dataclass
class Beliefs:
    """a_i, the views of each percept in the window and before any."""
    a: list[float]
    window: Window


@register("curiosity", "litman_gap")
class LitmanGap(Curiosity):
    """Deprivation as Litman 2005 (Cognition & Emotion 19:793) means it, in place of the paper's residual energy.

    Wanting is the entropy of the percept model over its maximum, H(a)/ln n with a_i = prior + views of i in the last
    ``length`` percepts: 1 when nothing is known, less the better the next percept is known. Liking is eq (12) over the
    same window. Wanting is high above ``high_wanting``. Memory: :class:`Beliefs`. The entropy and its threshold are
    ours. Draws nothing at random.
    """
    levels = (LOW, LH, HH)

    @dataclass
    class Params:
        length: int = setting(10, "percepts the model is made of", unit="observations", low=1, high=100_000)
        prior: float = setting(0.5, "pseudo-views of each percept", unit="observations", above=0)
        high_wanting: float = setting(0.5, "wanting is high above this", low=0, high=1)
        persists: bool = setting(False, "keep the model from one episode to the next")

    params: Params

    def __init__(self, params: Params, context: CuriosityContext):
        super().__init__(params, context)
        self.high_wanting = params.high_wanting
        self._most = log(context.bins) if context.bins > 1 else 1.0

    def memory(self) -> Beliefs:
        return Beliefs([self.params.prior] * self.bins, Window(self.params.length, self.bins))

    def wanting(self, memory: Beliefs, energy: float) -> float:
        return min(1.0, entropy(memory.a) / self._most)

    def liking(self, memory: Beliefs, percept: int) -> float:
        return liking(memory.window.visits[percept], self.params.length)

    def observe(self, memory: Beliefs, percept: int) -> None:
        leaves = memory.window.oldest()
        memory.a[percept] += 1.0
        if leaves >= 0:
            memory.a[leaves] -= 1.0
        memory.window.add(percept)
