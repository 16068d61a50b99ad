"""What a fusion is."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any

from attnlab.reading import Reading


class Fusion(ABC):
    """Combines the held commands; a robot without any stands still."""
    name: str

    def __init__(self, params: Any, reading: Reading):
        self.params, self.reading = params, reading

    @abstractmethod
    def fuse(self, commands: list[tuple[float, float]]) -> tuple[float, float]:
        """(v m/s, w rad/s) within [0, v_max] and [-w_max, w_max]. Pure."""
