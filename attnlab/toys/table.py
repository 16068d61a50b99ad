"""The toys, who plays them, and the table of what came of it: a row for every way, toy, seed and quantity."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path
from typing import NamedTuple

from attnlab.claims.files import Claims, load_claims
from attnlab.claims.judge import Verdict, judge_roles
from attnlab.errors import ConfigError
from attnlab.measures.toys import QUANTITIES, ToyRuns
from attnlab.paths import conf_dir
from attnlab.tables.csvs import csv_bytes
from attnlab.testing.processes import BRIDGE, CHAIN, CLIFF, DISEASE, EVEN_ODD, ZIGZAG
from attnlab.toys import values
from attnlab.toys.chains import play_chain, play_chain_clock
from attnlab.toys.grids import play_grid
from attnlab.toys.patients import play_patients

FILES = ("temporl", "amrl", "timing", "values")  # claims, in conf/claims/toys
DIGITS = ".9g"
HEAD = ("toy", "learner", "seed", "quantity", "value")
GRID_EPISODES, CHAIN_EPISODES, PATIENT_EPISODES, LOOKS = 10_000, 700, 200, 20_000


class Task(NamedTuple):
    """``way`` playing ``toy``: ``play(seed, length)``, the length being in episodes, or in looks."""
    toy: str
    way: str
    length: int
    play: Callable[[int, int], dict[str, float]]


Told = dict[tuple[str, str], dict[int, dict[str, float]]]  # (toy, way) -> seed -> quantity -> value


def tasks() -> list[Task]:
    """All of them, those that take longest first."""
    found = []
    for toy, grid, kind in (("zigzag_linear", ZIGZAG, "linear"), ("zigzag", ZIGZAG, "constant"),
                            ("cliff", CLIFF, "constant"), ("bridge", BRIDGE, "constant")):
        found += [Task(toy, "tempo_rl", GRID_EPISODES, partial(play_grid, grid, kind=kind)),
                  Task(toy, "q_learning", GRID_EPISODES, partial(play_grid, grid, skips=(1,), kind=kind))]
    for toy, way, kind in (("disease", "timing", "one_step"), ("disease by delay", "timing", "each_delay"),
                           ("disease", "q_learning", "model_free")):
        found.append(Task(toy, way, PATIENT_EPISODES, partial(play_patients, DISEASE, way=kind)))
    for toy, chain in (("chain", CHAIN), ("even_odd", EVEN_ODD)):
        found += [Task(toy, "amrl", CHAIN_EPISODES, partial(play_chain, chain)),
                  Task(toy, "q_learning", CHAIN_EPISODES, partial(play_chain, chain, always=True))]
    found += [Task("chain for clocks", "amrl", CHAIN_EPISODES, partial(play_chain_clock, CHAIN)),
              Task("chain for clocks", "always_on", CHAIN_EPISODES, partial(play_chain_clock, CHAIN, always=True))]
    found += [Task("ring", play.__name__, LOOKS, play) for play in (values.tempo_rl, values.amrl, values.tacos)]
    found += [Task("walk", play.__name__, LOOKS, play)
              for play in (values.timing, values.self_triggered, values.bandwidth, values.regulations)]
    return [*found, Task("walk", "random", LOOKS, values.chance),
            Task("value iteration on the walk", "fixed", LOOKS, values.best)]


def play(seeds: Sequence[int], jobs: int, short: int = 1) -> Told:
    """Everything, by all seeds, on so many processes; lengths are divided by ``short``."""
    found: Told = {}
    asked = [(task, seed) for task in tasks() for seed in seeds]
    with ProcessPoolExecutor(jobs) as pool:
        playing = [pool.submit(task.play, seed, max(1, task.length // short)) for task, seed in asked]
        for (task, seed), future in zip(asked, playing, strict=True):
            found.setdefault((task.toy, task.way), {})[seed] = {  # as the table keeps them: it is what is judged
                name: float(f"{value:{DIGITS}}") for name, value in future.result().items()}
    return found


def as_csv(told: Told) -> bytes:
    return csv_bytes(HEAD, ([toy, way, seed, name, f"{value:{DIGITS}}"] for (toy, way), seeds in told.items()
                            for seed, of in seeds.items() for name, value in of.items()))


def read(file: Path) -> Told:
    """The table of a file that :func:`as_csv` wrote. Raises ConfigError."""
    found: Told = {}
    try:
        rows = list(csv.DictReader(io.StringIO(file.read_text())))
        for row in rows:
            found.setdefault((row["toy"], row["learner"]), {}).setdefault(int(row["seed"]), {})[
                row["quantity"]] = float(row["value"])
    except (OSError, KeyError, TypeError, ValueError) as cause:
        raise ConfigError("--table", f"{file} is no table of toys", f"It has the columns {', '.join(HEAD)}") from cause
    for row in rows:
        if not math.isfinite(float(row["value"])):
            raise ConfigError("--table", f"{file} has a value that is no number", f"{row['value']}, of {row['toy']}")
    if not rows or not {row["quantity"] for row in rows} <= set(QUANTITIES):
        raise ConfigError("--table", f"{file} is no table of toys", f"Its quantities are {', '.join(QUANTITIES)}")
    return found


def claims() -> dict[str, Claims]:
    """The papers' claims of their toys, by file."""
    return {name: load_claims(str(conf_dir() / "claims" / "toys" / f"{name}.yaml")) for name in FILES}


def judged(told: Told) -> dict[str, list[Verdict]]:
    """Verdicts by claims file. A role is a toy (``variant``) and who plays it (``learner``; all if it names none)."""
    def runs(where: Mapping[str, str]) -> ToyRuns:
        return ToyRuns(where, {seed: of for (toy, way), seeds in told.items() if toy == where.get("variant")
                               and where.get("learner", way) == way for seed, of in seeds.items()})
    return {name: judge_roles(of, {role: runs(asked.where) for role, asked in of.roles.items()},
                              {role: set() for role in of.roles}, {}) for name, of in claims().items()}
