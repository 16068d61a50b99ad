"""Bayesian surprise over intensity."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from attnlab.curiosity.base import Curiosity
from attnlab.curiosity.formulas import gamma_divergence, squash
from attnlab.registry import register
from attnlab.settings import setting


@register("curiosity", "surprise_poisson")
class PoissonSurprise(Curiosity):
    """The surprise of Itti & Baldi 2009 (Vision Research 49:1295): a percept k = 1..n is taken as a Poisson count with
    a Gamma(alpha, beta) belief about its rate; alpha' = zeta alpha + k, beta' = zeta beta + 1.

    S is the divergence of the two beliefs (``direction`` as in ``surprise``; the prior is that before forgetting),
    nats; liking 1 - exp(-S/scale), the squashing is ours. At first beta = 1/(1 - zeta), the value it tends to, and
    alpha = beta (n + 1)/2. Unlike ``surprise`` it knows that percepts are ordered: a far one surprises more. Memory:
    [alpha, beta]. Draws nothing."""

    @dataclass
    class Params:
        direction: Literal["prior_post", "post_prior"] = setting("post_prior", "of the divergence")
        forgetting: float = setting(0.7, "zeta: what is kept of the belief at each view", above=0, high=0.999999)
        scale: float = setting(0.5, "surprise that gives a liking of 0.63", unit="nats", above=0)
        persists: bool = setting(True, "keep the belief from one episode to the next")

    params: Params

    def memory(self) -> list[float]:
        rate = 1.0 / (1.0 - self.params.forgetting)
        return [rate * (self.bins + 1) / 2, rate]

    def _after(self, memory: list[float], percept: int) -> tuple[float, float]:
        keep = self.params.forgetting
        return keep * memory[0] + percept + 1, keep * memory[1] + 1.0

    def surprise(self, memory: list[float], percept: int) -> float:
        """S in nats."""
        shape, rate = memory
        new_shape, new_rate = self._after(memory, percept)
        if self.params.direction == "post_prior":
            return gamma_divergence(new_shape, new_rate, shape, rate)
        return gamma_divergence(shape, rate, new_shape, new_rate)

    def liking(self, memory: list[float], percept: int) -> float:
        return squash(self.surprise(memory, percept), self.params.scale)

    def observe(self, memory: list[float], percept: int) -> None:
        memory[:] = self._after(memory, percept)
