"""A study's file, ``study.json``: what was typed, which conditions there are, and every run that was asked for.

It is written before the first run and at every growth, under a lock, so that two commands may grow a study at once.
Names of conditions, "missing" and the order in figures come from here, for launcher and reader alike.
"""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from attnlab.config import digits_of, that_count
from attnlab.tables.files import read_json, write_json
from attnlab.tables.lock import locked
from attnlab.tables.naming import Naming, name_all

FILE = "study.json"
SCHEMA = 1


@dataclass
class Condition:
    """Runs that differ in their seed alone.

    ``key``: of its config; ``name``: its one name, everywhere; ``settings``: those that set it apart from the others,
    by dotted name; ``config``: resolved, without seed and cosmetic settings; ``overrides``: as typed, without the seed;
    ``columns``: swept settings that are columns of its tables.
    """
    key: str
    config: dict[str, Any]
    settings: dict[str, Any]
    name: str = ""
    label: str = ""
    overrides: list[str] = field(default_factory=list)
    columns: dict[str, Any] = field(default_factory=dict)


@dataclass
class Asked:
    """A run that was asked for. ``condition``: the name of its condition."""
    name: str
    key: str
    condition: str
    seed: int


@dataclass
class StudyFile:
    """The content of a study.json. ``axes``: names of the settings that set conditions apart, those that were swept
    first; ``labels``: what values are called; ``claims``: name and sha256 of the claims file, or None; ``cosmetic``:
    the settings of the last command that change no number."""
    schema: int = SCHEMA
    commands: list[dict[str, Any]] = field(default_factory=list)
    axes: list[str] = field(default_factory=list)
    labels: dict[str, str] = field(default_factory=dict)
    conditions: list[Condition] = field(default_factory=list)
    runs: list[Asked] = field(default_factory=list)
    code: dict[str, Any] = field(default_factory=dict)
    claims: dict[str, str] | None = None
    notes: list[str] = field(default_factory=list)
    cosmetic: dict[str, Any] = field(default_factory=dict)

    def by_name(self) -> dict[str, Condition]:
        return {condition.name: condition for condition in self.conditions}

    def add(self, condition: Condition, runs: Iterable[tuple[str, str, int]]) -> None:
        """A condition and its runs (name, key, seed), or what is new of them: a run keeps the name it was first
        asked for by. Call :meth:`rename` after the last."""
        known = next((c for c in self.conditions if c.key == condition.key), None)
        if known is None:
            condition.name = condition.key
            self.conditions.append(known := condition)
        else:
            known.settings.update(condition.settings)
            known.overrides, known.columns = condition.overrides, condition.columns
        keys = {run.key: run for run in self.runs}
        for name, key, seed in runs:
            if key in keys:
                keys[key].condition = known.name
            else:
                self.runs.append(Asked(name, key, known.name, seed))

    def rehome(self, folder: Path, names: Mapping[str, str]) -> None:
        """Runs whose folder is under another of their names (key -> name) go by that one."""
        for run in self.runs:
            name = names.get(run.key, run.name)
            if name != run.name and not (folder / run.name).exists() and (folder / name).exists():
                run.name = name

    def rename(self) -> None:
        """Give every condition the one name that tells it from the others."""
        found: Naming = name_all([(c.settings, c.config) for c in self.conditions], self.labels)
        self.axes, self.notes = found.axes, found.notes
        unique = [name if found.names.count(name) == 1 else f"{name} ({condition.key})"
                  for name, condition in zip(found.names, self.conditions, strict=True)]
        names = {c.name: new for c, new in zip(self.conditions, unique, strict=True)}
        for condition, new, values in zip(self.conditions, unique, found.values, strict=True):
            condition.name, condition.settings = new, values
            condition.label = self.labels.get(str(values.get("curiosity")), new)
        for run in self.runs:
            run.condition = names[run.condition]


def condition_key(config: Mapping[str, Any]) -> str:
    """Ten hex digits of everything in a config that can change a number but for the seed."""
    return digits_of(condition_config(config))


def condition_config(config: Mapping[str, Any]) -> dict[str, Any]:
    """A run's config without its seed, cosmetic settings and empty groups."""
    return {name: value for name, value in that_count(config).items() if name != "seed" and value != {}}


def read_study(folder: Path) -> StudyFile | None:
    """The study's file, or None if there is none that can be read."""
    content = read_json(folder / FILE)
    if content is None or content.get("schema") != SCHEMA:
        return None
    try:
        content["conditions"] = [Condition(**node) for node in content["conditions"]]
        content["runs"] = [Asked(**node) for node in content["runs"]]
        return StudyFile(**content)
    except (TypeError, KeyError):
        return None


def grow(folder: Path, typed: Sequence[str], conditions: Sequence[tuple[Condition, Sequence[tuple[str, str, int]]]],
         labels: Mapping[str, str], code: Mapping[str, Any], claims: Mapping[str, str] | None,
         before: StudyFile | None = None, cosmetic: Mapping[str, Any] | None = None) -> StudyFile:
    """Add what a command asks for to the study's file, and return it whole. ``before``: what the folder's runs say of a
    study that has no file yet."""
    folder.mkdir(parents=True, exist_ok=True)
    with locked(folder):
        study = read_study(folder) or before or StudyFile()
        study.commands.append({"typed": list(typed), "time": time.strftime("%Y-%m-%dT%H:%M:%S%z"), **code})
        new = {str(value): str(label) for value, label in labels.items()}
        kept = {value: label for value, label in study.labels.items() if label not in new.values()}
        study.labels = {**kept, **new}  # a label names one value, the one it was given last
        study.code, study.claims = dict(code), dict(claims) if claims else None
        study.cosmetic = dict(cosmetic or {})
        for condition, runs in conditions:
            study.add(condition, runs)
        study.rehome(folder, {key: name for _, runs in conditions for name, key, _ in runs})
        study.rename()
        write_json(folder / FILE, dataclasses.asdict(study))
    return study
