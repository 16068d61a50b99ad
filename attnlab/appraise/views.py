"""What every model of curiosity makes of the same percepts."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from random import Random
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

from attnlab import registry
from attnlab.curiosity.base import CuriosityContext
from attnlab.equations import percept_bin
from attnlab.errors import ConfigError, nearest
from attnlab.logs.file import Log
from attnlab.logs.sonars import nearest_ahead, ring
from attnlab.reading import Reading
from attnlab.streams import stream

if TYPE_CHECKING:
    import pandas as pd

SONAR_RANGE_M = 5.0  # of a silent sonar
NOT_A_SIGNAL = ("composed", "additive")  # litman's, unless their settings say otherwise


@dataclass(frozen=True)
class View:
    """One look of one behaviour: percept from 0, energy in UoE, the pose (None in a probe), the sonar ring (m)."""
    behaviour: str
    cycle: int
    percept: int
    energy: float
    pose: tuple[float, float, float] | None = None
    ring: tuple[float, ...] | None = None


class Replayed:
    """The senses of a robot that is shown what it saw; sonars are read in the run's world at the recorded pose, and of
    the body the energy is known."""

    def __init__(self, simulator: Any = None):
        self.simulator, self.cycle = simulator, 0

    def show(self, view: View) -> None:
        self.view, self.cycle, self.body = view, view.cycle, SimpleNamespace(energy=view.energy)

    def ring(self) -> list[float]:
        from attnlab.simulators.robot import centre_distances
        if self.view.ring is not None:
            return list(self.view.ring)
        if self.simulator is None or self.view.pose is None:
            raise ConfigError("curiosity", "this model reads sonars, and these views hold none")
        self.simulator.place(*self.view.pose)
        return centre_distances(self.simulator.sonar())


def model(name: str, reading: Reading, now: Replayed) -> Any:
    """A model of curiosity with its default settings."""
    spec = registry.find("curiosity", name)
    if spec is None:
        raise registry.unknown("curiosity", name, "--curiosity")
    context = CuriosityContext(reading, reading.percept_bins, stream(0, "appraise", name))
    made = registry.make("curiosity", spec.nodes()[name], context)
    made.attach(now)
    return made


def appraise(views: Sequence[View], names: Sequence[str], reading: Reading, simulator: Any = None) -> pd.DataFrame:
    """A row for each view and model: behaviour, cycle, percept, curiosity, wanting, liking, level."""
    import pandas as pd
    rows = []
    for name in names:
        now = Replayed(simulator)
        memories: dict[str, Any] = {}
        curiosity = model(name, reading, now)
        for view in views:
            now.show(view)
            memory = memories.setdefault(view.behaviour, curiosity.memory())
            wanting = curiosity.wanting(memory, view.energy)
            liking = curiosity.liking(memory, view.percept)
            rows.append((view.behaviour, view.cycle, view.percept + 1, name, wanting, liking,
                         curiosity.levels[curiosity.level(wanting, liking)]))
            curiosity.observe(memory, view.percept)
    return pd.DataFrame(rows, columns=["behaviour", "cycle", "percept", "curiosity", "wanting", "liking", "level"])


def recorded(cycles: pd.DataFrame, behaviours: Sequence[str], energy_start: float,
             start: tuple[float, float, float]) -> Iterator[View]:
    """The views of an episode, in the order in which they came; energy and pose are those before the cycle."""
    energies = [energy_start, *cycles["energy"].tolist()[:-1]]
    poses = list(zip(cycles["x_m"], cycles["y_m"], cycles["heading_rad"], strict=True))
    poses = [start, *poses[:-1]]
    for i, cycle in enumerate(cycles["cycle"].tolist()):
        for name in behaviours:
            if cycles[f"{name}_active"].iat[i]:
                yield View(name, cycle, int(cycles[f"{name}_percept"].to_numpy()[i]) - 1, energies[i], poses[i])


def logged(log: Log, reading: Reading) -> Iterator[View]:
    """A view a scan of a log: AVOID's percept is the nearest of the eight frontal sonars, m from the log's sensor. A
    scan in which none of them heard anything valid is counted in the log's ledger."""
    low = reading.avoid_sigma_min_m if reading.percept_domain == "min_to_max" else 0.0
    high = reading.avoid_sigma_max_m
    for cycle, scan in enumerate(log):
        near = nearest_ahead(scan)
        if near is None:
            log.ledger.skip("scan in which no frontal sonar is valid", f"scan {cycle + 1}")
            continue
        percept = percept_bin(min(high, max(low, near)), low, high, reading.percept_bins)
        yield View("avoid", cycle, percept, reading.energy_start, scan.pose, tuple(ring(scan, SONAR_RANGE_M)))


def probes(bins: int, energy: float) -> dict[str, list[View]]:
    """Standard histories of 200 views. The sonar ring shows the same as the percept."""
    draw = Random(0)

    def views(percepts: list[int]) -> list[View]:
        rings = [(0.3 + 1.7 * p / max(1, bins - 1),) * 16 for p in range(bins)]
        return [View("probe", i, p, energy, ring=rings[p]) for i, p in enumerate(percepts)]
    return {"boredom": views([0] * 200), "a new object": views([0] * 100 + [bins - 1] * 100),
            "a noisy sonar": views([draw.randrange(bins) for _ in range(200)]),
            "a cycle": views([i % bins for i in range(200)])}


def chosen(text: str) -> list[str]:
    """Names of models from ``all`` or a list with commas."""
    known = [option for spec in registry.parts.values() if spec.group == "curiosity"
             for option in (spec.name, *spec.presets)]
    if text == "all":
        return sorted(set(known) - set(NOT_A_SIGNAL), key=lambda name: (name != "litman", name != "none", name))
    names = text.split(",")
    for name in names:
        if name not in known:
            raise ConfigError("--curiosity", f"no curiosity is called '{name}'", nearest(name, known))
    return names
