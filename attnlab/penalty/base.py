"""What a router of the penalty is."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Any

from attnlab.behaviours.base import Behaviour
from attnlab.errors import PartError
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


def check_shares(penalty: Penalty, cause: str, behaviours: Sequence[Behaviour]) -> list[float]:
    """What a router of the penalty answers: a share within [0, 1] for each. Raises :class:`PartError`."""
    shares = list(penalty.shares(cause, behaviours))
    if len(shares) != len(behaviours) or not all(0.0 <= share <= 1.0 for share in shares):
        raise PartError(penalty, f"gave the shares {shares} to {len(behaviours)} behaviours; each must be in [0, 1]")
    return shares
