"""A curiosity with a rhythm."""

from dataclasses import dataclass

from attnlab.api import Curiosity, register, setting


@register("curiosity", "weekly")
class Weekly(Curiosity):
    """Every n-th look is liked, whatever is seen. Memory: [looks]. Draws nothing at random."""

    @dataclass
    class Params:
        every: int = setting(7, "looks from one liking to the next", unit="observations", low=1)

    def memory(self):
        return [0]

    def liking(self, memory, percept):
        return 1.0 if memory[0] % self.params.every == 0 else 0.0

    def observe(self, memory, percept):
        memory[0] += 1
