"""The runs that a study's file asks for and that are not there, done by whoever calls: one idempotent command."""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from attnlab.errors import ConfigError
from attnlab.launch.jobs import Job, ended_under
from attnlab.launch.progress import Display
from attnlab.registry import make
from attnlab.results.load import folder_of
from attnlab.results.states import state_of
from attnlab.robot.plan import RunPlan
from attnlab.tables.study import FILE, Condition, StudyFile, read_study


def study_of(name: str) -> tuple[Path, StudyFile]:
    """The folder of a study, by its path or its name in outputs/, and its file. Raises ConfigError."""
    folder = folder_of(name)
    study = read_study(folder)
    if study is None:
        raise ConfigError(str(folder), f"has no {FILE} that can be read", "The command that began the study writes one")
    return folder, study


def jobs_of(folder: Path, study: StudyFile, failed: bool = False, whole: bool = False,
            only: Sequence[str] | None = None) -> list[Job]:
    """The jobs of a study that are to be done: those that never ran, were interrupted or are damaged (``whole``: read
    every table to see), and with ``failed`` those that failed."""
    conditions, plans, found = study.by_name(), dict[str, RunPlan](), list[Job]()
    chosen = None if only is None else set(only)
    for run in study.runs:
        if chosen is not None and run.name not in chosen:
            continue
        status, _, about = state_of(folder / run.name, whole)
        if status == "complete" or (status == "failed" and not failed and not about.get("interrupted")):
            continue
        condition = conditions[run.condition]
        plan = plans.get(condition.name)
        config = config_of(folder, study, condition, run.seed)
        plans[condition.name] = plan = RunPlan(config) if plan is None else plan.with_seed(run.seed)
        found.append(Job(plan, [*condition.overrides, f"seed={run.seed}"], condition.columns, run.key, condition,
                         folder / run.name, study.claims, ended_under(about)))
    return found


def config_of(folder: Path, study: StudyFile, condition: Condition, seed: int) -> dict[str, Any]:
    """The whole config of a run that was asked for."""
    return {**study.cosmetic, **condition.config, "seed": seed, "outputs": str(folder.parent), "study": folder.name}


def do(name: str, share: tuple[int, int] = (1, 1), minutes: float | None = None, at_once: int | None = None,
       failed: bool = False, only: Sequence[str] | None = None) -> int:
    """Do what is missing of a study, this ``share`` (one of how many) first, then what nobody else does. Leaves before
    ``minutes`` are over; ``only``: names of the runs to do. 0, or 1 if a run that was begun failed.
    Raises ConfigError."""
    until = None if minutes is None else time.monotonic() + 60 * minutes
    folder, study = study_of(name)
    jobs = jobs_of(folder, study, failed, whole=failed, only=only)
    mine = [job for i, job in enumerate(jobs) if i % share[1] == share[0] - 1]
    mine += [job for i, job in enumerate(jobs) if i % share[1] != share[0] - 1]
    if not jobs:
        print(f"{folder}: nothing to do, {_standing(folder, study)}")
        return 0
    where = make("cluster", {"name": "local", "jobs": at_once}, None)
    where.waits, where.until = False, until
    print(f"{folder}: {len(jobs)} of {len(study.runs)} runs to be done, {where.at_once(mine)} at a time", flush=True)
    with Display(len(mine), sum(job.episodes for job in mine), where.params.stop_after) as display:
        where.run(mine, display)
    display.print_failed(folder)
    print(f"{folder}: {_standing(folder, study)}")
    return 1 if display.failed else 0


def _standing(folder: Path, study: StudyFile) -> str:
    """What became of all runs, in words."""
    counts: dict[str, int] = {}
    for run in study.runs:
        status, _, about = state_of(folder / run.name)
        word = "interrupted" if about.get("interrupted") else "missing" if status == "incomplete" else status
        counts[word] = counts.get(word, 0) + 1
    text = ", ".join(f"{count} {word}" for word, count in sorted(counts.items()))
    hint = f"; python -m attnlab.retry {folder} does those that failed" if counts.get("failed") else ""
    return f"{text} of {len(study.runs)} runs{hint}"
