"""What a few runs are worth to who looks for the best: a measure, for each of their seeds."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from attnlab.errors import ConfigError
from attnlab.launch.jobs import Job
from attnlab.registry import make

if TYPE_CHECKING:
    from attnlab.measures.base import Measure


def goal_of(goal: Any) -> Measure:
    """The measure that ``tune.goal`` names. Raises ConfigError."""
    node = {"name": goal} if isinstance(goal, str) else goal
    if not isinstance(node, Mapping) or not isinstance(node.get("name"), str):
        raise ConfigError("tune.goal", f"{goal!r} is no measure",
                          "tune.goal=survival, or {name: survival, phase: train}")
    try:
        measure: Measure = make("measure", node, None, "tune.goal")
    except TypeError as cause:
        raise ConfigError("tune.goal", f"{node['name']} needs more: {cause}", "{name: ..., setting: ...}") from None
    return measure


def worth(measure: Measure, jobs: Sequence[Job]) -> tuple[dict[int, float], str]:
    """(the measure of each seed, "") of complete runs of one condition, or ({}, why it has none). Raises ConfigError if
    it cannot be taken of such runs at all."""
    from attnlab.measures.base import CannotMeasure
    from attnlab.results.conditions import Conditions, Runs
    from attnlab.results.load import Study
    runs = {job.settings.seed: job.run for job in jobs}
    try:
        found = measure.of(Runs(Conditions(Study(jobs[0].folder.parent), {}), {}, runs))
    except CannotMeasure as cause:
        raise ConfigError("tune.goal", f"cannot be taken: {cause}", "Another measure, or other settings") from None
    values = {int(seed): float(value) for seed, value in found.items()}
    odd = [seed for seed in runs if not math.isfinite(values.get(seed, math.nan))]
    return ({}, f"seed {odd[0]} has no finite value") if odd else (values, "")
