"""Sweepers that others wrote for Hydra (``hydra/sweeper=optuna``): what they ask for are runs of a study, too.

Such a sweeper hands choices to a launcher and is given a number for each. The launcher here makes jobs of them, does
what is missing of them as any command does, and returns ``tune.goal``: the mean of a measure over all seeds. Seeds are
not the sweeper's to choose, so they are held back from it.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from hydra.core.utils import JobReturn, JobStatus
from hydra.plugins.launcher import Launcher
from hydra.types import HydraContext, TaskFunction
from omegaconf import DictConfig, OmegaConf

from attnlab.config import TuneSettings
from attnlab.errors import ConfigError
from attnlab.launch.compose import Composer
from attnlab.launch.door import Door
from attnlab.launch.expand import Expansion, name_of
from attnlab.launch.jobs import Job, check_once
from attnlab.launch.place import check_place
from attnlab.launch.worth import goal_of, worth
from attnlab.settings import build
from attnlab.tables.numbers import mean_of
from attnlab.tables.ranges import seeds

SWEEPER = "hydra/sweeper="


def held_back(overrides: Sequence[str]) -> list[str]:
    """What such a sweeper is told of what was typed; the rest is kept for its launcher. All of it, and nothing is kept,
    if no such sweeper was chosen. Raises ConfigError."""
    StudyLauncher.kept, StudyLauncher.typed = [], list(overrides)
    StudyLauncher.failed, StudyLauncher.folder = 0, Path()
    chosen = [o for o in overrides if o.startswith(SWEEPER) and o != f"{SWEEPER}basic"]
    if not chosen:
        return list(overrides)
    kept = [o for o in overrides if o.startswith(("tune.", "seed="))]
    if not any(o.startswith("tune.goal=") for o in kept):
        raise ConfigError(chosen[0], "must be told what a run is worth", "tune.goal=survival, or another measure")
    StudyLauncher.kept = kept
    return [o for o in overrides if o not in kept]


class StudyLauncher(Launcher):
    """Does choices as runs of a study. ``kept``: overrides that all have; ``failed``: choices of which a run failed."""
    kept: list[str] = []
    typed: list[str] = []
    failed = 0
    folder = Path()

    def setup(self, *, hydra_context: HydraContext, task_function: TaskFunction, config: DictConfig) -> None:
        self.composer = Composer(hydra_context.config_loader, config)
        plain = [o.lstrip("+~").partition("=")[0] for o in config.hydra.overrides.task]
        self.plain = {name for name, text in zip(plain, config.hydra.overrides.task, strict=True)
                      if not self.composer.parsed(text).is_sweep_override()}
        typed = next((o.partition("=")[2] for o in self.kept if o.startswith("seed=")), "0")
        self.seeds = seeds("seed", typed)

    def launch(self, job_overrides: Sequence[Sequence[str]], initial_job_idx: int) -> Sequence[JobReturn]:
        from attnlab.launch.drive import complete
        each = [self._jobs(list(overrides)) for overrides in job_overrides]
        wanted = build(TuneSettings, each[0][0].config["tune"], "tune")
        measure = goal_of(wanted.goal)
        jobs = list({job.key: job for of in each for job in of}.values())  # a choice may be made twice
        check_once(jobs)
        check_place(jobs)
        type(self).folder = jobs[0].folder.parent
        broken = {job.key: why for job, why in complete(jobs, self.typed)}
        homes = {job.key: job.folder for job in jobs}
        found = []
        for overrides, of in zip(job_overrides, each, strict=True):
            for job in of:
                job.folder = homes[job.key]
            why = next((broken[job.key] for job in of if job.key in broken), "")
            values, why = ({}, why) if why else worth(measure, of)
            answer = JobReturn(overrides=list(overrides), cfg=OmegaConf.create({**of[0].config}),
                               working_dir=str(self.folder), task_name="attnlab")
            if values:
                answer.status, answer.return_value = JobStatus.COMPLETED, mean_of(values.values())
            else:
                type(self).failed += 1
                answer.status, answer.return_value = JobStatus.FAILED, RuntimeError(why)
            told = " ".join(o for o in overrides if o.lstrip("+").partition("=")[0] not in self.plain)
            print(f"{why or format(answer.return_value, '.4g')} with {told}", file=sys.stdout, flush=True)
            found.append(answer)
        return found

    def _jobs(self, overrides: list[str]) -> list[Job]:
        """The jobs of one choice, one a seed."""
        typed = [*overrides, *(o for o in self.kept if not o.startswith("seed="))]
        merged = {name_of(o): o for o in map(self.composer.parsed, typed)}
        expansion = Expansion(self.composer, Door(self.composer.loader), merged)
        expansion.seeds = self.seeds
        return expansion.trial({name: str(o.get_value_element_as_str()) for name, o in merged.items()
                                if name not in self.plain and not name.startswith("tune.")})
