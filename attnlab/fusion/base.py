"""What a fusion is."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Any, Protocol

from attnlab.reading import Reading


class Named(Protocol):
    """What a fusion sees of a behaviour."""
    name: str


class Clocked(Protocol):
    """What a fusion may know of who commands: its behaviour, the period in force (machine cycles), and the command it
    holds, or None."""
    period: int
    command: tuple[float, float] | None

    @property
    def behaviour(self) -> Named: ...


class Fusion(ABC):
    """Combines the held commands; a robot without any stands still."""
    name: str
    interpreted = ""  # why it runs as Python alone, where it does not compile

    def __init__(self, params: Any, reading: Reading):
        self.params, self.reading = params, reading

    def attach(self, clocks: Sequence[Clocked]) -> None:
        """The robot is built; these are its clocks from now on, in the order in which they act."""

    @abstractmethod
    def fuse(self, commands: list[tuple[float, float]]) -> tuple[float, float]:
        """(v m/s, w rad/s) within [0, v_max] and [-w_max, w_max]. Pure."""
