"""Which engine plays a run: Python, or the same classes compiled."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from attnlab import registry
from attnlab.cycle import Agent
from attnlab.errors import ConfigError, describe
from attnlab.exploration.base import Exploration
from attnlab.robot.episode import run_episode
from attnlab.robot.plan import RunPlan
from attnlab.robot.quick import Quick, quick

EPISODES = 3  # that both engines play before one is trusted
LOOKS_CYCLES = 300_000  # below, Python is done before it is known whether there is compiled code
PAYS_CYCLES = 3_000_000  # that runs of one composition share: what compiling costs in CPU time, Python takes for them

Play = Callable[[Agent, Exploration, tuple[float, float, float], bool], tuple[str | None, list[float]]]


class Choice(NamedTuple):
    """An engine (python | compiled) and why it was chosen."""
    name: str
    why: str


def choose(plan: RunPlan, cycles: int | None = None, announce: Callable[[], None] = lambda: None) -> Choice:
    """The engine of a run. ``cycles``: of all runs of this composition, this one's if left out; ``announce`` is called
    before a compilation. Raises ConfigError if ``engine=compiled`` cannot be."""
    asked = plan.settings.engine
    if asked == "python":
        return Choice("python", "engine=python")
    total = cycles or plan.settings.max_cycles * (plan.settings.train_episodes + plan.settings.validation_episodes)
    if asked == "auto" and total < LOOKS_CYCLES:
        return Choice("python", f"it is short: {total:,} cycles at most")
    why = never(plan)
    if not why:
        from attnlab.compiled.engine import Uncompilable
        from attnlab.kernels.compile import keeps
        try:
            if asked == "auto" and not keeps():
                return Choice("python", "numba's cache folder cannot be written: each run would compile for itself")
            kept = build(plan, only_kept=True)
            if not kept and asked == "auto" and total < PAYS_CYCLES:
                return Choice("python", f"compiling pays from {PAYS_CYCLES:,} cycles on; there are {total:,} at most")
            if not kept:
                announce()
                build(plan)
            why = differs(plan)
            if not why:
                return Choice("compiled", f"engine={asked}" + ", and it was compiled before" * kept)
        except Uncompilable as cause:
            why = str(cause)
        except Exception as cause:  # noqa: BLE001  whatever it is that a part of anybody's does to the compiler
            why = f"compiling failed ({describe(cause)})"
    if asked == "compiled":
        raise ConfigError("engine=compiled", f"cannot be: {why}", "engine=auto runs interpreted what does not compile")
    return Choice("python", why)


def build(plan: RunPlan, only_kept: bool = False) -> bool:
    """Compile what a run needs, so that it is on the disk; with ``only_kept``: is it there?"""
    from attnlab.compiled.engine import Compiled
    simulator = plan.simulator()
    try:
        explorations = [plan.exploration(phase) for phase in ("train", "validation")]
        return Compiled(plan.agent(simulator), explorations, only_kept).is_there
    finally:
        simulator.close()


def player(engine: str, agent: Agent, explorations: list[Exploration]
           ) -> tuple[Play, Quick | None, Callable[[], None]]:
    """What plays an episode, what says of it what the tables want in compiled code (None if numpy has to), and what is
    called when the last was played."""
    if engine == "python":
        return run_episode, None, lambda: None
    from attnlab.compiled.engine import Compiled
    compiled = Compiled(agent, explorations)
    return compiled, quick(agent, compiled.looks), compiled.finish


def differs(plan: RunPlan) -> str:
    """What is not the same in the first episodes of a run when both engines play them; empty if all is. Costs some tens
    of milliseconds, and nothing that a part does when it is compiled goes unseen for long."""
    seen: list[list[dict[str, Any]]] = []
    for engine in ("python", "compiled"):
        simulator = plan.simulator()
        try:
            agent = plan.agent(simulator)
            explorations = [plan.exploration(phase) for phase in ("train", "validation")]
            play, _, finish = player(engine, agent, explorations)
            seen.append([])
            for episode in range(EPISODES):
                last = episode == EPISODES - 1
                ended = play(agent, explorations[last], plan.start_pose("train", episode), not last)
                seen[-1].append({"end": ended, "needs and energy": agent.history.columns().copy(),
                                 **{f"{attention.behaviour.name}.{name}": values for attention in agent.attentions
                                    for name, values in attention.log.columns()._asdict().items()}})
            finish()
        finally:
            simulator.close()
    for one, other in zip(*seen, strict=True):
        for name, value in one.items():
            if not (value == other[name] if name == "end" else np.array_equal(value, other[name], equal_nan=True)):
                return f"compiled code gives another {name}"
    return ""


def never(plan: RunPlan) -> str:
    """Why a run cannot be compiled, as far as it shows before it is tried; empty if it may."""
    s = plan.settings
    for group in ("simulator", "needs", "fusion", "curiosity", "learner", "exploration"):
        node = getattr(s, group)
        why = _interpreted(group, node)
        if why:
            return f"{group}={node['name']} runs as Python: {why}"
    if plan.validation_spec is not None:
        return "validation has a simulator of its own"
    for name, node in s.behaviours.items():
        why = _interpreted("behaviours", node)
        if why:
            return f"behaviours.{name} runs as Python: {why}"
    try:
        import attnlab.compiled.engine
        import attnlab.kernels.compile  # noqa: F401
    except (ImportError, AttributeError) as cause:
        return f"numba is missing or too old ({describe(cause)})"
    return ""


def exempt(plan: RunPlan) -> str:
    """Why the tables may be other bytes on another machine; empty if they may not."""
    learner = plan.settings.learner
    why = registry.get("learner", learner, "learner").cls.exempt  # type: ignore[attr-defined]
    return f"learner={learner['name']}: {why}" if why else ""


def _interpreted(group: str, node: Any) -> str:
    """What a part says of itself."""
    return str(getattr(registry.get(group, node, group).cls, "interpreted", ""))
