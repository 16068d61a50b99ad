"""Where readings are played: one study for each rung, its runs those of any other study."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from attnlab.arithmetic import total
from attnlab.claims.files import Claims
from attnlab.errors import ConfigError
from attnlab.launch.compose import Composer
from attnlab.launch.drive import complete
from attnlab.launch.jobs import Job, condition_of, make_job
from attnlab.launch.place import check_place
from attnlab.launch.variants import as_override
from attnlab.registry import make
from attnlab.results.conditions import Conditions, Runs
from attnlab.results.load import Study
from attnlab.robot.plan import RunPlan
from attnlab.tables.files import read_json

VALIDATION = 5  # training episodes for one of validation, as the paper's 500 and 100


class Played(NamedTuple):
    """``runs``: reading -> role -> its runs. ``seconds``: that the ``done`` runs took together, each on its core; those
    that were there already took none."""
    conditions: Conditions
    runs: dict[str, dict[str, Runs]]
    seconds: float
    done: int


@dataclass
class Bench:
    """``base``: overrides of all runs; ``mark``: of the claims file; ``typed``: the command that asks for them."""
    folder: Path
    composer: Composer
    base: Sequence[str]
    claims: Claims
    mark: dict[str, str]
    typed: Sequence[str]

    at_once = 1  # runs side by side, of the study that was played last

    def play(self, study: str, readings: Mapping[str, Mapping[str, Any]], roles: Sequence[str], seeds: Sequence[int],
             episodes: int) -> Played:
        """Each of the readings (name -> settings) in these roles, with these seeds. What is there is not played again.
        Raises ConfigError."""
        jobs: dict[tuple[str, str, int], Job] = {}
        for name, settings in readings.items():
            for role in roles:
                jobs |= {(name, role, job.settings.seed): job
                         for job in self._jobs(study, name, role, settings, seeds, episodes)}
        every = list(jobs.values())
        check_place(every)
        before = {job.key for job in every if (read_json(job.folder / "run.json") or {}).get("status") == "complete"}
        self.at_once = make("cluster", every[0].settings.cluster, None).at_once(every)
        complete(every, self.typed)
        found = Study(self.folder / study)
        there = set(found.complete)
        if not there:
            raise ConfigError(study, "none of its runs is complete", "run.json of each has the traceback")
        conditions = Conditions(found, self.claims.labels)
        runs = {name: {role: Runs(conditions, {}, {seed: job.run for seed in seeds
                                                   if (job := jobs[name, role, seed]).run in there})
                       for role in roles} for name in readings}
        done = {job.run for job in every if job.key not in before} & there
        return Played(conditions, runs, total(found.about(run).get("wall_s") or 0.0 for run in sorted(done)), len(done))

    def _jobs(self, study: str, name: str, role: str, settings: Mapping[str, Any], seeds: Sequence[int], episodes: int
              ) -> list[Job]:
        """The jobs of a reading in a role."""
        where = self.claims.roles[role].where
        for setting in where:
            if setting in settings:
                raise ConfigError(f"roles.{role}.where.{setting}", "is set by an open point, too",
                                  "What tells roles apart cannot be searched over")
        values = {"variant": f"{name} {self.claims.roles[role].label}", **settings, **where}
        overrides = [*self.base, *(f"{key}={as_override(value)}" for key, value in {**settings, **where}.items())]
        config = self.composer.config([*overrides, f"train_episodes={episodes}",
                                       f"validation_episodes={max(1, episodes // VALIDATION)}",
                                       f"outputs={as_override(str(self.folder))}", f"study={study}"])
        condition, found = condition_of(config, values, overrides), []
        plan: RunPlan | None = None
        for seed in seeds:
            plan = RunPlan({**config, "seed": seed}) if plan is None else plan.with_seed(seed)
            job = make_job(plan, [*overrides, f"seed={seed}"], values, ["variant"], condition)
            job.claims = self.mark
            found.append(job)
        return found
