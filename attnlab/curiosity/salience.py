"""Curiosity for salient events that were not expected."""

from __future__ import annotations

from dataclasses import dataclass

from attnlab.curiosity.base import Curiosity
from attnlab.curiosity.prediction_error import Transitions, unknowing
from attnlab.registry import register
from attnlab.settings import setting


@register("curiosity", "salience")
class Salience(Curiosity):
    """Singh, Barto & Chentanez 2004 (NIPS 17): on a salient event, liking 1 - p(percept | last percept) under a
    learned one-step model (theirs: the event's option model); 0 otherwise. An event is a change by at least ``jump``
    percepts (theirs: a light or a sound changes; that a jump of the percept stands for it is ours). Memory:
    :class:`Transitions`. Draws nothing at random."""

    @dataclass
    class Params:
        jump: int = setting(1, "change of the percept that is an event", unit="bins", low=1)
        rate: float = setting(0.1, "learning rate of the model", above=0, high=1)
        persists: bool = setting(True, "keep the model from one episode to the next")

    def memory(self) -> Transitions:
        return unknowing(self.bins)

    def liking(self, memory: Transitions, percept: int) -> float:
        if memory.last < 0 or abs(percept - memory.last) < self.params.jump:
            return 0.0
        return memory.error(percept)

    def observe(self, memory: Transitions, percept: int) -> None:
        memory.learn(percept, self.params.rate)
