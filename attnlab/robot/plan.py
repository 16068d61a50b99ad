"""A run that was checked: its settings, its world, and the agent built from them."""

from __future__ import annotations

import copy
import dataclasses
from collections.abc import Mapping
from typing import Any

from attnlab import registry
from attnlab.attention import Attention
from attnlab.behaviours.base import BehaviourContext
from attnlab.config import RunSettings, layout_of, reading_of
from attnlab.curiosity.base import CuriosityContext
from attnlab.cycle import Agent
from attnlab.errors import ConfigError, describe
from attnlab.exploration.base import Exploration
from attnlab.learners.base import LearnerContext, Rehearse
from attnlab.reading import Reading
from attnlab.robot.guards import blame
from attnlab.settings import build
from attnlab.simulators.base import Simulator, SimulatorContext
from attnlab.streams import stream
from attnlab.worlds.base import Layout


class RunPlan:
    """A run to be: constructing one finds every error that can be found before anything runs.

    Raises :class:`ConfigError` naming the setting.
    """

    def __init__(self, config: Mapping[str, Any]):
        self.config = config
        self.settings: RunSettings = build(RunSettings, config, "")
        s = self.settings
        self.reading: Reading = reading_of(s)
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

    def with_seed(self, seed: int) -> RunPlan:
        """The same run with another seed. What hangs on the seed is checked again: its range and its world."""
        plan = copy.copy(self)
        plan.config = {**self.config, "seed": seed}
        plan.settings = dataclasses.replace(self.settings, seed=build(RunSettings, {"seed": seed}, "").seed)
        plan.layout, plan.found = plan._layout(), {}
        return plan

    def prepare(self, play: Rehearse) -> None:
        """What a learner does before the run."""
        spec, params = registry.build_params("learner", self.settings.learner, "learner")
        self.found = spec.cls.prepare(params, play)

    def _layout(self) -> Layout:
        try:
            return layout_of(self.settings.world, self.settings.seed)
        except ConfigError:
            raise
        except Exception as cause:
            raise ConfigError(blame(cause), describe(cause), "The world could not be built") from cause

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
            raise ConfigError(blame(cause), describe(cause), "The part could not be constructed") from cause
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

    def agent(self, simulator: Simulator, learner: Mapping[str, Any] | None = None) -> Agent:
        """The robot with fresh tables; ``learner``: another one than that of the config, with its settings."""
        s, r = self.settings, self.reading
        chosen = learner or {**s.learner, **self.found}
        curiosity = registry.make("curiosity", s.curiosity,
                                  CuriosityContext(r, r.percept_bins, stream(s.seed, "curiosity")))
        attentions, own_needs = [], []
        for name, node in s.behaviours.items():
            behaviour = registry.make("behaviours", node, BehaviourContext(r, stream(s.seed, "behaviour", name)),
                                      f"behaviours.{name}")
            behaviour.name = name
            own_needs += behaviour.needs()
            learns = registry.make("learner", chosen, LearnerContext(
                r, name, curiosity.levels, s.periods, r.percept_bins, stream(s.seed, "learner", name)))
            attentions.append(Attention(behaviour, s.periods, curiosity, learns, r,
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
