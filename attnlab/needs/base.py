"""Needs, energy and the sources that satisfy them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, inf
from typing import Any

from attnlab.arithmetic import total
from attnlab.equations import energy_after_cycle, need_after_cycle
from attnlab.reading import Reading


@dataclass(frozen=True)
class Need:
    """A need that grows by ``per_activation`` for each active behaviour and ``per_cycle`` each cycle (UoE).

    ``death_at``: the robot dies when it reaches this; None if never. ``feeds_energy``: is what satisfies it energy?
    ``unit``: of its value, for tables and figures.
    """
    name: str
    start: float
    per_activation: float
    per_cycle: float = 0.0
    death_at: float | None = None
    feeds_energy: bool = False
    unit: str = "UoE"


class Larder:
    """How much was taken from each source (by index of its solid), and when an empty one fills again.

    ``following``: where what ran dry in a source appears next, if sources wander; nothing otherwise.
    """
    following: list[int]
    _empty_first: list[int]

    def __init__(self, reading: Reading):
        self.reading = reading
        self.eaten, self.full_again = [0], [0]
        self.following, self._empty_first = [], []

    def start(self) -> None:
        """All are full; of sources that wander the first place of each kind alone."""
        for solid in range(len(self.eaten)):
            self.eaten[solid] = self.full_again[solid] = 0
        for solid in self._empty_first:
            self.full_again[solid] = self.reading.max_cycles + 1

    def wander(self, kinds: Sequence[str]) -> None:
        """With ``reading.food_supply=wandering``: the ``kinds`` of all solids, in whose order a source goes from place
        to place of its kind."""
        if self.reading.food_supply != "wandering":
            return
        self.reserve(len(kinds))
        places = {kind: [i for i, other in enumerate(kinds) if other == kind] for kind in kinds}
        after = {a: b for same in places.values() for a, b in zip(same, [*same[1:], same[0]], strict=True)}
        self.following = [after[i] for i in range(len(kinds))]
        self._empty_first = [i for same in places.values() for i in same[1:]]
        self.start()

    def reserve(self, solids: int) -> None:
        """Make room for so many solids."""
        more = solids - len(self.eaten)
        self.eaten += [0] * more
        self.full_again += [0] * more

    def has(self, solid: int, cycle: int) -> bool:
        """Is there anything left in this source?"""
        return (self.reading.food_supply == "endless" or solid >= len(self.full_again)
                or cycle >= self.full_again[solid])

    def take(self, solid: int, cycle: int) -> None:
        """One meal from this source."""
        r = self.reading
        if r.food_supply == "endless":
            return
        if solid >= len(self.eaten):
            self.reserve(solid + 1)
        self.eaten[solid] += 1
        if self.eaten[solid] % r.food_portions == 0:
            respawns = r.food_supply == "respawn"
            self.full_again[solid] = cycle + r.food_respawn_cycles if respawns else r.max_cycles + 1
            if r.food_supply == "wandering" and len(self.following):
                self.full_again[self.following[solid]] = cycle


class Body:
    """Energy and needs of one robot during one episode.

    ``values`` are the needs in the order of ``needs``; ``energy`` is E(t), UoE; ``meals`` counts what was consumed.
    """
    needs: list[Need]
    names: list[str]
    values: list[float]
    meals: list[int]
    _limits: list[float]
    _eaten: list[float]

    def __init__(self, needs: list[Need], energy_start: float, e_u: float, e_nb: float, reading: Reading):
        self.needs, self.reading = needs, reading
        self.names = [need.name for need in needs]
        self.index = {name: i for i, name in enumerate(self.names)}
        self.e_u, self.e_nb, self.energy_start = e_u, e_nb, energy_start
        self.energy = energy_start
        self.dead = False
        self._limits = [inf if need.death_at is None else float(need.death_at) for need in needs]
        self._energy_floor = reading.energy_min if reading.energy_death else -inf
        self._ceiling = reading.energy_max if reading.energy_clipped else inf
        self._floored = reading.needs_floored
        self.values = [float(need.start) for need in needs]
        self.meals = [0] * len(needs)
        self.larder = Larder(reading)
        self._eaten = [0.0] * len(needs)
        self.start()

    def start(self) -> None:
        """The state at the start of an episode."""
        if not self.reading.energy_carry_over or self.dead:  # carried over, the energy of a dead robot kills the next
            self.energy = self.energy_start
        self.dead = False
        for i, need in enumerate(self.needs):
            self.values[i], self.meals[i], self._eaten[i] = need.start, 0, 0.0
        self._ate = False
        self.larder.start()

    def place(self, name: str) -> int:
        """The index of a need."""
        return self.index[name]

    def consume(self, name: str, amount: float) -> None:
        """Something satisfies this need by ``amount`` UoE in this cycle."""
        i = self.place(name)
        self._eaten[i] += amount
        self.meals[i] += 1
        self._ate = True

    def until_death(self, active: int, cycles: int) -> int:
        """How many of the next ``cycles`` (the first with ``active`` behaviours, then none) the robot lives,
        counting the one it dies in."""
        eaten = self._eaten
        for i, need in enumerate(self.needs):
            if self._limits[i] == inf:
                continue
            grown = need_after_cycle(self.values[i], need.per_activation, active, eaten[i])
            left = self._limits[i] - self._floor(grown)
            if left - need.per_cycle <= 0:
                return 1
            if need.per_cycle > 0:
                cycles = min(cycles, ceil(left / need.per_cycle))
        if self._energy_floor > -inf:
            fed = total([eaten[i] for i, need in enumerate(self.needs) if need.feeds_energy])
            left = self._clip(energy_after_cycle(self.energy, 0.0, self.e_nb, active, fed)) - self._energy_floor
            if left - self.e_u < 0:
                return 1
            if self.e_u > 0:
                cycles = min(cycles, int(left / self.e_u) + 1)
        return cycles

    def live(self, active: int, cycles: int) -> str | None:
        """Eqs 5, 6 and 10 over ``cycles`` cycles, the first with ``active`` behaviours; the cause of death, or None."""
        values, eaten = self.values, self._eaten
        fed = 0.0
        for i, need in enumerate(self.needs):
            grown = need_after_cycle(values[i], need.per_activation, active, eaten[i])
            values[i] = self._floor(grown) + need.per_cycle * cycles
            if need.feeds_energy:
                fed += eaten[i]
        if self._ceiling == inf:
            self.energy = energy_after_cycle(self.energy, self.e_u * cycles, self.e_nb, active, fed)
        else:
            self.energy = self._clip(energy_after_cycle(self.energy, 0.0, self.e_nb, active, fed)) - self.e_u * cycles
        if self._ate:
            for i in range(len(eaten)):
                eaten[i] = 0.0
            self._ate = False
        for i, need in enumerate(self.needs):
            if values[i] >= self._limits[i]:
                return need.name
        if self.energy < self._energy_floor:
            return "energy"
        return None


    def _clip(self, energy: float) -> float:
        """Energy at what there can be of it (``reading.energy_clipped``), before the cycle takes its share."""
        return min(energy, self._ceiling)

    def _floor(self, need: float) -> float:
        """A need at what there can be of it (``reading.needs_floored``)."""
        return max(0.0, need) if self._floored else need


class Needs(ABC):
    """Builds the body of a robot."""
    name: str
    interpreted = ""  # why it runs as Python alone, where it does not compile

    def __init__(self, params: Any, reading: Reading):
        self.params, self.reading = params, reading

    @abstractmethod
    def body(self, more: list[Need]) -> Body:
        """A body with this part's needs and ``more``, those that behaviours bring."""
