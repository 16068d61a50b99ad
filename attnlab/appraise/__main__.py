"""``python -m attnlab.appraise RUN --curiosity all``: what every model of curiosity makes of the same percepts.

The percepts of a recorded episode, or of a standard probe, are shown to each model as they came; nothing is driven and
nothing is learned from them but by the model. Writes ``appraisal.csv`` (a row a look and model), ``appraisal.md``
and ``appraisal.png`` to the run's folder or --out.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from attnlab.appraise.page import write
from attnlab.appraise.views import appraise, chosen, probes, recorded
from attnlab.console import guarded
from attnlab.loading import load_all
from attnlab.results.one import read_run
from attnlab.robot.guards import verdict
from attnlab.robot.plan import RunPlan


def main(argv: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m attnlab.appraise",
                                     description="Show the percepts of a run to models of curiosity.")
    parser.add_argument("run", type=Path, help="folder of a complete run")
    parser.add_argument("--curiosity", default="all", help="all, or names with commas between")
    parser.add_argument("--out", type=Path, help="folder to write to; that of the run if left out")
    given = parser.parse_args(argv)
    load_all()
    names = chosen(given.curiosity)

    import pandas as pd

    cycles, config = read_run(given.run)
    experiment = RunPlan(config)
    reading, behaviours = experiment.reading, list(config["behaviours"])
    views = list(recorded(cycles, behaviours, reading.energy_start,
                          experiment.start_pose(str(cycles["phase"].iat[0]), int(cycles["episode"].to_numpy()[0]))))
    standard, told = probes(reading.percept_bins, reading.energy_max), {}
    with experiment.simulator() as simulator:
        for name in names:
            try:
                told[name] = (appraise(views, [name], reading, simulator),
                              {probe: appraise(shown, [name], reading) for probe, shown in standard.items()})
            except Exception as cause:  # noqa: BLE001  one model that fails harms no other
                print(f"attnlab: curiosity={name} is left out: {verdict(cause)}", file=sys.stderr)
    if not told:
        return 1
    table = pd.concat([rows for rows, _ in told.values()], ignore_index=True)
    probed = {probe: pd.concat([rows[probe] for _, rows in told.values()], ignore_index=True) for probe in standard}
    out = given.out or given.run
    out.mkdir(parents=True, exist_ok=True)
    for path in write(table, probed, list(told), out):
        print(path)
    return 0 if len(told) == len(names) else 1


if __name__ == "__main__":
    sys.exit(guarded(main))
