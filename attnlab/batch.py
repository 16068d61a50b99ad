"""Many robots of one composition of parts in one call, over threads: compiled episodes of several run side by side.

    import attnlab.batch
    tables = attnlab.batch.simulate([{**config, "seed": seed} for seed in range(20)])   # as attnlab.simulate, of each
    folders = attnlab.batch.run(configs, "outputs/mine")                                # kept, as studies keep runs

All is the same bytes as one by one. A study does the same with ``cluster=threads``, and with conditions of any parts.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, TypeVar

from attnlab.api import Tables
from attnlab.errors import ConfigError
from attnlab.launch import engines
from attnlab.launch.expand import shown
from attnlab.launch.jobs import Job, check_different, condition_of, make_job
from attnlab.loading import load_all
from attnlab.robot.folder import run_to_folder
from attnlab.robot.plan import RunPlan
from attnlab.tables.flat import flatten, text
from attnlab.tables.processes import cores

Made = TypeVar("Made")


def simulate(configs: Sequence[Mapping[str, Any]], threads: int | None = None) -> list[Tables]:
    """The tables of each run, in this order; nothing is written. ``configs``: from :func:`attnlab.compose`, of the same
    parts; settings, readings, worlds and seeds may differ. ``threads``: all cores if left out. Raises ConfigError, also
    for parts that do not compile, and what a part raises."""
    import pandas as pd

    from attnlab.robot.episodes import play_run
    from attnlab.tables.schema import TABLES

    def one(job: Job) -> Tables:
        tables, _ = play_run(job.plan, engine="compiled")
        return Tables(*(pd.DataFrame(tables[name]) for name in TABLES))
    return _each(_jobs(configs, Path()), threads, one)


def run(configs: Sequence[Mapping[str, Any]], folder: Path | str, threads: int | None = None) -> list[Path]:
    """Each run into a folder of its own in ``folder``, with ``run.json``, ``config.yaml`` and tables as in a study; a
    run that failed says so there. Their folders, in this order; arguments and errors as in :func:`simulate`."""
    jobs = _jobs(configs, Path(folder).expanduser())
    check_different(jobs)
    _each(jobs, threads, lambda job: run_to_folder(dict(job.config), job.folder, job.info))
    return [job.folder for job in jobs]


def _jobs(configs: Sequence[Mapping[str, Any]], folder: Path) -> list[Job]:
    """Checked and compiled, with what differs among them for what is swept."""
    load_all()
    if not configs:
        raise ConfigError("configs", "there are none", "attnlab.compose(...) makes one")
    plans = [RunPlan({**config, "engine": "compiled"}) for config in configs]
    flat = [flatten(condition_of(plan.config, {}).config) for plan in plans]
    swept = [name for name in sorted(set().union(*flat)) if len({text(one.get(name)) for one in flat}) > 1]
    jobs = []
    for plan, settings in zip(plans, flat, strict=True):
        of = {name: shown(settings.get(name)) for name in swept}
        jobs.append(make_job(plan, [], of, swept, condition_of(plan.config, of)))
        jobs[-1].folder = folder / jobs[-1].folder.name
    _check_one_composition(jobs)
    engines.prepare(jobs)
    return jobs


def _check_one_composition(jobs: Sequence[Job]) -> None:
    first = {group: _typed(part) for group, part in engines.composition(jobs[0]).items()}
    for i, job in enumerate(jobs):
        for group, part in engines.composition(job).items():
            if _typed(part) != first[group]:
                raise ConfigError(f"configs[{i}]", f"has {group}={_typed(part)}, and configs[0] {group}={first[group]}",
                                  "A batch is of one composition of parts; a study takes any: cluster=threads")


def _typed(part: str | Sequence[str]) -> str:
    return part if isinstance(part, str) else f"[{','.join(part)}]"


def _each(jobs: Sequence[Job], threads: int | None, live: Callable[[Job], Made]) -> list[Made]:
    if threads is not None and threads < 1:
        raise ConfigError("threads", f"is {threads}, must be at least 1")
    with ThreadPoolExecutor(threads or cores()) as pool:
        return list(pool.map(live, jobs))
