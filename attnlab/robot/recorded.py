"""Runs on what was recorded: what in their config follows from files, and who cannot live in them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from attnlab import registry
from attnlab.errors import ConfigError

if TYPE_CHECKING:
    from attnlab.cycle import Agent
    from attnlab.robot.plan import RunPlan
    from attnlab.simulators.base import Simulator


def settled(config: Mapping[str, Any]) -> dict[str, Any]:
    """The config with what its simulator reads from a file: the file's hash, the world and the cycle it brings. Another
    file of the same name is thus another run. Raises ConfigError."""
    node = config.get("simulator")
    spec = registry.parts.get(("simulator", str(node.get("part") or node.get("name")))) \
        if isinstance(node, Mapping) else None
    if spec is None or not is_recorded(spec):
        return dict(config)
    _, params = registry.build_params("simulator", node, "simulator")
    simulator: type[Simulator] = spec.cls
    return {**config, **simulator.settles(params, config)}


def told_of(plan: RunPlan) -> list[str]:
    """What a reader of the run should know of the files it lives on: what was skipped, and how often."""
    if not plan.recorded:
        return []
    with plan.simulator() as simulator:
        return simulator.told()


def is_recorded(spec: registry.Spec) -> bool:
    """Does all go as it was recorded in this simulator?"""
    simulator: type[Simulator] = spec.cls
    return simulator.recorded


def check_recorded(agent: Agent, simulator: str, max_cycles: int) -> None:
    """Raise ConfigError if a robot would have to act in order to live, where nothing comes of what it does."""
    for attention in agent.attentions:
        name = attention.behaviour.name
        if simulator not in attention.behaviour.simulators:
            fitting = sorted(spec.name for spec in registry.parts.values() if spec.group == "behaviours"
                             and simulator in getattr(spec.cls, "simulators", ()))
            raise ConfigError(f"behaviours.{name}", f"acts, and in simulator={simulator} all goes as it was recorded: "
                              "nothing would come of what it does", f"Those that only look: {', '.join(fitting)}; "
                              f"behaviours=[{fitting[0]}]" if fitting else "")
    for need in agent.body.needs:
        most = need.start + (need.per_activation * len(agent.attentions) + need.per_cycle) * max_cycles
        if need.death_at is not None and most >= need.death_at:
            raise ConfigError("needs", f"{need.name} may kill within {max_cycles} cycles, and in simulator={simulator} "
                              "nobody can do anything about it", "needs=energy_only")
