"""What a probe is, and what it is shown of an episode."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from attnlab.attention import Activation
from attnlab.errors import PartError
from attnlab.reading import Reading
from attnlab.tables.schema import SCHEMA, Column
from attnlab.worlds.base import Layout

Values = npt.NDArray[np.float64]
TYPES = ("bool", "int32", "int64", "float64", "string")


@dataclass(frozen=True)
class Lived:
    """An episode that was lived, for those who watch. Arrays are read-only.

    ``cycles`` n; ``death``: the cause, or None; ``path`` (n + 1, 3): pose (x m, y m, heading rad) at the start and
    after each cycle; ``energy``, ``wanting``, ``safety`` and ``safety_held`` (from the true distance, from AVOID's
    last percept; None where nobody answers for crashes) and each of ``needs`` (n,): after each cycle; ``looks``: every
    activation, by behaviour.
    """
    phase: str
    episode: int
    cycles: int
    max_cycles: int
    death: str | None
    path: Values
    energy: Values
    wanting: Values
    safety: Values | None
    safety_held: Values | None
    needs: Mapping[str, Values]
    looks: Mapping[str, tuple[Activation, ...]]


@dataclass(frozen=True)
class ProbeContext:
    """What a probe is built from."""
    reading: Reading
    layout: Layout


class Probe(ABC):
    """Adds columns to a table, computed when an episode has ended. It reads no sensor and changes nothing.

    ``table``: episodes (a value an episode), behaviours (a value a behaviour: {name: value}) or cycles (an array (n,)).
    ``columns``: type, unit and meaning of each, by name.
    """
    name: str
    table: Literal["episodes", "behaviours", "cycles"] = "episodes"
    columns: Mapping[str, Column]

    def __init__(self, params: Any, context: ProbeContext):
        self.params, self.reading, self.layout = params, context.reading, context.layout

    @abstractmethod
    def measure(self, lived: Lived) -> Mapping[str, Any]:
        """The value of each column. Pure."""

    @classmethod
    def check_declared(cls) -> None:
        """Raise TypeError unless the columns are declared and new. Called when the probe is registered."""
        columns = getattr(cls, "columns", None)
        if cls.table not in ("episodes", "behaviours", "cycles"):
            raise TypeError(f"{cls.__name__}.table is {cls.table!r}, must be episodes, behaviours or cycles")
        if not isinstance(columns, Mapping) or not columns:
            raise TypeError(f"{cls.__name__} declares no columns: columns = {{name: Column(type, unit, meaning)}}")
        for name, column in columns.items():
            if not isinstance(column, Column) or column.type not in TYPES:
                raise TypeError(f"{cls.__name__}.columns: {name} must be a Column of type {', '.join(TYPES)}")
            if name in SCHEMA[cls.table] or not str(name).isidentifier():
                raise TypeError(f"{cls.__name__}.columns: {name} is a column of {cls.table} already, or no name of one")

    def checked(self, lived: Lived) -> dict[str, Any]:
        """What :meth:`measure` says, if it is what was declared. Raises :class:`PartError`."""
        found = dict(self.measure(lived))
        if set(found) != set(self.columns):
            raise PartError(self, f"measured {', '.join(sorted(found))}; it declares {', '.join(self.columns)}")
        for name, value in found.items():
            if self.table == "cycles" and len(value) != lived.cycles:
                raise PartError(self, f"gave {len(value)} values of {name} for {lived.cycles} cycles")
            if self.table == "behaviours" and set(value) != set(lived.looks):
                raise PartError(self, f"gave {name} for {', '.join(value)}; the robot has {', '.join(lived.looks)}")
        return found
