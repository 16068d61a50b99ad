"""Curiosity as prediction error, and the transition model that others build on."""

from __future__ import annotations

from dataclasses import dataclass

from attnlab.curiosity.base import Curiosity
from attnlab.registry import register
from attnlab.settings import setting


@dataclass
class Transitions:
    """What is believed of the next percept: ``p[last][next]``, rows sum to 1; ``last`` is -1 before the first."""
    p: list[list[float]]
    last: int = -1

    def error(self, percept: int) -> float:
        """1 - p(percept | last); at the first percept that of knowing nothing, 1 - 1/n."""
        return 1.0 - (self.p[self.last][percept] if self.last >= 0 else 1.0 / len(self.p))

    def learn(self, percept: int, rate: float) -> None:
        """p(. | last) <- (1 - rate) p(. | last) + rate 1_percept."""
        if self.last >= 0:
            row = self.p[self.last]
            for i in range(len(row)):
                row[i] *= 1.0 - rate
            row[percept] += rate
        self.last = percept


def unknowing(bins: int) -> Transitions:
    """Every next percept is as likely."""
    return Transitions([[1.0 / bins] * bins for _ in range(bins)])


@register("curiosity", "prediction_error")
class PredictionError(Curiosity):
    """Schmidhuber 1991 (Proc. SAB, p. 222), first form (1 - p as the error is ours): liking is the error 1 -
    p(percept | last percept) of a model of the behaviour's percepts that learns at ``rate``. A noisy percept stays
    interesting for ever: the flaw that ``learning_progress`` mends. Memory: :class:`Transitions`. Draws nothing at
    random."""

    @dataclass
    class Params:
        rate: float = setting(0.1, "learning rate of the model", above=0, high=1)
        persists: bool = setting(True, "keep the model from one episode to the next")

    params: Params

    def memory(self) -> Transitions:
        return unknowing(self.bins)

    def liking(self, memory: Transitions, percept: int) -> float:
        return memory.error(percept)

    def observe(self, memory: Transitions, percept: int) -> None:
        memory.learn(percept, self.params.rate)
