"""``python -m attnlab.appraise RUN --curiosity all``: what every model of curiosity makes of the same percepts.

The percepts of a recorded episode, of a real robot's log (``--log FILE``), or of a standard probe, are shown to each
model as they came; nothing is driven and nothing is learned from them but by the model. Writes ``appraisal.csv`` (a row
a look and model), ``appraisal.md`` and ``appraisal.png`` to the run's folder, ``outputs/appraisal-<log>``, or --out.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from itertools import islice
from pathlib import Path
from typing import Any

from attnlab.appraise.page import write
from attnlab.appraise.views import View, appraise, chosen, logged, probes, recorded
from attnlab.console import guarded
from attnlab.errors import ConfigError
from attnlab.loading import load_all
from attnlab.logs.command import add_arguments, log_of
from attnlab.logs.file import Log
from attnlab.reading import Reading
from attnlab.results.one import read_run
from attnlab.robot.guards import verdict
from attnlab.robot.plan import RunPlan

MOST = 20_000  # scans of a log that are shown


def main(argv: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m attnlab.appraise",
                                     description="Show the percepts of a run, or of a log, to models of curiosity.")
    parser.add_argument("run", type=Path, nargs="?", help="folder of a complete run")
    parser.add_argument("--log", type=Path, help="in place of a run: a log of a real robot")
    add_arguments(parser)
    parser.add_argument("--curiosity", default="all", help="all, or names with commas between")
    parser.add_argument("--out", type=Path, help="folder to write to")
    given = parser.parse_args(argv)
    load_all()
    names = chosen(given.curiosity)
    if (given.run is None) == (given.log is None):
        raise ConfigError("run", "name a run's folder, or a log by --log FILE" if given.run is None else
                          "a run and a log were given", "python -m attnlab.appraise outputs/STUDY/RUN")
    if given.log is not None:
        return of_log(log_of(given), names, given.out)
    if given.format or given.settings:
        raise ConfigError("--set" if given.settings else "--format", "is for a log", "--log FILE")
    return of_run(given.run, names, given.out or given.run)


def of_run(folder: Path, names: Sequence[str], out: Path) -> int:
    """Appraise a run's last recorded episode."""
    cycles, config = read_run(folder)
    experiment = RunPlan(config)
    reading, behaviours = experiment.reading, list(config["behaviours"])
    views = list(recorded(cycles, behaviours, reading.energy_start,
                          experiment.start_pose(str(cycles["phase"].iat[0]), int(cycles["episode"].to_numpy()[0]))))
    with experiment.simulator() as simulator:
        return told(views, names, reading, simulator, out, "the recorded episode")


def of_log(log: Log, names: Sequence[str], out: Path | None) -> int:
    """Appraise the percepts that AVOID would have had in every cycle of a log, under the default reading."""
    reading = Reading()
    views = list(islice(logged(log, reading), MOST))
    if not views:
        raise ConfigError("log", f"{log.path.name} holds no scan that can be used", " ".join(log.ledger.lines()[:1]))
    for line in log.ledger.lines():
        print(f"attnlab: {log.path.name}: {line}", file=sys.stderr)
    what = f"the first {MOST} scans of {log.path.name}" if len(views) == MOST else log.path.name
    name = log.path.name.partition(".")[0] or "log"
    return told(views, names, reading, None, out or Path("outputs") / f"appraisal-{name}",
                f"{what}, looked at in every cycle by a robot whose energy is full")


def told(views: Sequence[View], names: Sequence[str], reading: Reading, simulator: Any, out: Path, what: str) -> int:
    """Show the views and the probes to each model and write what they make of them."""
    import pandas as pd
    standard, found = probes(reading.percept_bins, reading.energy_max), {}
    for name in names:
        try:
            found[name] = (appraise(views, [name], reading, simulator),
                           {probe: appraise(shown, [name], reading) for probe, shown in standard.items()})
        except Exception as cause:  # noqa: BLE001  one model that fails harms no other
            print(f"attnlab: curiosity={name} is left out: {verdict(cause)}", file=sys.stderr)
    if not found:
        return 1
    table = pd.concat([rows for rows, _ in found.values()], ignore_index=True)
    probed = {probe: pd.concat([rows[probe] for _, rows in found.values()], ignore_index=True) for probe in standard}
    out.mkdir(parents=True, exist_ok=True)
    for path in write(table, probed, list(found), out, what):
        print(path)
    return 0 if len(found) == len(names) else 1


if __name__ == "__main__":
    sys.exit(guarded(main))
