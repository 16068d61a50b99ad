"""A run that was checked: its settings, its world, and the agent built from them."""

from __future__ import annotations

import copy
import dataclasses
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, cast

from attnlab import registry
from attnlab.attention import Attention
from attnlab.callbacks.base import Callback
from attnlab.config import RunSettings, layout_of, reading_of
from attnlab.curiosity.base import Curiosity
from attnlab.cycle import Agent
from attnlab.errors import ConfigError, describe
from attnlab.exploration.base import Exploration
from attnlab.learners.base import Learner, Rehearse
from attnlab.probes.base import Probe
from attnlab.reading import Reading
from attnlab.robot.agents import saved
from attnlab.robot.contexts import Making, NoSimulator, look_of
from attnlab.robot.guards import blame
from attnlab.robot.recorded import check_recorded, is_recorded, settled
from attnlab.settings import build
from attnlab.simulators.base import Simulator
from attnlab.streams import stream
from attnlab.tables.schema import Column, columns_of
from attnlab.worlds.base import Layout


class RunPlan:
    """A run to be: constructing one finds every error that can be found before anything runs.

    Raises :class:`ConfigError` naming the setting.
    """

    def __init__(self, config: Mapping[str, Any]):
        self.config = config = settled(config)
        self.settings: RunSettings = build(RunSettings, config, "")
        s = self.settings
        self.reading: Reading = reading_of(s)
        self.layout = self._layout()
        if not s.behaviours:
            raise ConfigError("behaviours", "there are none", "behaviours=[avoid,eat,drink]")
        for group in ("needs", "fusion", "curiosity", "learner", "exploration"):
            registry.build_params(group, getattr(s, group), group)
        registry.get("penalty", {"name": self.reading.penalised}, "reading.penalised")
        for group in ("behaviours", "probe", "callback"):
            for name, node in getattr(s, group).items():
                registry.build_params(group, node, f"{group}.{name}")
        self.simulator_spec = registry.build_params("simulator", s.simulator, "simulator")
        self.recorded = is_recorded(self.simulator_spec[0])
        self.validation_spec = self._validation_spec()
        self.needs: dict[str, str] = {}  # unit by need
        self.found: dict[str, Any] = {}  # settings of the learner found offline, see Learner.prepare
        self.start = None if s.start_from is None else saved(s.start_from)
        self._try_parts()

    def with_seed(self, seed: int) -> RunPlan:
        """The same run with another seed. What hangs on the seed is checked again: its range and its world."""
        plan = copy.copy(self)
        plan.config = {**self.config, "seed": seed}
        plan.settings = dataclasses.replace(self.settings, seed=build(RunSettings, {"seed": seed}, "").seed)
        plan.layout, plan.found = plan._layout(), {}
        return plan

    def prepare(self, play: Rehearse) -> None:
        """What a learner does before the run; one that goes on from another run did it there."""
        if self.start is not None:
            return
        spec, params = registry.build_params("learner", self.settings.learner, "learner")
        learner: type[Learner] = spec.cls
        self.found = learner.prepare(params, play)

    def _layout(self) -> Layout:
        try:
            return layout_of(self.settings.world, self.settings.seed)
        except ConfigError:
            raise
        except Exception as cause:
            raise ConfigError(blame(cause), describe(cause), "The world could not be built") from cause

    def _validation_spec(self) -> tuple[registry.Spec, Any] | None:
        chosen = self.settings.validation
        if chosen.simulator is None and chosen.drive is None:
            return None
        other = registry.find("simulator", chosen.simulator or "")
        if self.recorded or (other is not None and is_recorded(other)):
            raise ConfigError("validation.simulator" if chosen.simulator else "validation.drive", "what was recorded "
                              "is trained and validated on in blocks of its own", "simulator.held_out=odd")
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
            agent = self.parts_alone()
            self.callbacks()
            self._check_probes(self.probes())
        except ConfigError:
            raise
        except Exception as cause:
            raise ConfigError(blame(cause), describe(cause), "The part could not be constructed") from cause
        self.needs = {need.name: need.unit for need in agent.body.needs}
        simulator = self.simulator_spec[0].name
        if self.recorded:
            self.simulator().close()
            check_recorded(agent, simulator, self.reading.max_cycles)
        for attention in agent.attentions:
            if attention.learner.needs_between:
                raise ConfigError("learner", f"'{attention.learner.name}' asks for the percepts between looks, which a "
                                  "robot that does not look has not", "Only a log can give them: see docs/arena.md")
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
        part: Simulator = spec.cls(params, self.making().context("simulator", spec.name))
        part.name = spec.name
        return part

    def agent(self, simulator: Simulator, learner: Mapping[str, Any] | None = None) -> Agent:
        """The robot with fresh tables; ``learner``: another one than that of the config, with its settings."""
        s, r = self.settings, self.reading
        chosen = learner or {**s.learner, **self.found}
        making = self.making()
        curiosity = registry.make("curiosity", s.curiosity, making.context("curiosity", s.curiosity["name"]))
        clamp = -1 if learner else self._clamp(curiosity)  # candidates that are tried before the run have none
        attentions, own_needs = [], []
        for name, node in s.behaviours.items():
            behaviour = registry.make("behaviours", node, making.context("behaviours", name), f"behaviours.{name}")
            behaviour.name = name
            own_needs += behaviour.needs()
            of_it = dataclasses.replace(making, levels=curiosity.levels, behaviour=name)
            learns = registry.make("learner", chosen, of_it.context("learner", name))
            attentions.append(Attention(behaviour, s.periods, curiosity, learns, r,
                                        stream(s.seed, "exploration", name), clamp))
        body = registry.make("needs", s.needs, r).body(own_needs)
        fusion = registry.make("fusion", s.fusion, r)
        penalty = registry.make("penalty", {"name": r.penalised}, r, "reading.penalised")
        agent = Agent(attentions, body, simulator, fusion, penalty, r.max_cycles)
        for attention in attentions:
            attention.learner.meet(look_of(agent, attention))
        if self.start is not None and learner is None:
            self.start.give(s, agent, self.exploration("train"))
        return agent

    def newborn(self) -> Agent:
        """The robot without a world that nothing has happened to, neither elsewhere nor offline."""
        plan = copy.copy(self)
        plan.start, plan.found = None, {}
        return plan.parts_alone()

    def _clamp(self, curiosity: Curiosity) -> int:
        """Index of the level that validation is held at; -1 if it is not."""
        level = self.settings.validation.clamp_level
        if level == "none":
            return -1
        if level not in curiosity.levels:
            raise ConfigError("validation.clamp_level", f"is {level}, and curiosity={curiosity.name} has no such level",
                              f"It has {', '.join(curiosity.levels)}")
        return curiosity.levels.index(level)

    def parts_alone(self) -> Agent:
        """The robot without a world, for those who only ask its parts."""
        return self.agent(simulator=cast(Simulator, NoSimulator()))

    def making(self, run: str = "run", folder: Path | None = None) -> Making:
        """What the run's parts are made from."""
        return Making(self.reading, self.settings.seed, self.layout, self.settings.periods, run=run, folder=folder)

    def probes(self) -> list[Probe]:
        """The probes, in the order in which they were chosen."""
        return [registry.make("probe", node, self.making().context("probe", name), f"probe.{name}")
                for name, node in self.settings.probe.items()]

    def callbacks(self, run: str = "run", folder: Path | None = None) -> list[Callback]:
        """Who watches the run that is stored in this folder."""
        making = self.making(run, folder)
        return [registry.make("callback", node, making.context("callback", name), f"callback.{name}")
                for name, node in self.settings.callback.items()]

    def columns(self, table: str) -> dict[str, Column]:
        """All columns of a table of this run."""
        added = {name: column for probe in self.probes() if probe.table == table
                 for name, column in probe.columns.items()}
        return columns_of(table, self.settings.behaviours, self.needs, added)

    def _check_probes(self, probes: Sequence[Probe]) -> None:
        """No two bring the same column, and none a column that the run has anyway."""
        for table in ("episodes", "behaviours", "cycles"):
            known = dict.fromkeys(columns_of(table, self.settings.behaviours, self.needs, {}), "the run")
            for probe in probes:
                for name in probe.columns if probe.table == table else ():
                    if name in known:
                        raise ConfigError(f"probe.{probe.name}", f"brings the column {name} to {table}, and so does "
                                          f"{known[name]}")
                    known[name] = f"probe.{probe.name}"

    def unused(self) -> Exploration:
        """The exploration of training as it is made."""
        found: Exploration = registry.make("exploration", self.settings.exploration, None)
        return found

    def exploration(self, phase: str) -> Exploration:
        """How actions are chosen in this phase (train | validation)."""
        node = self.settings.exploration
        if phase == "validation" and self.reading.validation_exploration == "greedy":
            node = {"name": "greedy", "ties": self.reading.tie_break}
        chosen: Exploration = registry.make("exploration", node, None)
        if self.start is not None and phase == "train":
            self.start.give_exploration(self.settings, chosen)
        return chosen

    def start_pose(self, phase: str, episode: int) -> tuple[float, float, float]:
        """Where an episode starts: from the seed alone, so that all conditions share it."""
        if self.recorded:
            with self.simulator() as simulator:
                given = simulator.begin(phase, episode)
            return given[1] if given else simulator.pose()
        if self.reading.start_pose == "fixed":
            return self.layout.steady_start
        return self.layout.random_start(stream(self.settings.seed, "start", phase, episode))

    def begin(self, agent: Agent, phase: str, episode: int) -> tuple[float, float, float]:
        """Where an episode of this agent starts; its simulator is told which one it is, and may say how long it is."""
        given = agent.simulator.begin(phase, episode)
        if given is None:
            return self.start_pose(phase, episode)
        agent.max_cycles, pose = given
        return pose
