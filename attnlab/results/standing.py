"""How a study stands, from its files alone: whoever does its runs, and from wherever one looks."""

from __future__ import annotations

import shutil
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from attnlab.errors import ConfigError
from attnlab.tables import claim
from attnlab.tables.files import read_json
from attnlab.tables.numbers import kept
from attnlab.tables.study import FILE, StudyFile, read_study

SILENT_S = 4 * claim.BEAT_S
STATES = ("complete", "running", "failed", "interrupted", "missing")


@dataclass
class OfCondition:
    """Means over the runs of a condition. ``living``: survival so far of the runs at work."""
    asked: int = 0
    complete: int = 0
    train: list[float] = field(default_factory=list)
    validation: list[float] = field(default_factory=list)
    living: list[float] = field(default_factory=list)


@dataclass
class Look:
    """One look at a study. ``running``: (run, who, episodes done, episodes of it, silent s); ``failed``: (run, reason);
    rates per second over the runs at work; ``left_s``: None if it cannot be told."""
    states: Counter[str]
    episodes: int
    episodes_done: int
    cycles_per_s: float
    left_s: float | None
    running: list[tuple[str, str, int, int, float]]
    gone: list[tuple[str, str]]
    failed: list[tuple[str, str]]
    conditions: dict[str, OfCondition]

    @property
    def over(self) -> bool:
        """Is nobody at work, and nothing left that one could wait for?"""
        return not self.running


def look(folder: Path) -> Look:
    """How the study in this folder stands. Raises ConfigError if it has no file."""
    study = read_study(folder)
    if study is None:
        raise ConfigError(str(folder), f"has no {FILE} that can be read", "The command that began the study writes one")
    claims, plans = claim.standings(folder), _plans(study)
    found = Look(Counter(), 0, 0, 0.0, None, [], [], [], {c.name: OfCondition() for c in study.conditions})
    rate = 0.0
    for run in study.runs:
        episodes, most = plans[run.condition]
        of, standing = found.conditions[run.condition], claims.get(run.key)
        about = {} if standing and not standing.dead else read_json(folder / run.name / "run.json") or {}
        state = _state(about, standing)
        found.states[state] += 1
        found.episodes += episodes
        of.asked += 1
        if state == "complete":
            found.episodes_done += episodes
            of.complete += 1
            _add_numbers(of, kept(about) or {})
        elif state == "failed":
            lines = str(about.get("error") or "").strip().splitlines() or ["no reason was stored"]
            found.failed.append((run.name, lines[-1][:200]))
        elif state == "running" and standing:
            found.episodes_done += standing.episodes
            who = f"{standing.owner.get('host')}, process {standing.owner.get('pid')}"
            found.running.append((run.name, who, standing.episodes, episodes, standing.silent_s))
            if standing.working_s > 0:
                rate += standing.episodes / standing.working_s
                found.cycles_per_s += standing.cycles / standing.working_s
            if standing.episodes:
                of.living.append(standing.cycles / standing.episodes / most)
        if standing and standing.dead:
            found.gone.append((run.name, standing.dead))
    waiting = found.episodes - found.episodes_done - sum(plans[r.condition][0] for r in study.runs
                                                         if r.name in dict(found.failed))
    found.left_s = waiting / rate if rate else None
    return found


def said(folder: Path, found: Look) -> Iterator[str]:
    """The look as lines."""
    states = ", ".join(f"{found.states[state]} {state}" for state in STATES if found.states[state])
    asked = sum(found.states.values())
    yield f"{folder}: {asked} run{'s' * (asked != 1)} asked for: {states}"
    left = f", about {_minutes(found.left_s)} left" if found.left_s is not None else ""
    yield (f"  {found.episodes_done:,} of {found.episodes:,} episodes"
           f"{'' if found.over else f', {found.cycles_per_s:,.0f} cycles/s'}{left}")
    room = max(11, shutil.get_terminal_size().columns - 44)
    width = max([11, *(len(name) for name in found.conditions if len(name) <= room)])
    yield f"  {'survival of':{width}}  complete   training  validation      now"
    for name, of in found.conditions.items():
        means = [_percent(values) for values in (of.train, of.validation, of.living)]
        if len(name) > width:  # a line of its own
            yield f"  {name}"
        yield (f"  {name if len(name) <= width else '':{width}}  {of.complete:>4}/{of.asked:<4}  {means[0]:>8}  "
               f"{means[1]:>10}  {means[2]:>7}")
    for run, who, done, episodes, silent in found.running[:20]:
        quiet = f", silent for {silent:.0f} s" if silent > SILENT_S else ""
        yield f"  running: {run}: {done:,}/{episodes:,} episodes ({who}{quiet})"
    silent_more = [r for r in found.running[20:] if r[4] > SILENT_S]
    yield from (f"  silent for {silent:.0f} s: {run} ({who})" for run, who, _, _, silent in silent_more)
    yield from (f"  left behind: {run}: {why}" for run, why in found.gone[:20])
    yield from (f"  failed: {run}: {why}" for run, why in found.failed[:20])
    for word, more in (("running", found.running), ("failed", found.failed)):
        if len(more) > 20:
            yield f"  and {len(more) - 20} more {word}"


def _plans(study: StudyFile) -> dict[str, tuple[int, int]]:
    """(episodes, most cycles of one) of a run of each condition."""
    return {c.name: (int(c.config["train_episodes"]) + int(c.config["validation_episodes"]),
                     int(c.config["max_cycles"])) for c in study.conditions}


def _state(about: dict[str, Any], standing: claim.Standing | None) -> str:
    if standing and not standing.dead:
        return "running"
    status = str(about.get("status"))
    if status == "running" or about.get("interrupted"):
        return "interrupted"
    return status if status in STATES else "missing"


def _add_numbers(of: OfCondition, numbers: dict[str, Any]) -> None:
    halves = [v for v in (numbers.get("early"), numbers.get("late")) if isinstance(v, float)]
    if halves:
        of.train.append(sum(halves) / len(halves))
    if isinstance(numbers.get("validation"), float):
        of.validation.append(numbers["validation"])


def _percent(values: list[float]) -> str:
    return f"{sum(values) / len(values):.1%}" if values else "-"


def _minutes(seconds: float) -> str:
    return f"{seconds:.0f} s" if seconds < 120 else f"{seconds / 60:.0f} min" if seconds < 7200 else \
        f"{seconds / 3600:.1f} h"


def watched(folder: Path, every_s: float) -> Iterator[str]:
    """The look as one text, again and again until nobody is at work."""
    while True:
        found = look(folder)
        yield "\n".join(said(folder, found))
        if found.over:
            return
        time.sleep(every_s)
