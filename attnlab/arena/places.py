"""Ways on logs, played here: on as many cores as there are."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from attnlab.arena.board import Row
from attnlab.arena.drive import Decide, Drive, Score, Task, judge, oracle
from attnlab.arena.ways import compete, decide_by, fixed, make, train, way
from attnlab.clock import Clock
from attnlab.errors import ConfigError
from attnlab.registry import make as make_part
from attnlab.streams import stream
from attnlab.tables.processes import cores

ORACLE = "(knows the future)"
WORTH = 400  # passes over a drive by all ways and seeds together, above which processes of their own pay


@dataclass(frozen=True)
class Trial:
    """A way on a drive: what a process is asked for. ``called``: the way's name in the table; ``per_cycle``: looks a
    cycle that it may not exceed."""
    drive: Drive
    name: str
    called: str
    task: Task
    seeds: int
    epochs: int
    per_cycle: float | None = None

    def __call__(self) -> list[list[Score]]:
        """Of each seed, the score of each block."""
        chosen = way(self.name, self.task, self.per_cycle)
        return [compete(chosen, self.drive, self.task, seed, self.epochs) for seed in range(self.seeds)]


def log_rows(trials: Sequence[Trial], made: Mapping[str, Any], jobs: int | None = None) -> list[Row]:
    """A row a trial and block, the mean over seeds; the same whatever the number of processes."""
    rows = []
    for trial, runs in zip(trials, played(trials, jobs), strict=True):
        chosen = way(trial.name, trial.task, trial.per_cycle)
        about = {**made, "settings": dict(chosen.node), "seeds": trial.seeds, "price": trial.task.price}
        for block, scores in enumerate(zip(*runs, strict=True)):
            rows.append(_row(trial.drive, trial.called, block, scores, chosen.between, about))
    return rows


def played(trials: Sequence[Trial], jobs: int | None = None) -> Iterator[list[list[Score]]]:
    """What the trials came to, in their order."""
    jobs = min(jobs or cores(), len(trials))
    if jobs < 2 or sum(trial.seeds * trial.epochs for trial in trials) < WORTH:
        yield from (trial() for trial in trials)
        return
    with get_context("spawn").Pool(jobs, _begin) as pool:
        yield from pool.imap(_play, trials)


def _begin() -> None:
    from attnlab.loading import load_all
    load_all()


def _play(trial: Trial) -> list[list[Score]]:
    return trial()


def future_rows(drive: Drive, task: Task, made: Mapping[str, Any]) -> list[Row]:
    """Who knows the future, on every block."""
    return [_row(drive, ORACLE, block, [oracle(drive, stretches, task)], False, made)
            for block, stretches in enumerate(drive.blocks())]


def carried_rows(drive: Drive, run: Path, task: Task, made: Mapping[str, Any]) -> list[Row]:
    """A clock that AVOID learned in a run, on every block of a log."""
    clock = Clock.from_run(str(run), "avoid")
    if (clock.bins, clock.low, clock.high) != (task.bins, 0.0, task.sigma_max_m) or \
            tuple(clock.periods) != task.periods:
        raise ConfigError("--carry", f"the clock of {run.name} has other percepts or periods than the arena")
    table = clock.table[0]
    return [_row(drive, f"{clock.about['learner']} (from simulation)", block,
                 [judge(drive, stretches, task, lambda action, percept: table[action][percept])], False,
                 {**made, "settings": clock.about}) for block, stretches in enumerate(drive.blocks())]


def fixed_curve(drive: Drive, task: Task) -> dict[str, list[tuple[float, float]]]:
    """(looks, harm) of clocks of fixed period on each block."""
    return {f"block {block}": [(s.looks / s.cycles, (s.blind + s.needless) / s.cycles) for s in scores]
            for block, scores in enumerate(zip(*fixed(drive, task), strict=True))}


def deciders(drive: Drive, names: Sequence[str], task: Task, epochs: int, per_cycle: float | None
             ) -> dict[str, Decide]:
    """Each way, learned on the even blocks, as it decides on an odd one."""
    found = {}
    greedy = make_part("exploration", {"name": "greedy"}, None)
    for name in names:
        learner = make(way(name, task, per_cycle), task, 0)
        if learner.learns:
            train(learner, drive, [s for block in drive.blocks()[0::2] for s in block], task, 0, epochs)
        learner.start()
        found[name] = decide_by(learner, greedy, stream(0, "judged", 1))
    return found


def _row(drive: Drive, name: str, block: int, scores: Sequence[Score], between: bool, made: Mapping[str, Any]) -> Row:
    n, total = len(scores), Score()
    for score in scores:
        total.add(score)
    seen = total.onsets - total.missed
    detail = {"onsets": total.onsets / n, "missed": total.missed / n, "blind": total.blind / total.cycles,
              "delay_s": total.delays / seen * drive.cycle_s if seen else 0.0}
    return Row(drive.name, name, f"block {block}", total.looks / total.cycles,
               (total.blind + total.needless) / total.cycles, detail, between, dict(made))
