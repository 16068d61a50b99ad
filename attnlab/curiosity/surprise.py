"""Bayesian surprise over percepts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from attnlab.curiosity.base import Curiosity
from attnlab.curiosity.formulas import dirichlet_surprise, squash
from attnlab.registry import register
from attnlab.settings import setting


@register("curiosity", "surprise", presets={"surprise_reverse": {"direction": "post_prior"}})
class Surprise(Curiosity):
    """How much a percept changes what is believed (Baldi & Itti 2010, Neural Networks 23:649).

    The belief over percepts is Dirichlet(a), a_i = prior at first. With A = sum a, S = ln(a_i/A) - psi(a_i) + psi(A),
    the KL(prior||posterior), or psi(a_i+1) - psi(A+1) - ln(a_i/A), the other way (preset ``surprise_reverse``), nats.
    Liking is 1 - exp(-S/scale); the squashing is ours. Each view: a <- forgetting * a + 1_i; S is that of
    the update without forgetting. Draws nothing at random.
    """

    @dataclass
    class Params:
        direction: Literal["prior_post", "post_prior"] = setting("prior_post", "of the divergence")
        prior: float = setting(1.0, "pseudo-views of each percept", unit="observations", above=0)
        forgetting: float = setting(1.0, "what is kept of the belief at each view; 1 forgets nothing", above=0, high=1)
        scale: float = setting(0.1, "surprise that gives a liking of 0.63", unit="nats", above=0)
        persists: bool = setting(True, "keep the belief from one episode to the next")

    params: Params

    def memory(self) -> list[float]:
        return [self.params.prior] * self.bins

    def surprise(self, memory: list[float], percept: int) -> float:
        """S in nats."""
        return dirichlet_surprise(memory, percept, self.params.direction)

    def liking(self, memory: list[float], percept: int) -> float:
        return squash(self.surprise(memory, percept), self.params.scale)

    def observe(self, memory: list[float], percept: int) -> None:
        keep = self.params.forgetting
        if keep < 1.0:  # never below a thousandth of a view, where the divergence would grow without bound
            memory[:] = [max(1e-3, keep * a) for a in memory]
        memory[percept] += 1.0
