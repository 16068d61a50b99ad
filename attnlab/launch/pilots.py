"""Which readings of a design are sound, found out by pilots before the study: runs of seeds that take no part in it."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from math import fsum
from pathlib import Path

import numpy as np

from attnlab.errors import ConfigError
from attnlab.launch.drive import complete
from attnlab.launch.expand import Expansion
from attnlab.launch.jobs import Job, check_once
from attnlab.launch.multiverse import confounded, imbalance
from attnlab.launch.place import check_place
from attnlab.launch.variants import Design, Pilot
from attnlab.stats.soundness import unsound
from attnlab.tables.readings import FILE, TABLE, Decided, Tried, read_decided, write_decided
from attnlab.tables.study import FILE as STUDY_FILE

LEAST = 2  # sound readings that make a multiverse


class UndecidedError(Exception):
    """Pilots failed, so that nobody knows which readings are sound."""

    def __init__(self, folder: Path, failed: int):
        super().__init__(f"{folder}: {failed} pilots failed, so that it is not known which readings are sound. The "
                         "same command runs them again.")
        self.folder = folder


def sound(design: Design, expansion: Expansion, typed: Sequence[str]) -> list[str]:
    """Names of the readings that make the study: as decided before, or else by pilots that are run now, as far as they
    are not there. A study that ran out of candidates may be given more, and keeps what it has. Raises ConfigError,
    :class:`UndecidedError`."""
    pilot = design.pilot
    assert pilot is not None
    first = expansion.jobs(design.variants([next(iter(design.levels))]))  # whatever is wrong comes before any pilot
    check_once(first)
    settings, folder = first[0].settings, first[0].folder.parent
    _check(pilot, expansion, sorted({job.settings.seed for job in first}))
    also = {"train_episodes": pilot.episodes, "validation_episodes": 0, "record": "none",
            "study": f"{settings.study}_pilots"}

    def pilots(names: Sequence[str]) -> list[Job]:
        return expansion.jobs(design.variants(names, [pilot.condition]), also, pilot.numbers)
    before, names = None if settings.fresh else read_decided(folder), list(design.levels)
    tried = before.tried if before else []
    if before is not None:
        known = names[:len(tried)]
        if [of.reading for of in tried] != known or before.mark != _mark(pilots(known), design):
            raise ConfigError("variants", f"{folder / FILE} was decided by other pilots, or another rule",
                              "study=NAME begins another study; fresh=true decides anew")
        if len(before.taken) == design.size or len(tried) == len(names):
            print(f"{folder}: {len(before.taken)} readings, as decided by pilots ({FILE})", flush=True)
            return before.taken
    else:
        _check_new(expansion, folder, settings.fresh)
    jobs = pilots(names)
    check_once(jobs)
    check_place(jobs)
    tried = _try(design, tried, jobs, typed)
    decided = Decided(_mark(jobs[:len(tried) * len(pilot.numbers)], design), rule_of(pilot), len(names), tried)
    take(decided, design.size)
    if len(decided.taken) < LEAST:
        raise ConfigError("variants.pilot", f"{len(decided.taken) or 'none'} of {len(decided.tried)} readings is sound "
                          f"({decided.rule})", f"The best survives "
                          f"{max(tried.survival for tried in decided.tried):.1f} %")
    write_decided(folder, decided)
    print(told(decided, folder), flush=True)
    return decided.taken


def _check(pilot: Pilot, expansion: Expansion, asked: Sequence[int]) -> None:
    """Raise ConfigError if the pilots would take part in the study, or if it would need several sets of them."""
    both = sorted(set(asked) & set(pilot.numbers))
    if both:
        raise ConfigError("variants.pilot.seeds", f"{both[0]} takes part in the study, too", "Choose others")
    for name in expansion.swept:
        if name != "seed":
            raise ConfigError(name, "cannot be swept beside variants.pilot: readings are chosen once",
                              "Write it into variants.conditions")


def _check_new(expansion: Expansion, folder: Path, fresh: bool) -> None:
    """Raise ConfigError if a multiverse cannot begin like this."""
    if len(expansion.seeds or ()) < 2:
        raise ConfigError("seed", "is one, and one seed cannot tell an effect from chance", "seed=0-9")
    if not fresh and (folder / STUDY_FILE).exists():
        raise ConfigError("study", f"{folder} was begun without pilots: what is sound was not decided before",
                          "study=NAME begins another study")


def _mark(jobs: Sequence[Job], design: Design) -> str:
    """What a decision hangs on: its pilots, and the rule."""
    pilot = design.pilot
    assert pilot is not None
    text = json.dumps([[job.key for job in jobs], pilot.survival, design.size])
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def rule_of(pilot: Pilot) -> str:
    """The rule in words."""
    return (f"{pilot.condition} survives more than {pilot.survival:g} % of {pilot.episodes} training episodes, mean of "
            f"seeds {pilot.seeds}, and somebody eats and drinks")


def _try(design: Design, tried: Sequence[Tried], jobs: Sequence[Job], typed: Sequence[str]) -> list[Tried]:
    """Those that were ``tried``, and the readings after them, in order, as many as it takes until there are enough
    sound ones; their pilots, of all ``jobs``, are run as far as they must."""
    pilot = design.pilot
    assert pilot is not None
    names, each, found = list(design.levels), len(pilot.numbers), list(tried)
    home = jobs[0].folder.parent
    print(f"{home}: pilots. Of {len(names)} readings the first {design.size} sound ones make the study: "
          f"{rule_of(pilot)}", flush=True)
    for first in range(len(found), len(names), design.size):
        some = names[first:first + design.size]
        print(f"{home}: {some[0]} to {some[-1]}" + f"; {_sound(found)} of {first} before them are sound" * (first > 0),
              flush=True)
        mine = jobs[first * each:(first + len(some)) * each]
        failed = complete(mine, typed)
        if failed:
            raise UndecidedError(home, len(failed))
        for i, name in enumerate(some):
            folders = [job.folder for job in mine[i * each:(i + 1) * each]]
            found.append(judged(name, design.levels[name], folders, pilot))
            if _sound(found) == design.size:
                return found
    return found


def _sound(tried: Sequence[Tried]) -> int:
    return len([of for of in tried if not of.reason])


def judged(name: str, levels: dict[str, str], folders: Sequence[Path], pilot: Pilot) -> Tried:
    """A reading by its pilots' tables."""
    import pyarrow.parquet as pq
    tables = [pq.read_table(folder / "episodes.parquet", columns=["survival", "meals", "drinks"], partitioning=None)
              .to_pydict() for folder in folders]
    lived = [share for table in tables for share in table["survival"]]
    survival = 100 * fsum(lived) / len(lived)
    meals, drinks = (sum(count for table in tables for count in table[kind]) for kind in ("meals", "drinks"))
    return Tried(name, dict(levels), survival, meals, drinks, unsound(survival, meals, drinks, pilot.survival))


def take(decided: Decided, size: int) -> None:
    """Take the first ``size`` sound readings, and say how balanced they are."""
    for tried in [tried for tried in decided.tried if not tried.reason][:size]:
        tried.taken = True
    taken = [tried.levels for tried in decided.tried if tried.taken]
    if not taken:
        return
    known = {factor: list(dict.fromkeys(tried.levels[factor] for tried in decided.tried)) for factor in taken[0]}
    decided.counts = {factor: {level: len([of for of in taken if of[factor] == level]) for level in levels}
                      for factor, levels in known.items()}
    table = np.array([[levels.index(of[factor]) for factor, levels in known.items()] for of in taken])
    i, j, v = confounded(table)
    decided.confounded, decided.uneven = (list(known)[i], list(known)[j], v), imbalance(table)


def told(decided: Decided, folder: Path) -> str:
    """The decision in two lines."""
    shares = {(factor, level): len(decided.taken) / len(levels) - count for factor, levels in decided.counts.items()
              for level, count in levels.items()}
    (factor, level), _ = max(shares.items(), key=lambda item: abs(item[1]))
    one, other, v = decided.confounded
    return (f"{folder}: {decided.sound} of {len(decided.tried)} readings are sound ({decided.rule}); "
            f"{len(decided.taken)} are taken. {folder / TABLE} lists all, with reasons\n"
            f"balance: {factor}={level} is off its share most, with {decided.counts[factor][level]} of "
            f"{len(decided.taken)}; of all pairs of factors {one} and {other} tell most of each other (V = {v:.2f})")
