"""Curiosity as the closing of an information gap."""

from __future__ import annotations

from dataclasses import dataclass

from attnlab.curiosity.formulas import entropy, squash
from attnlab.curiosity.litman_gap import Beliefs, LitmanGap
from attnlab.registry import register
from attnlab.settings import setting


@register("curiosity", "information_gap")
class InformationGap(LitmanGap):
    """Loewenstein 1994 (Psychol. Bull. 116:75): wanting is the gap, the entropy H(a)/ln n of the percept model;
    liking is how much this percept closes it, 1 - exp(-max(0, H(a) - H(a'))/scale), a_i = prior + views of i in the
    window and a' the same after this one. Entropy as the gap and the squashing are ours; so is that the gap pulls
    hardest when nothing is known (his curiosity grows as the gap narrows). Memory: [a, the window], as in
    ``litman_gap``. Draws nothing at random."""

    @dataclass
    class Params(LitmanGap.Params):
        scale: float = setting(0.05, "reduction of entropy that gives a liking of 0.63", unit="nats", above=0)

    params: Params

    def reduction(self, memory: Beliefs, percept: int) -> float:
        """H(a) - H(a'), nats; negative for a percept that makes the model less sure."""
        after, leaves = memory.a.copy(), memory.window.oldest()
        after[percept] += 1.0
        if leaves >= 0:
            after[leaves] -= 1.0
        return entropy(memory.a) - entropy(after)

    def liking(self, memory: Beliefs, percept: int) -> float:
        return squash(self.reduction(memory, percept), self.params.scale)
