"""The last percepts of a behaviour."""

from __future__ import annotations


class Window:
    """The last ``length`` of the percepts that were added (0 to ``bins`` - 1); ``visits``: how often each is in it."""

    def __init__(self, length: int, bins: int):
        self.last, self.at = [-1] * length, 0  # a ring: at ``at`` the oldest, -1 while it is not full
        self.visits = [0] * bins

    def clear(self) -> None:
        """Forget all."""
        for i in range(len(self.last)):
            self.last[i] = -1
        for i in range(len(self.visits)):
            self.visits[i] = 0
        self.at = 0

    def oldest(self) -> int:
        """The one that the next pushes out; -1 if there is room."""
        return self.last[self.at]

    def seen(self) -> list[int]:
        """Its percepts, the oldest first."""
        return [percept for percept in (*self.last[self.at:], *self.last[:self.at]) if percept >= 0]

    def add(self, percept: int) -> None:
        """See this percept."""
        old = self.last[self.at]
        if old >= 0:
            self.visits[old] -= 1
        self.visits[percept] += 1
        self.last[self.at] = percept
        self.at = (self.at + 1) % len(self.last)
