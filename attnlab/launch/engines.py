"""Which engine plays the runs of a study: chosen, and compiled if it pays, once, before any of them starts."""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Sequence

from attnlab.launch.jobs import Job
from attnlab.robot.engines import Choice, choose

PARTS = ("behaviours", "curiosity", "exploration", "fusion", "learner", "needs", "simulator")


def prepare(jobs: Sequence[Job]) -> None:
    """Give every job its engine. Raises ConfigError if ``engine=compiled`` cannot be."""
    cycles: Counter[str] = Counter()
    for job in jobs:
        cycles[_parts(job)] += job.settings.max_cycles * job.episodes
    chosen: dict[str, Choice] = {}
    for job in jobs:
        if job.of.key not in chosen:
            chosen[job.of.key] = choose(job.plan, cycles[_parts(job)], _announce)
        job.engine = chosen[job.of.key]


def _parts(job: Job) -> str:
    """The composition of a run: runs of one share what is compiled."""
    return repr([sorted(node) if group == "behaviours" else node["name"]
                 for group in PARTS for node in [getattr(job.settings, group)]])


def _announce() -> None:
    print("compiling these parts, about 10 s, once", file=sys.stderr, flush=True)
