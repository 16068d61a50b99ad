"""What a way to decide when to look did on a small decision process: a table that no robot made."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from attnlab.errors import ConfigError, nearest
from attnlab.measures.base import CannotMeasure, Measure
from attnlab.registry import register
from attnlab.results.conditions import Runs
from attnlab.settings import setting

INF = float("inf")
QUANTITIES: dict[str, tuple[str, tuple[float, float]]] = {  # unit, the least and the most it can be
    "area": ("1", (0.0, 1.0)), "decisions": ("decisions", (1.0, INF)), "measurements": ("looks", (0.0, INF)),
    "error": ("1", (0.0, INF)),
    **{name: ("UoR", (-INF, INF)) for of in ("", "_all") for name in (f"costed_return{of}", f"free_return{of}",
                                                                       f"return{of}")}}


class ToyRuns(Runs):
    """The seeds of one way on one toy, as a measure is given runs: seed -> quantity -> value."""

    def __init__(self, where: Mapping[str, Any], values: Mapping[int, Mapping[str, float]]):
        self.where, self.values = dict(where), dict(values)
        self.runs = {seed: f"{' '.join(map(str, self.where.values()))} {seed}" for seed in self.values}

    def config(self, seed: int) -> dict[str, Any]:
        return dict(self.where)


@register("measure", "toy")
class Toy(Measure):
    """A quantity of the table that ``python -m attnlab.toys`` makes, on the toy that the role names: ``area`` and
    ``decisions`` (TempoRL's grids), ``costed_return``, ``free_return`` (without the cost) and ``measurements`` (AMRL's
    chains), ``return`` and ``error`` (what a model or a value is off); with ``_all`` a return is that of all
    episodes, else of the last."""

    @dataclass
    class Params:
        quantity: str = setting("area", "which")

        def __post_init__(self) -> None:
            if self.quantity not in QUANTITIES:
                raise ConfigError("quantity", f"there is no '{self.quantity}'", nearest(self.quantity, QUANTITIES))

    def __init__(self, params: Any, context: Any = None):
        super().__init__(params, context)
        self.unit, self.bounds = QUANTITIES[params.quantity]

    def of(self, runs: Runs) -> Mapping[int, float]:
        if not isinstance(runs, ToyRuns):
            raise CannotMeasure("needs the table of python -m attnlab.toys, robots do not play toys")
        name = self.params.quantity
        found = {seed: of[name] for seed, of in runs.values.items() if name in of}
        if not found:
            raise CannotMeasure(f"{' '.join(map(str, runs.where.values()))} has no {name}")
        return found
