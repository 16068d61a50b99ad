"""The runs that a command asks for: checked, named, and which of them are there already."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from attnlab.claims import claims_mark
from attnlab.claims.files import load_claims
from attnlab.config import RunSettings, run_key
from attnlab.errors import ConfigError
from attnlab.loading import plugin_hashes
from attnlab.registry import make
from attnlab.results.states import state_of
from attnlab.robot.engines import Choice
from attnlab.robot.plan import RunPlan
from attnlab.tables.code import code
from attnlab.tables.flat import text
from attnlab.tables.schema import SCHEMA_VERSION
from attnlab.tables.study import Condition, condition_config, condition_key

OTHER_CODE = "made by other code"


@dataclass
class Job:
    """One run to be: its checked plan, where it goes, and what run.json will say of it. ``swept``: what sets its
    condition apart, by setting; ``condition``: the name of that, once the study knows it; ``seen``: the claim under
    which it ended last, when this command looked."""
    plan: RunPlan
    overrides: list[str]
    swept: dict[str, Any]
    key: str
    of: Condition
    folder: Path
    claims: dict[str, str] | None = None
    seen: str | None = ""
    engine: Choice | None = None  # the run chooses for itself

    @property
    def config(self) -> Mapping[str, Any]:
        return self.plan.config

    @property
    def settings(self) -> RunSettings:
        return self.plan.settings

    @property
    def run(self) -> str:
        return self.folder.name

    @property
    def episodes(self) -> int:
        return self.settings.train_episodes + self.settings.validation_episodes

    @property
    def info(self) -> dict[str, Any]:
        columns = {name: value for name, value in self.swept.items() if name != "curiosity"}
        return {"run": self.run, "key": self.key, "overrides": self.overrides, "swept": columns,
                "condition": self.of.name, "code": code(), "claims": self.claims, "engine": self.engine}


def condition_of(config: Mapping[str, Any], swept: Mapping[str, Any], overrides: Sequence[str] = ()) -> Condition:
    """The condition of a run with this config. ``swept``: what sets it apart, by setting; ``overrides``: as typed."""
    return Condition(condition_key(config), condition_config(config), dict(swept), overrides=list(overrides),
                     columns=dict(swept))


def make_job(plan: RunPlan, overrides: Sequence[str], swept: Mapping[str, Any], named: Sequence[str],
             condition: Condition) -> Job:
    """The job of a checked plan; ``named``: the swept settings that make the name of its folder."""
    s = plan.settings
    words = [_word(swept[key], key) for key in sorted(named)] or [s.curiosity["name"]]
    stem = re.sub(r"[^A-Za-z0-9_.+-]+", "_", "_".join(words)).strip("._")[:80]
    key = run_key(plan.config)
    study = Path(s.outputs).expanduser() / s.study
    return Job(plan, list(overrides), dict(swept), key, condition, study / f"{stem}-seed{s.seed}-{key}")


def _word(value: Any, key: str) -> str:
    return str(value) if "." not in key else f"{key.rpartition('.')[2]}={value}"


def check_different(jobs: Sequence[Job]) -> None:
    """Raise ConfigError if two of the runs asked for are the same one under two names."""
    seen: dict[str, Job] = {}
    for job in jobs:
        other = seen.setdefault(job.key, job)
        if other is job:
            continue
        for name in job.swept:
            mine, theirs = job.swept[name], other.swept.get(name)
            if text(mine) != text(theirs):
                where = f"variants.{mine}" if name == "variant" else f"{name}={mine}"
                raise ConfigError(where, f"is the same as {theirs}: its runs would be made twice", "Leave one out")
        raise ConfigError("-m", f"asks twice for the run {job.run}", "Name each value once")


def check_once(jobs: Sequence[Job]) -> None:
    """What is the same for all jobs of a command: the cluster, and the claims file, whose mark they keep."""
    settings = jobs[0].settings
    make("cluster", settings.cluster, None).check()
    load_claims(settings.claims_file)
    claims = claims_mark(settings.claims_file)
    for job in jobs:
        job.claims = claims


def ended_under(about: Mapping[str, Any]) -> str | None:
    """The claim under which a run ended, from its run.json; empty if it has not: what a run at work comes to is news,
    though its claim is known."""
    return about.get("claim") if about.get("status") in ("complete", "failed") else ""


def split(jobs: Sequence[Job], fresh: bool) -> tuple[list[Job], list[Job], dict[str, int], list[Job]]:
    """(to run, complete already, why the ones to run are not complete: reason -> how many, those of the complete that
    other code of this package made).

    A complete run is known by the key at the end of its folder's name, whatever sweep it came from.
    """
    todo: list[Job] = []
    done: list[Job] = []
    old: list[Job] = []
    reasons: dict[str, int] = {}
    existing: dict[str, list[Path]] = {}
    study = jobs[0].folder.parent
    if study.is_dir():
        for folder in sorted(study.iterdir()):
            existing.setdefault(folder.name.rpartition("-")[2], []).append(folder)
    for job in jobs:
        reason, about = "missing", dict[str, Any]()
        for folder in existing.get(job.key, []):
            status, _, about = state_of(folder, whole=True)
            reason = "interrupted" if about.get("interrupted") else status
            if about.get("key") == job.key and about.get("run") in (None, folder.name):  # no copy of it
                job.folder, job.seen = folder, ended_under(about)
                if status == "complete" and about.get("schema") != SCHEMA_VERSION:
                    reason = "with tables of an older version"
                if status == "complete" and about.get("plugins") not in (None, plugin_hashes(job.config)):
                    reason = "made before its plugin was changed"
                break
            reason, about = "missing" if status == "complete" else status, {}
        if reason == "complete" and not fresh:
            done.append(job)
            if (about.get("code") or {}).get("hash") != code()["hash"]:
                old.append(job)
        else:
            todo.append(job)
            reasons[reason] = reasons.get(reason, 0) + 1
    return todo, done, reasons, old
