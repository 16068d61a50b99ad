"""A run's configuration, checked, and the agent built from it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from attnlab import registry
from attnlab.attention import Attention
from attnlab.behaviours.base import BehaviourContext
from attnlab.curiosity.base import CuriosityContext
from attnlab.cycle import Agent
from attnlab.errors import ConfigError
from attnlab.exploration.base import Exploration
from attnlab.guards import blame
from attnlab.learners.base import LearnerContext
from attnlab.reading import Reading
from attnlab.settings import build, setting
from attnlab.simulators.base import Simulator, SimulatorContext
from attnlab.streams import stream
from attnlab.worlds.base import Layout


@dataclass
class ValidationSettings:
    simulator: str | None = setting(None, "validate on another simulator than the one trained on")
    drive: str | None = setting(None, "drive of the pybullet that validates", choices=(None, "kinematic", "wheels"))


@dataclass
class RunSettings:
    """Everything at the top of a config. Groups are mappings with the ``name`` of the chosen part."""
    seed: int = setting(0, "every draw of the run follows from it", low=0, high=2**63)
    train_episodes: int = setting(500, "episodes that learn", low=1, high=10**12)
    validation_episodes: int = setting(100, "episodes after them, without learning", low=0, high=10**12)
    max_cycles: int = setting(1150, "machine cycles an episode; follows the reading", unit="mc", low=1, high=10**7)
    periods: list[int] = setting([1, 4, 8, 12], "periods a clock may have", unit="mc", low=1, high=10_000)
    study: str = setting("main", "folder of the results inside outputs")
    outputs: str = setting("outputs", "root folder of all results")
    fresh: bool = setting(False, "run again what is complete already")
    record: str = setting("last", "episodes whose cycles are stored: the last one, all of validation, all, none",
                          choices=("none", "last", "validation", "all"))
    check_identities: bool = setting(True, "check the bookkeeping on every cycle")
    picture: bool = setting(True, "draw the study's figures at its end")
    report: bool = setting(True, "build the study's report at its end")
    claims_file: str = setting("dinocera2014", "claims the study is judged by; its hash is stored with a run")
    variants: Any = setting(None, "settings that are swept together: {name: {setting: value, ...}, ...}, or "
                            "{design: multiverse, size: 64, seed: 0}")
    labels: dict = setting({}, "names of conditions in tables and figures, e.g. {litman: CR, none: NCR}")
    validation: ValidationSettings = setting(ValidationSettings(), "how validation differs from training")
    reading: dict = setting({}, "how the paper's open points are read")
    simulator: dict = setting({}, "")
    world: dict = setting({}, "")
    behaviours: dict = setting({}, "")
    needs: dict = setting({}, "")
    fusion: dict = setting({}, "")
    curiosity: dict = setting({}, "")
    learner: dict = setting({}, "")
    exploration: dict = setting({}, "")
    cluster: dict = setting({}, "where a sweep runs")

    def __post_init__(self):
        if len(set(self.periods)) != len(self.periods) or not self.periods:
            raise ConfigError("periods", f"{self.periods} must be different whole numbers, at least one")
        for name in ("study",):
            value = getattr(self, name)
            if not value or any(c in value for c in "/\\\0\n") or value.startswith("."):
                raise ConfigError(name, f"{value!r} cannot be the name of a folder")


NOT_IN_KEY = ("study", "outputs", "fresh", "picture", "report", "claims_file", "variants", "labels",
              "cluster")  # change no number


class Experiment:
    """A checked run: constructing one finds every error that can be found before anything runs.

    Raises :class:`ConfigError` naming the setting.
    """

    def __init__(self, config: Mapping[str, Any]):
        self.config = config
        self.settings: RunSettings = build(RunSettings, config, "")
        s = self.settings
        reading = {k: v for k, v in s.reading.items() if k != "name"}
        sources = getattr(registry.build_params("world", s.world, "world")[1], "sources", None)
        reading |= {"max_cycles": s.max_cycles, **(sources.of_reading() if sources else {})}
        self.reading: Reading = build(Reading, reading, "reading")
        self.layout = self._layout()
        if not s.behaviours:
            raise ConfigError("behaviours", "there are none", "behaviours=[avoid,eat,drink]")
        for group in ("needs", "fusion", "curiosity", "learner", "exploration"):
            registry.build_params(group, getattr(s, group), group)
        registry.get("penalty", {"name": self.reading.penalised}, "reading.penalised")
        for name, node in s.behaviours.items():
            registry.build_params("behaviours", node, f"behaviours.{name}")
        self.simulator_spec = registry.build_params("simulator", s.simulator, "simulator")
        self.validation_spec = self._validation_spec()
        self.found: dict = {}  # settings of the learner found offline, see Learner.prepare
        self._try_parts()

    def prepare(self, folder: Path | None) -> None:
        """What a learner does before the run."""
        spec = registry.get("learner", self.settings.learner, "learner")
        self.found = spec.cls.prepare(self, folder)

    def _layout(self) -> Layout:
        try:
            return registry.make("world", self.settings.world, None).build(self.settings.seed)
        except ConfigError as error:
            if error.setting.startswith("world"):
                raise
            name = self.settings.world.get("name")
            raise ConfigError(f"world={name}", f"{error.setting}: {error.problem}", error.hint) from None

    def _validation_spec(self):
        chosen = self.settings.validation
        if chosen.simulator is None and chosen.drive is None:
            return None
        node = dict(self.settings.simulator)
        if chosen.simulator is not None:
            shared = {k: v for k, v in node.items() if k in ("sonar_range_m", "camera_columns", "camera_rows",
                                                              "camera_fov_deg")}
            node = {"name": chosen.simulator, **shared}
        if chosen.drive is not None:
            node["drive"] = chosen.drive
        return registry.build_params("simulator", node, "validation.simulator")

    def _try_parts(self) -> None:
        """Construct everything that is cheap, so that a part's own complaint comes before the first run."""
        try:
            agent = self.agent(simulator=_NoSimulator())
        except ConfigError:
            raise
        except Exception as cause:
            raise ConfigError(blame(cause), registry.describe(cause), "The part could not be constructed") from cause
        simulator = self.simulator_spec[0].name
        for attention in agent.attentions:
            for need in attention.behaviour.feels:
                if need not in agent.body.index:
                    raise ConfigError(f"behaviours.{attention.behaviour.name}", f"nobody brings a need called '{need}'",
                                      f"needs={self.settings.needs['name']} has none such: needs=survival, or leave "
                                      f"{attention.behaviour.name} out")
            works_in = attention.behaviour.simulators
            if works_in and simulator not in works_in:
                raise ConfigError(f"behaviours.{attention.behaviour.name}", f"does not work in simulator={simulator}",
                                  f"simulator={works_in[0]}")

    def simulator(self, validation: bool = False) -> Simulator:
        """A new simulator; the caller closes it."""
        spec, params = (validation and self.validation_spec) or self.simulator_spec
        r = self.reading
        part = spec.cls(params, SimulatorContext(self.layout, r.dt_s, r.max_cycles,
                                                 r.safety_distance_m if r.crash == "safety_distance" else None))
        part.name = spec.name
        return part

    def agent(self, simulator: Simulator) -> Agent:
        """The robot with fresh tables."""
        s, r = self.settings, self.reading
        curiosity = registry.make("curiosity", s.curiosity,
                                  CuriosityContext(r, r.percept_bins, stream(s.seed, "curiosity")))
        attentions, own_needs = [], []
        for name, node in s.behaviours.items():
            behaviour = registry.make("behaviours", node, BehaviourContext(r, stream(s.seed, "behaviour", name)),
                                      f"behaviours.{name}")
            behaviour.name = name
            own_needs += behaviour.needs()
            learner = registry.make("learner", {**s.learner, **self.found}, LearnerContext(
                r, name, curiosity.levels, s.periods, r.percept_bins, stream(s.seed, "learner", name)))
            attentions.append(Attention(behaviour, s.periods, curiosity, learner, r,
                                        stream(s.seed, "exploration", name)))
        body = registry.make("needs", s.needs, r).body(own_needs)
        fusion = registry.make("fusion", s.fusion, r)
        penalty = registry.make("penalty", {"name": r.penalised}, r, "reading.penalised")
        return Agent(attentions, body, simulator, fusion, penalty, r.max_cycles)

    def exploration(self, phase: str) -> Exploration:
        """How actions are chosen in this phase (train | validation)."""
        node = self.settings.exploration
        if phase == "validation" and self.reading.validation_exploration == "greedy":
            node = {"name": "greedy"}
        return registry.make("exploration", node, None)

    def start_pose(self, phase: str, episode: int) -> tuple[float, float, float]:
        """Where an episode starts: from the seed alone, so that all conditions share it."""
        if self.reading.start_pose == "fixed":
            return self.layout.steady_start
        return self.layout.random_start(stream(self.settings.seed, "start", phase, episode))


class _NoSimulator:
    """Stands in for a simulator while parts are only constructed."""
    cycle = 0
