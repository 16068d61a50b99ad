"""What a router of the penalty is."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Any

from attnlab.behaviours.base import Behaviour
from attnlab.reading import Reading


class Penalty(ABC):
    """Says who is penalised when the robot dies; chosen by ``reading.penalised``."""
    name: str

    def __init__(self, params: Any, reading: Reading):
        self.params, self.reading = params, reading

    @abstractmethod
    def shares(self, cause: str, behaviours: Sequence[Behaviour]) -> list[float]:
        """For each behaviour the share of ``reading.penalty`` it gets, in [0, 1]; 0 is no penalty, and nothing learned
        from the death. ``cause``: ``crash`` or the name of a need. Pure."""
