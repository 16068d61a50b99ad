"""The runs of a study: their names, what of them exists already, and whether they can run at all."""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from attnlab.claims import claims_path
from attnlab.config import run_key
from attnlab.errors import ConfigError
from attnlab.launch.settings import LocalCluster
from attnlab.loading import plugin_hashes
from attnlab.results.load import state_of
from attnlab.robot.plan import RunPlan
from attnlab.settings import build
from attnlab.tables.processes import is_running
from attnlab.tables.schema import row_bytes


@dataclass
class Job:
    """One run to be: its resolved config, where it goes, and what run.json will say of it."""
    config: dict[str, Any]
    overrides: list[str]
    swept: dict[str, Any]
    key: str
    condition: str
    folder: Path
    episodes: int

    @property
    def run(self) -> str:
        return self.folder.name

    @property
    def info(self) -> dict[str, Any]:
        return {"run": self.run, "key": self.key, "overrides": self.overrides, "swept": self.swept,
                "condition": self.condition}


def make_job(config: dict[str, Any], overrides: Sequence[str], swept: Mapping[str, Any],
             named: Sequence[str] | None = None) -> Job:
    """A checked job. Raises ConfigError for anything that can be known to fail before it starts.

    ``swept``: what sets this run apart, by setting; ``named``: those of them that make its condition's name (all).
    """
    settings = RunPlan(config).settings
    if settings.cluster.get("name") == "local":
        build(LocalCluster, {k: v for k, v in settings.cluster.items() if k != "name"}, "cluster")
    if settings.claims_file:
        claims_path(settings.claims_file)
    names = [_label(swept[key], key) for key in sorted(swept if named is None else named)]
    names = names or [config["curiosity"]["name"]]
    condition = " ".join(str(settings.labels.get(name, name)) for name in names)
    stem = re.sub(r"[^A-Za-z0-9_.+-]+", "_", "_".join(names)).strip("._")[:80]
    key = run_key(config)
    study = Path(settings.outputs).expanduser() / settings.study
    columns = {name: value for name, value in swept.items() if name != "curiosity"}
    return Job(config, list(overrides), columns, key, condition, study / f"{stem}-seed{settings.seed}-{key}",
               settings.train_episodes + settings.validation_episodes)


def _label(value: Any, key: str) -> str:
    return str(value) if "." not in key else f"{key.rpartition('.')[2]}={value}"


def check_place(jobs: Sequence[Job]) -> None:
    """Raise ConfigError if the results cannot be written or would not fit. Leaves nothing behind."""
    folder = jobs[0].folder.parent
    made = []
    try:
        for path in [*reversed(folder.parents), folder]:
            if not path.exists():
                path.mkdir()
                made.append(path)
        probe = folder / f".probe.{os.getpid()}"
        probe.touch()
        probe.unlink()
    except OSError as cause:
        raise ConfigError("outputs", f"{folder} cannot be written ({cause.strerror or cause})",
                          "Choose a folder of yours: outputs=...") from None
    finally:
        free = _free_bytes(folder)
        for path in reversed(made):
            path.rmdir()
    largest = max(jobs, key=lambda job: job.episodes)
    behaviours = len(largest.config["behaviours"])
    a_row = row_bytes("episodes", behaviours) + row_bytes("behaviours", behaviours)
    disk, memory = sum(job.episodes for job in jobs) * a_row, largest.episodes * a_row * 6
    for need, have, what in ((disk, free, "disk, free are"), (memory, _memory(), "memory, there are")):
        if need > have:
            setting = "train_episodes" if largest.config["train_episodes"] >= largest.config["validation_episodes"] \
                else "validation_episodes"
            raise ConfigError(setting, f"{largest.episodes} episodes a run would need about {need / 1e9:.0f} GB of "
                              f"{what} {have / 1e9:.0f} GB", "Ask for fewer")


def _free_bytes(folder: Path) -> int:
    while not folder.exists():
        folder = folder.parent
    return shutil.disk_usage(folder).free


def _memory() -> int:
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (ValueError, OSError, AttributeError):
        return 2**62


def split(jobs: Sequence[Job], fresh: bool) -> tuple[list[Job], list[Job], dict[str, int]]:
    """(to run, complete already, why the ones to run are not complete: reason -> how many).

    A complete run is known by the key at the end of its folder's name, whatever sweep it came from.
    """
    todo, done, reasons = [], [], {}
    existing: dict[str, list[Path]] = {}
    study = jobs[0].folder.parent
    if study.is_dir():
        for folder in sorted(study.iterdir()):
            existing.setdefault(folder.name.rpartition("-")[2], []).append(folder)
    for job in jobs:
        reason = "missing"
        for folder in existing.get(job.key, []):
            status, _, about = state_of(folder)
            reason = status
            if status == "running" and is_running(about):
                raise ConfigError("study", f"{folder} is being run by process {about['pid']}",
                                  "Wait for it, or name another: study=...")
            if status == "complete" and about.get("key") == job.key:
                job.folder = folder
                if about.get("plugins") not in (None, plugin_hashes(job.config)):
                    reason = "made before its plugin was changed"
                break
        if reason == "complete" and not fresh:
            done.append(job)
        else:
            todo.append(job)
            reasons[reason] = reasons.get(reason, 0) + 1
    return todo, done, reasons
