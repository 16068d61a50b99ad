"""Where ways compete: logs, played here, and worlds, played as a study."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from attnlab.arena.board import Row
from attnlab.arena.drive import Drive, Score, Task, judge, oracle
from attnlab.arena.ways import BETWEEN, compete, fixed, way
from attnlab.clock import Clock
from attnlab.errors import ConfigError

ORACLE = "(knows the future)"


def log_rows(drive: Drive, names: Sequence[str], task: Task, seeds: int, made: dict[str, Any], epochs: int
             ) -> list[Row]:
    """A row a way and block, the mean over seeds; and one of who knows the future."""
    rows = []
    for name in names:
        chosen = way(name, task)
        runs = [compete(chosen, drive, task, seed, epochs) for seed in range(seeds)]
        for block, scores in enumerate(zip(*runs, strict=True)):
            rows.append(_row(drive, name, block, scores, chosen.between,
                             {**made, "settings": dict(chosen.node), "seeds": seeds}))
    rows += [_row(drive, ORACLE, block, [oracle(drive, stretches, task)], False, made)
             for block, stretches in enumerate(drive.blocks())]
    return rows


def carried_rows(drive: Drive, run: Path, task: Task, made: dict[str, Any]) -> list[Row]:
    """A clock that AVOID learned in a run, on every block of a log."""
    clock = Clock.from_run(str(run), "avoid")
    if (clock.bins, clock.low, clock.high) != (task.bins, 0.0, task.sigma_max_m) or \
            tuple(clock.periods) != task.periods:
        raise ConfigError("--carry", f"the clock of {run.name} has other percepts or periods than the arena")
    table = clock.table[0]
    return [_row(drive, f"{clock.about['learner']} (from simulation)", block,
                 [judge(drive, stretches, task, lambda action, percept: table[action][percept])], False,
                 {**made, "settings": clock.about}) for block, stretches in enumerate(drive.blocks())]


def fixed_curve(drive: Drive, task: Task) -> list[list[tuple[float, float]]]:
    """(looks, harm) of clocks of fixed period on each block."""
    return [[(s.looks / s.cycles, (s.blind + s.needless) / s.cycles) for s in scores]
            for scores in zip(*fixed(drive, task), strict=True)]


def _row(drive: Drive, name: str, block: int, scores: Sequence[Score], between: bool, made: dict[str, Any]) -> Row:
    n, total = len(scores), Score()
    for score in scores:
        total.add(score)
    seen = total.onsets - total.missed
    detail = {"onsets": total.onsets / n, "missed": total.missed / n, "blind": total.blind / total.cycles,
              "delay_s": total.delays / seen * drive.cycle_s if seen else 0.0}
    return Row(drive.name, name, f"block {block}", total.looks / total.cycles,
               (total.blind + total.needless) / total.cycles, detail, between, made)


def world_rows(study: Path, made: dict[str, Any]) -> list[Row]:
    """A row a run: looks a cycle and behaviour, lost survival (1 - its mean), from validation episodes."""
    from attnlab.results.load import load
    from attnlab.results.states import read_config
    loaded = load(str(study))
    episodes, behaviours = loaded.episodes, loaded.behaviours
    episodes = episodes[episodes["phase"] == "validation"]
    behaviours = behaviours[behaviours["phase"] == "validation"]
    if episodes.empty:
        raise ConfigError("--study", f"{study} holds no validation episode")
    rows = []
    for run, mine in episodes.groupby("run"):
        looks = behaviours[behaviours["run"] == run]
        cycles = float(mine["cycles"].sum())
        config = read_config(study / str(run)) or {}
        survival = float(mine["survival"].mean())
        rows.append(Row(f"world {config['world']['name']}", config["learner"]["name"], f"seed {config['seed']}",
                        float(looks["activations"].sum()) / cycles / looks["behaviour"].nunique(),
                        min(1.0, max(0.0, 1.0 - survival)),
                        {"deaths": float((mine["death"] != "none").mean()), "safety": float(mine["safety_mean"].mean()),
                         "energy": float(mine["energy_mean"].mean())}, False, made))
    return rows


def world_overrides(names: Sequence[str], worlds: Sequence[str], seeds: int, study: str, more: Sequence[str]
                    ) -> list[str]:
    """What to type for the study of ways x worlds."""
    playing = [name for name in names if name != BETWEEN]
    return [f"learner={','.join(playing)}", f"world={','.join(worlds)}", f"seed=0-{seeds - 1}", "curiosity=none",
            f"study={study}", "picture=false", "report=false", "record=none", *more]
