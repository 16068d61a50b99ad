"""``python -m attnlab.arena``: all ways to decide when to look, in worlds and on logs, on one page.

    python -m attnlab.arena --log FILE                          every way on a log, in blocks
    python -m attnlab.arena --worlds paper,open --seeds 10      every way in worlds, as a study that can be resumed
    python -m attnlab.arena --study outputs/STUDY               the same of a study that is there
    python -m attnlab.arena --log FILE --ways q_learning,mine   some ways, one's own among them
    python -m attnlab.arena --log FILE --carry RUN              and a clock that was learned in simulation
    python -m attnlab.arena --log FILE --add THEIRS.jsonl       and results of others

Writes ``index.html``, ``arena.md`` and ``leaderboard.jsonl`` to --out (outputs/arena).
"""

from __future__ import annotations

import argparse
import shlex
import sys
from collections.abc import Sequence
from pathlib import Path

from attnlab.arena.board import Row, merged, read_board, write_board
from attnlab.arena.drive import Decide, Drive, Task, read_drive
from attnlab.arena.page import page, plain, strip
from attnlab.arena.places import carried_rows, fixed_curve, log_rows, world_overrides, world_rows
from attnlab.arena.summary import Standing, standings
from attnlab.arena.ways import BETWEEN, DEFAULT, EPOCHS, decide_by, make, train, way
from attnlab.console import guarded
from attnlab.errors import ConfigError
from attnlab.loading import load_all
from attnlab.logs.command import settings_of
from attnlab.logs.file import Log
from attnlab.registry import make as make_part
from attnlab.streams import stream
from attnlab.tables.code import code
from attnlab.tables.files import write_bytes

NOTES = (
    "Equal information: every way is told the percept at its own looks and no other. A way with a star learned from "
    "the percepts between its looks as well, which only a log can give; the same way without them is in the table, "
    "too.",
    "Equal training: all learn from the same blocks of a log (the other half of it), or the same number of episodes. "
    "Ways that learn nothing were set by hand.",
    "Equal looks: 'saved' is the harm of a clock of fixed period that looks as often, less the way's own, on the same "
    "blocks or seeds. A way outside of what fixed clocks span has no such number.",
    "On a log a clock does not move the robot: what was seen is what whoever drove then came by. Knowing in time is "
    "judged, not acting.",
    "Who knows the future is no rival: it is the least cost that any looks could have had, at this price.",
    "Ways have their default settings; nobody's were tuned here. A leaderboard of defaults says little of what a way "
    "could do at its best.")


def main(argv: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m attnlab.arena", description="Compare ways to decide when to look.")
    parser.add_argument("--ways", help="learners, with commas between; all that are here if left out")
    parser.add_argument("--log", type=Path, action="append", default=[], help="a log of a real robot; may be repeated")
    parser.add_argument("--set", action="append", default=[], dest="settings", metavar="NAME=VALUE", help="of the logs")
    parser.add_argument("--worlds", default="", help="worlds, with commas between")
    parser.add_argument("--study", type=Path, help="a study that is there: learners in worlds")
    parser.add_argument("--seeds", type=int, default=6, help="of every way")
    parser.add_argument("--price", type=float, default=0.5, help="of a look: in wrong cycles, or in lost survival")
    parser.add_argument("--onset", type=float, default=0.6, help="nearer than this is near, on logs, in m")
    parser.add_argument("--epochs", type=int, default=EPOCHS, help="passes over what is learned on, on logs")
    parser.add_argument("--carry", type=Path, action="append", default=[], help="a run whose clock is tried on logs")
    parser.add_argument("--add", type=Path, action="append", default=[], help="a leaderboard of others")
    parser.add_argument("--out", type=Path, default=Path("outputs/arena"), help="folder to write to")
    parser.add_argument("overrides", nargs="*", help="of the study in worlds: train_episodes=100 ...")
    given = parser.parse_intermixed_args(argv)
    load_all()
    checked(given)
    task = Task(given.onset, given.price)
    names = given.ways.split(",") if given.ways else [*DEFAULT, BETWEEN]
    for name in names:
        way(name, task)
    told = {"command": f"python -m attnlab.arena {shlex.join(argv)}", "code": code()}
    added = [row for file in given.add for row in read_board(file)]
    drives = [read_drive(Log(file, settings_of(given.settings))) for file in given.log]
    given.out.mkdir(parents=True, exist_ok=True)
    rows: list[Row] = []
    curves, strips = {}, {}
    for drive in drives:
        for line in drive.told:
            print(f"attnlab: {drive.name}: {line}", file=sys.stderr)
        rows += log_rows(drive, names, task, given.seeds, told, given.epochs)
        for run in given.carry:
            rows += carried_rows(drive, run, task, told)
        curves[drive.name] = {f"block {i}": curve for i, curve in enumerate(fixed_curve(drive, task))}
        strips[drive.name] = strip(drive, drive.blocks()[1][0], task, deciders(drive, names, task, given.epochs))
    if given.study:
        rows += world_rows(given.study, {**told, "study": given.study.name})
    if given.worlds:
        from attnlab.cli.calls import swept
        more = [*(() if any(o.startswith("simulator=") for o in given.overrides) else ("simulator=planar",)),
                *given.overrides]
        overrides = world_overrides(names, given.worlds.split(","), given.seeds, "arena_worlds", more)
        rows += world_rows(swept(overrides), {**told, "overrides": overrides})
    rows = merged(rows, added)
    found: dict[str, list[Standing]] = {}
    for place in dict.fromkeys(row.place for row in rows):
        found[place] = standings([row for row in rows if row.place == place], curves.get(place))
    write_board(rows, given.out / "leaderboard.jsonl")
    write_bytes(given.out / "index.html", page(found, strips, given.price, told, NOTES).encode())
    write_bytes(given.out / "arena.md", plain(found, given.price).encode())
    print(plain(found, given.price).partition("\n## ")[0].strip())
    print(given.out / "index.html")
    return 0


def checked(given: argparse.Namespace) -> None:
    """Raise ConfigError for what cannot be, before anything runs."""
    if not given.log and not given.worlds and not given.add and not given.study:
        raise ConfigError("--log", "no place to compete in was named", "--log FILE, or --worlds paper,open")
    for name, low, high in (("seeds", 1, 10_000), ("epochs", 1, 100_000), ("price", 0.0, 1e6), ("onset", 0.05, 1.0)):
        value = getattr(given, name)
        if not low <= value <= high:
            raise ConfigError(f"--{name}", f"is {value}, must be from {low} to {high:g}")
    if given.study and not given.study.is_dir():
        raise ConfigError("--study", f"there is no folder {given.study}")
    if given.carry and not given.log:
        raise ConfigError("--carry", "is for logs", "--log FILE")
    if given.overrides and not given.worlds:
        raise ConfigError(given.overrides[0], "is for the study in worlds", "--worlds paper,open")


def deciders(drive: Drive, names: Sequence[str], task: Task, epochs: int) -> dict[str, Decide]:
    """Each way, learned on the even blocks, as it decides on an odd one."""
    found = {}
    greedy = make_part("exploration", {"name": "greedy"}, None)
    for name in names:
        learner = make(way(name, task), task, 0)
        if learner.learns:
            train(learner, drive, [s for block in drive.blocks()[0::2] for s in block], task, 0, epochs)
        learner.start()
        found[name] = decide_by(learner, greedy, stream(0, "judged", 1))
    return found


if __name__ == "__main__":
    sys.exit(guarded(main))
