"""The kinds of parts. Everything that must know what groups there are (the door, Hydra's options, help, conformance,
templates) reads it here."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from typing import Literal


@dataclass(frozen=True)
class Group:
    """A kind of part.

    ``name``: as it is typed, and the folder of its yaml files in conf/ and plugins/. ``package``: of attnlab, holds the
    built-in parts. ``base``: ``module:class`` that a part derives from; it is called with (params, context).
    ``chosen``: by one option (``learner=q_lambda``), a list of them (``behaviours=[avoid,eat]``), a ``setting`` of the
    reading (``reading.penalised=all``), or in a report (named by a claims file, or drawn because it is there).
    ``in_key``: does it change a run's numbers?
    """
    name: str
    package: str
    base: str
    what: str
    chosen: Literal["option", "list", "setting", "report"] = "option"
    setting: str = ""
    in_key: bool = True

    @property
    def in_run(self) -> bool:
        """Is it a node of a run's config?"""
        return self.chosen in ("option", "list")

    @property
    def in_report(self) -> bool:
        """Does it work on a study that is there? Its parameters may then be required: a claims file sets them."""
        return self.chosen == "report"

    def base_class(self) -> type:
        """The class that parts derive from."""
        module, _, name = self.base.partition(":")
        found: type = getattr(import_module(module), name)
        return found

    def node(self, option: str) -> str:
        """Where the settings of a part are in a run's config."""
        return f"{self.name}.{option}" if self.chosen == "list" else self.name

    def typed(self, option: str) -> str:
        """What to type to use a part; empty for a part of a report."""
        return {"option": f"{self.name}={option}", "list": f"+{self.name}={option}",
                "setting": f"{self.setting}={option}", "report": ""}[self.chosen]


GROUPS: dict[str, Group] = {group.name: group for group in (
    Group("simulator", "simulators", "attnlab.simulators.base:Simulator", "moves the robot and answers its sensors"),
    Group("world", "worlds", "attnlab.worlds.base:World", "walls, boxes, and where the robot may start"),
    Group("behaviours", "behaviours", "attnlab.behaviours.base:Behaviour", "percept, releaser, motor schema, reward",
          chosen="list"),
    Group("needs", "needs", "attnlab.needs.base:Needs", "energy and needs of the body"),
    Group("fusion", "fusion", "attnlab.fusion.base:Fusion", "one motor command of those held"),
    Group("curiosity", "curiosity", "attnlab.curiosity.base:Curiosity", "wanting and liking"),
    Group("learner", "learners", "attnlab.learners.base:Learner", "learns the next period of a clock"),
    Group("exploration", "exploration", "attnlab.exploration.base:Exploration", "chooses among the learned values"),
    Group("penalty", "penalty", "attnlab.penalty.base:Penalty", "who pays for the robot's death", chosen="setting",
          setting="reading.penalised"),
    Group("probe", "probes", "attnlab.probes.base:Probe", "columns of one's own in a table", chosen="list"),
    Group("callback", "callbacks", "attnlab.callbacks.base:Callback", "watches a run and touches nothing",
          chosen="list", in_key=False),
    Group("cluster", "clusters", "attnlab.clusters.base:Cluster", "where the runs of a study are done", in_key=False),
    Group("figure", "figures", "attnlab.figures.base:Figure", "a picture of a study and a sentence, on every page",
          chosen="report", in_key=False),
    Group("measure", "measures", "attnlab.measures.base:Measure", "one number a seed, for claims", chosen="report"),
)}
