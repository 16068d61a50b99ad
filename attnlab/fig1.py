"""``python -m attnlab.fig1 RUN``: the paper's Fig 1 from a run of GIVE: when the hand was looked at, its speed, its
distance. Nothing is simulated again: periods are the run's, the hand's trajectory is in its config."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from attnlab.console import guarded
from attnlab.errors import ConfigError
from attnlab.loading import load_all
from attnlab.results.one import read_run

if TYPE_CHECKING:
    import pandas as pd


def timeline(folder: Path, behaviour: str = "give") -> pd.DataFrame:
    """A row a cycle: t_s, active, period (mc), speed_m_s, distance_m."""
    import pandas as pd

    from attnlab.robot.plan import RunPlan
    load_all()
    cycles, config = read_run(folder)
    if config["simulator"].get("name") != "scripted" or f"{behaviour}_period" not in cycles:
        raise ConfigError(str(folder), f"is no run of {behaviour} before a scripted hand",
                          "python -m attnlab +experiment=give")
    simulator = RunPlan(config).simulator()
    rows = []
    for cycle in cycles["cycle"]:
        simulator.cycle = int(cycle)
        rows.append(simulator.hand())
    distance, speed = zip(*rows, strict=True)
    return pd.DataFrame({"t_s": cycles["cycle"] * simulator.dt_s, "active": cycles[f"{behaviour}_active"],
                         "period": cycles[f"{behaviour}_period"], "speed_m_s": speed, "distance_m": distance})


def draw(rows: pd.DataFrame, behaviour: str, path: Path) -> Path:
    """Three panels as in the paper: activations and period, speed, distance."""
    from attnlab.figures.style import BLUE, VERMILLION, drawing, save_png
    with drawing():
        import matplotlib.pyplot as plt
        figure, (top, middle, bottom) = plt.subplots(3, 1, figsize=(8.6, 5.6), sharex=True)
        looks = rows[rows["active"]]
        top.step(rows["t_s"], rows["period"], where="post", color=BLUE)
        top.plot(looks["t_s"], [0.0] * len(looks), "|", color=VERMILLION, markersize=12, markeredgewidth=1.2)
        top.set(ylabel="period (cycles)", ylim=(-1.2, None),
                title=f"A  {behaviour}: its period, and when it looked (ticks)")
        middle.plot(rows["t_s"], rows["speed_m_s"], color=BLUE)
        middle.set(ylabel="m/s", title="B  speed of the hand")
        bottom.plot(rows["t_s"], rows["distance_m"], color=BLUE)
        bottom.set(ylabel="m", xlabel="time (s)", ylim=(0, None), title="C  distance of the hand from the end-effector")
        return save_png(figure, path)


def main(argv: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m attnlab.fig1", description="Draw the paper's Fig 1 from a run.")
    parser.add_argument("run", type=Path, help="folder of a run of +experiment=give")
    parser.add_argument("--behaviour", default="give", help="whose clock to draw")
    parser.add_argument("--out", type=Path, help="file to write; fig1.png in the run's folder if left out")
    given = parser.parse_args(argv)
    path = given.out or given.run / "fig1.png"
    print(draw(timeline(given.run, given.behaviour), given.behaviour, path))
    return 0


if __name__ == "__main__":
    sys.exit(guarded(main))
