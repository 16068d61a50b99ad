"""Checks of a model of curiosity."""

from __future__ import annotations

import math
import pickle
from random import Random
from typing import Any

from attnlab.curiosity.base import Curiosity
from attnlab.simulators.base import Blob
from attnlab.testing.build import make

ENERGIES = (0.0, 300.0, 3067.0, 3500.0, 4600.0, 5200.0)


class StillSenses:
    """Sonar rings drawn from a seed, one a cycle: what a model senses while it is checked."""

    def __init__(self, seed: int = 0):
        self.draw, self.cycle = Random(seed), 0
        self.look()

    def look(self) -> None:
        """The next cycle."""
        self.cycle += 1
        self._ring = [self.draw.uniform(0.3, 5.0) for _ in range(16)]

    def ring(self) -> list[float]:
        return list(self._ring)

    def front_distances(self) -> list[float]:
        return self._ring[:8]

    def blobs(self, kind: str) -> list[Blob]:
        return []

    def heading(self) -> float:
        return 0.0


def signals(name: str, settings: dict[str, Any], views: int = 300, restart: bool = False
            ) -> list[tuple[float, float, int, float]]:
    """(wanting, liking, level, reward) over random views; ``restart`` pickles the memory halfway."""
    curiosity: Curiosity = make("curiosity", name, **settings)
    draw, now = Random(7), StillSenses()
    curiosity.attach(now)
    memory, rows = curiosity.memory(), []
    for i in range(views):
        if restart and i == views // 2:
            memory = pickle.loads(pickle.dumps(memory))
        percept = int(draw.random() ** 2 * curiosity.bins)
        wanting = curiosity.wanting(memory, ENERGIES[i % len(ENERGIES)])
        liking = curiosity.liking(memory, percept)
        rows.append((wanting, liking, curiosity.level(wanting, liking), curiosity.mix(0.5, liking, wanting)))
        curiosity.observe(memory, percept)
        now.look()
    return rows


def bounds(name: str, **settings: Any) -> None:
    """Wanting and liking are within [0, 1], the level is one of ``levels``, the reward is finite."""
    levels = make("curiosity", name, **settings).levels
    assert levels and all(isinstance(level, str) for level in levels)
    for wanting, liking, level, reward in signals(name, settings):
        assert 0.0 <= wanting <= 1.0, f"{name}: wanting {wanting} is outside [0, 1]"
        assert 0.0 <= liking <= 1.0, f"{name}: liking {liking} is outside [0, 1]"
        assert isinstance(level, int) and 0 <= level < len(levels), f"{name}: level {level} is none of {levels}"
        assert math.isfinite(reward), f"{name}: reward {reward}"


def pure_reads(name: str, **settings: Any) -> None:
    """wanting, liking, level and mix change nothing: asked twice they answer the same, and the memory stays."""
    curiosity: Curiosity = make("curiosity", name, **settings)
    draw, now = Random(3), StillSenses()
    curiosity.attach(now)
    memory = curiosity.memory()
    for i in range(100):
        percept, energy = draw.randrange(curiosity.bins), ENERGIES[i % len(ENERGIES)]
        before = pickle.dumps(memory)
        asked = [[curiosity.wanting(memory, energy), curiosity.liking(memory, percept),
                  curiosity.level(1.0, 0.7), curiosity.mix(0.5, 0.7, 0.2)] for _ in range(2)]
        assert asked[0] == asked[1], f"{name}: asked twice, it answered {asked[0]}, then {asked[1]}"
        assert pickle.dumps(memory) == before, f"{name}: a read changed the memory; learn in observe"
        curiosity.observe(memory, percept)
        now.look()


def deterministic(name: str, **settings: Any) -> None:
    """The same views give the same signals."""
    assert signals(name, settings) == signals(name, settings), f"{name}: the same views gave other signals"


def serialisable(name: str, **settings: Any) -> None:
    """A memory that was pickled and read back goes on as if nothing had happened."""
    straight, restarted = signals(name, settings), signals(name, settings, restart=True)
    assert straight == restarted, f"{name}: a pickled memory went on otherwise"


def memories_apart(name: str, **settings: Any) -> None:
    """What one behaviour sees changes nothing of another's memory."""
    curiosity: Curiosity = make("curiosity", name, **settings)
    curiosity.attach(StillSenses())
    mine, other = curiosity.memory(), curiosity.memory()
    before = pickle.dumps(other)
    for percept in range(curiosity.bins):
        curiosity.observe(mine, percept)
    assert pickle.dumps(other) == before, f"{name}: two behaviours share a memory; keep no percepts on the object"


CHECKS = (bounds, pure_reads, deterministic, serialisable, memories_apart)
