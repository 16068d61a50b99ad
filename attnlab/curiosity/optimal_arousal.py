"""Curiosity for what is new, but not too new."""

from dataclasses import dataclass
from typing import Any

from attnlab.curiosity.composed import Over
from attnlab.curiosity.formulas import wundt
from attnlab.registry import register
from attnlab.settings import setting


@register("curiosity", "optimal_arousal")
class OptimalArousal(Over):
    """Optimal arousal (Berlyne 1960; Spielberger & Starr 1994), shaped like Wundt's curve: liking is a reward
    sigmoid of novelty less a later punishment, 1/(1 + exp(-k(n - a))) - P/(1 + exp(-k(n - b))), at least 0; n is the
    liking of ``signal``, any model, whose memory this uses. Logistic sigmoids and numbers are ours. Draws nothing at
    random."""

    @dataclass
    class Params:
        signal: Any = setting("litman", "model whose liking is the novelty: a name, or {name: ..., setting: ...}")
        reward_at: float = setting(0.3, "a: novelty at which reward has risen to a half")
        punish_at: float = setting(0.8, "b: novelty at which punishment has")
        steepness: float = setting(20.0, "k of both sigmoids", above=0, high=500)
        punishment: float = setting(1.0, "P: size of the punishment, that of the reward being 1", low=0)

    def liking(self, memory: Any, percept: int) -> float:
        p = self.params
        novelty = self.signal.liking(memory, percept)
        return max(0.0, wundt(novelty, p.reward_at, p.punish_at, p.steepness, p.punishment))
