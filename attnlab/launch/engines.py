"""Which engine plays the runs of a study: chosen, and compiled if it pays, once, before any of them starts."""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Sequence

from attnlab.console import heard
from attnlab.launch.jobs import Job
from attnlab.robot.engines import Choice, choose

SAID: set[str] = set()  # what this command has told already, of pilots and of the study together
PARTS = ("behaviours", "curiosity", "exploration", "fusion", "learner", "needs", "simulator")


def prepare(jobs: Sequence[Job]) -> None:
    """Give every job its engine; says once that it compiles, and why what was to be compiled runs interpreted. Raises
    ConfigError if ``engine=compiled`` cannot be."""
    cycles: Counter[str] = Counter()
    for job in jobs:
        cycles[_parts(job)] += job.settings.max_cycles * job.episodes
    chosen: dict[str, Choice] = {}
    tried = list[int]()

    def compiling() -> None:
        tried.append(1)
        _say("compiling, about 10 s for each composition of parts, once")
    for job in jobs:
        if job.of.key not in chosen:
            before = len(tried)
            with heard():
                found = chosen[job.of.key] = choose(job.plan, cycles[_parts(job)], compiling)
            if len(tried) > before and found.name == "python":
                _say(f"runs interpreted: {found.why}")
        job.engine = chosen[job.of.key]


def composition(job: Job) -> dict[str, str | list[str]]:
    """The parts of a run by group: runs of the same ones share what is compiled."""
    nodes = {group: getattr(job.settings, group) for group in PARTS}
    return {group: sorted(node) if group == "behaviours" else node["name"] for group, node in nodes.items()}


def _parts(job: Job) -> str:
    return repr(composition(job))


def _say(what: str) -> None:
    """A line for whoever waits, once a command."""
    if what not in SAID:
        SAID.add(what)
        print(what, file=sys.stderr, flush=True)
