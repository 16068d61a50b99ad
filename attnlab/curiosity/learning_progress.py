"""Curiosity as learning progress."""

from __future__ import annotations

from dataclasses import dataclass

from attnlab.arithmetic import total
from attnlab.curiosity.base import Curiosity
from attnlab.curiosity.prediction_error import Transitions, unknowing
from attnlab.registry import register
from attnlab.settings import setting


@dataclass
class Memory:
    """The model, and the last errors of each cell, the oldest first: as many as are ``known``, then room."""
    model: Transitions
    errors: list[list[float]]
    known: list[int]


@register("curiosity", "learning_progress")
class LearningProgress(Curiosity):
    """Oudeyer & Kaplan 2007 (Front. Neurorobot. 1:6), after Schmidhuber 1991 (Proc. IJCNN 2:1458), who compares the
    error before and after one update: liking is how much the prediction error has fallen, gain * max(0, <e>(t - delay)
    - <e>(t)), at most 1 (gain and limit are ours), where <e> is the mean of ``window`` errors.

    One history of errors for each percept (a cell of the sensory space): that of predicting what followed it. What is
    known and what cannot be known are both boring. Memory: :class:`Memory`. Draws nothing at random.
    """

    @dataclass
    class Params:
        rate: float = setting(0.1, "learning rate of the model", above=0, high=1)
        window: int = setting(10, "errors that are averaged", unit="observations", low=1, high=10_000)
        delay: int = setting(10, "how far back it is compared", unit="observations", low=1, high=10_000)
        gain: float = setting(4.0, "liking for each unit of progress", above=0)
        persists: bool = setting(True, "keep the model from one episode to the next")

    params: Params

    def memory(self) -> Memory:
        room = self.params.window + self.params.delay
        return Memory(unknowing(self.bins), [[0.0] * room for _ in range(self.bins)], [0] * self.bins)

    def progress(self, errors: list[float]) -> float:
        """<e>(t - delay) - <e>(t) of one cell; 0 until there are window + delay errors."""
        p = self.params
        if len(errors) < p.window + p.delay:
            return 0.0
        then = errors[-p.window - p.delay:len(errors) - p.delay]
        return (total(then) - total(errors[-p.window:])) / p.window

    def liking(self, memory: Memory, percept: int) -> float:
        return min(1.0, max(0.0, self.params.gain * self.progress(memory.errors[percept][:memory.known[percept]])))

    def observe(self, memory: Memory, percept: int) -> None:
        model, cell = memory.model, memory.model.last
        if cell >= 0:
            errors = memory.errors[cell]
            if memory.known[cell] == len(errors):
                errors[:-1] = errors[1:]
            else:
                memory.known[cell] += 1
            errors[memory.known[cell] - 1] = model.error(percept)
        model.learn(percept, self.params.rate)
