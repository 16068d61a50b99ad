"""``python -m attnlab.arena``: all ways to decide when to look, in worlds and on logs, on one page.

    python -m attnlab.arena                                     every way in the four worlds, 10 seeds
    python -m attnlab.arena --worlds all --log FILE --log FILE --read FILE     and on logs, and logs that are only read
    python -m attnlab.arena --log FILE                          every way on a log, in blocks, and in no world
    python -m attnlab.arena --study outputs/STUDY               the same of a study that is there
    python -m attnlab.arena --log FILE --ways q_learning,mine   some ways, one's own among them
    python -m attnlab.arena --log FILE --carry RUN              and a clock that was learned in simulation
    python -m attnlab.arena --log FILE --train-prices 0.25,1    and ways that learned at other prices of a look
    python -m attnlab.arena --cap 4 --look-cost 2,8             all under a cap of looks a second; e_nb of eq 10, swept
    python -m attnlab.arena --log FILE --add THEIRS.jsonl       and results of others

Writes ``index.html``, ``arena.md``, ``standings.csv``, ``ranks.csv``, ``leaderboard.jsonl`` to --out (outputs/arena).
"""

from __future__ import annotations

import argparse
import shlex
import sys
from collections.abc import Sequence
from typing import Any

from attnlab.arena import worlds
from attnlab.arena.asked import checked, parsed, places_of
from attnlab.arena.board import merged, read_board, short, write_board
from attnlab.arena.drive import Drive, Task, read_drive, read_only
from attnlab.arena.page import page
from attnlab.arena.places import Trial, carried_rows, deciders, fixed_curve, future_rows, log_rows
from attnlab.arena.strips import strip, world_strips
from attnlab.arena.summary import standings
from attnlab.arena.ways import BETWEEN, DEFAULT, learning
from attnlab.arena.words import plain, ranks_csv, standings_csv
from attnlab.console import guarded
from attnlab.loading import load_all
from attnlab.logs.command import settings_of
from attnlab.logs.file import Log
from attnlab.tables.code import code, package_hash
from attnlab.tables.files import write_bytes

NOTES = (
    "Equal information: every way is told the percept at its own looks and no other. A way with a star learned from "
    "the percepts between its looks as well, which only a log can give; the same way without them is in the table, "
    "too.",
    "Equal training: all learn from the same blocks of a log (the other half of it), or the same number of episodes. "
    "Ways that learn nothing were set by hand.",
    "Equal looks: 'saved' is the harm of a clock of fixed period that looks as often, less the way's own, on the same "
    "blocks or seeds. In worlds clocks of any mean period ('steady') stand between the fixed ones. A way outside of "
    "what these span has no such number.",
    "These clocks have one period for all behaviours of a robot. A way that saves may do so by giving AVOID more looks "
    "than the others and not by what it sees: 'fixed_12 avoid=8' and 'avoid=4' do that blindly.",
    "Better and worse are said of ways whose 'saved' differs from zero by the paired t test, corrected by Holm for all "
    "ways of the place (5 % together); intervals are each on its own. 'of resamples': in how many of 1,000 resampled "
    "sets of seeds or blocks a way is on the front.",
    "Blocks of a log are not independent: those of one half were judged with the same learned clock, and neighbours "
    "are alike. Intervals over blocks are therefore too narrow rather than too wide.",
    "On a log a clock does not move the robot: what was seen is what whoever drove then came by. Knowing in time is "
    "judged, not acting.",
    "Who knows the future is no rival: it is the least cost that any looks could have had, at this price.",
    "Ways have their default settings; nobody's were tuned here. A leaderboard of defaults says little of what a way "
    "could do at its best.")


def main(argv: Sequence[str]) -> int:
    given = parsed(argv)
    load_all()
    names = given.ways.split(",") if given.ways else [*DEFAULT, BETWEEN]
    task, where = Task(given.onset, given.price), places_of(given)
    checked(given, names, where, task)
    told: dict[str, Any] = {"command": shlex.join(["python", "-m", "attnlab.arena", *argv]),
                            "code": {**code(), "hash": package_hash(("arena", "logs"))}}
    added = [row for file in given.add for row in read_board(file)]
    studies = [worlds.opened(given.study)] if given.study else []
    drives = [read_drive(Log(file, settings_of(given.settings))) for file in given.log]
    read = [read_only(Log(file, settings_of(given.settings))) for file in given.read]
    carried = [row for drive in drives for run in given.carry for row in carried_rows(drive, run, task, told)]
    if where:
        from attnlab.cli.calls import swept
        for typed in worlds.commands(names, where, given.seeds, given.name, given.cap, given.look_cost,
                                     given.overrides):
            folder = swept(typed)
        studies.append(worlds.opened(folder))
    trials = [trial for drive in drives for trial in trials_of(drive, names, task, given)]
    rows = [*log_rows(trials, told), *carried,
            *(row for drive in drives for row in future_rows(drive, task, told))]
    for drive in drives:
        for line in drive.told:
            print(f"attnlab: {drive.name}: {line}", file=sys.stderr)
    strips = {drive.name: strip(drive, drive.blocks()[1][0], task,
                                deciders(drive, names, task, given.epochs, per_cycle(drive, given.cap)))
              for drive in drives}
    missing = []
    for study in studies:
        rows += worlds.world_rows(study, {**told, "study": study.name})
        strips |= world_strips(study)
        missing += worlds.told(study)
    rows = merged([short(row) for row in rows], [short(row) for row in added])
    curves = {drive.name: fixed_curve(drive, task) for drive in drives}
    found = {place: standings([row for row in rows if row.place == place], curves.get(place))
             for place in dict.fromkeys(row.place for row in rows)}
    given.out.mkdir(parents=True, exist_ok=True)
    write_board(rows, given.out / "leaderboard.jsonl")
    for name, content in (
            ("index.html", page(found, strips, given.price, told, [*missing, *NOTES], read).encode()),
            ("arena.md", plain(found, given.price).encode()), ("standings.csv", standings_csv(found)),
            ("ranks.csv", ranks_csv(found))):
        write_bytes(given.out / name, content)
    print(plain(found, given.price).partition("\n## ")[0].strip())
    print(*(f"read only: {line}" for line in read), *missing, given.out / "index.html", sep="\n")
    return 0


def per_cycle(drive: Drive, cap: float | None) -> float | None:
    """A cap a second as one a cycle of the log, on which there is one behaviour."""
    return None if cap is None else cap * drive.cycle_s


def trials_of(drive: Drive, names: Sequence[str], task: Task, given: argparse.Namespace) -> list[Trial]:
    """All ways on a drive, and those that learn at other prices as well."""
    free = per_cycle(drive, given.cap)
    found = [Trial(drive, name, name, task, given.seeds, given.epochs, free) for name in names]
    for price in given.train_prices:
        other = Task(task.onset_m, price)
        found += [Trial(drive, name, f"{name} price={price:g}", other, given.seeds, given.epochs, free)
                  for name in names if learning(name, other)]
    return found


if __name__ == "__main__":
    sys.exit(guarded(main))
