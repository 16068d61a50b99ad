"""What the page shows of one episode, as plain data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from attnlab.errors import ConfigError
from attnlab.replay.again import Lived
from attnlab.replay.model import body_of, model_of
from attnlab.replay.seen import COLUMNS, sense_again
from attnlab.results.old import upgraded
from attnlab.results.one import no_run
from attnlab.results.states import read_config, state_of
from attnlab.robot.plan import RunPlan

if TYPE_CHECKING:
    import pandas as pd

SURPRISING = 0.9  # liking of a percept that was seen once at most among the ten before it


@dataclass
class Recorded:
    """A complete run read back: its folder, run.json, config and plan, and the tables that hold an episode."""
    folder: Path
    about: Mapping[str, Any]
    config: Mapping[str, Any]
    plan: RunPlan

    def table(self, name: str) -> pd.DataFrame:
        import pyarrow.parquet as pq
        try:
            found = pq.read_table(self.folder / f"{name}.parquet", partitioning=None)
        except Exception as cause:  # noqa: BLE001  whatever the reader makes of a damaged file
            raise ConfigError(str(self.folder), f"{name}.parquet cannot be read: {cause}",
                              "Run it again with fresh=true") from None
        frame: pd.DataFrame = upgraded(found, name, self.about).to_pandas()
        return frame


def open_run(folder: Path) -> Recorded:
    """Raises ConfigError unless this is a complete run whose parts are all here."""
    if not folder.is_dir():
        raise ConfigError(str(folder), "there is no such run", "Name a run: outputs/<study>/<run>")
    status, why, about = state_of(folder)
    if status != "complete":
        raise no_run(folder, f"{status}: {why}")
    config = read_config(folder)
    if config is None:
        raise ConfigError(str(folder), "config.yaml is missing or unreadable", "Run it again with fresh=true")
    try:
        return Recorded(folder, about, config, RunPlan(config))
    except ConfigError as cause:
        gone = [name for name in about.get("plugins") or {} if not Path(name).is_file()]
        if not gone:
            raise
        raise ConfigError(cause.setting, cause.problem, f"The run was made with {', '.join(gone)}, not here any more: "
                          "put it back, or go where it is") from None


def choose(run: Recorded, phase: str | None, episode: int | None) -> tuple[str, int, pd.DataFrame | None]:
    """(phase, episode, its recorded cycles or None): the last recorded episode unless another is asked for."""
    cycles, episodes = run.table("cycles"), run.table("episodes")
    if phase is None and episode is None and len(cycles):
        last = cycles[["phase", "episode"]].iloc[-1]
        phase, episode = str(last["phase"]), int(last["episode"])
    if phase is None:
        phase = "validation" if (episodes["phase"] == "validation").any() else "train"
    there = episodes.loc[episodes["phase"] == phase, "episode"]
    if there.empty:
        raise ConfigError("--phase", f"the run has no {phase} episodes")
    if episode is None:
        episode = int(there.iloc[-1])
    if not (there == episode).any():
        raise ConfigError("--episode", f"there is no {phase} episode {episode}", f"They go from 0 to {there.max()}")
    mine = cycles[(cycles["phase"] == phase) & (cycles["episode"] == episode)]
    return phase, episode, mine.reset_index(drop=True) if len(mine) else None


def agrees(one: pd.DataFrame, two: pd.DataFrame) -> bool:
    """Are these the same poses?"""
    import numpy as np
    names = ["x_m", "y_m", "heading_rad"]
    return len(one) == len(two) and bool(np.array_equal(one[names].to_numpy(), two[names].to_numpy()))


def track_of(run: Recorded, phase: str, episode: int, cycles: pd.DataFrame | None, lived: Lived | None,
             notes: list[str]) -> dict[str, Any]:
    """The track of an episode. ``lived``: the same lived again, if it was; what is worth saying goes to ``notes``."""
    shown = cycles if cycles is not None else lived.cycles if lived is not None else None
    assert shown is not None, "neither recorded nor lived again"
    if cycles is not None and lived is not None and not agrees(cycles, lived.cycles):
        notes.append(f"{run.folder.name}: this version of attnlab or of a plugin no longer lives this episode as it "
                     "was recorded, so there is no what-if.")
        lived = None
    if shown["x_m"].isna().any():
        raise ConfigError(str(run.folder), "its log says nowhere where the robot was, so there is nothing to draw",
                          "python -m attnlab.report STUDY shows the rest")
    plan, start = run.plan, run.plan.start_pose(phase, episode)
    sensed = sense_again(plan, shown, start, phase, episode)
    if sensed.wrong:
        looks = sum(map(len, sensed.looks.values()))
        notes.append(f"{run.folder.name}: {sensed.wrong} of {looks} percepts are not those that were recorded; sonar "
                     "and camera are shown as this version has them.")
    episodes = run.table("episodes")
    row = episodes[(episodes["phase"] == phase) & (episodes["episode"] == episode)].iloc[0]
    model, why = model_of(plan, phase, lived.before if lived is not None else None, start)
    needs = body_of(plan).needs
    starts = {need.name: need.start for need in needs}
    return {
        "run": run.folder.name, "label": label_of(run), "seed": int(run.config["seed"]), "phase": phase,
        "episode": episode, "n": len(shown), "most": plan.reading.max_cycles, "dt": plan.reading.dt_s,
        "death": str(row["death"]), "start": list(start), **_poses(shown),
        "needs": [{"name": need.name, "unit": need.unit, "deadly": need.death_at, "v": _short(shown[need.name])}
                  for need in needs],
        "energy": _short(shown["energy"]), "well": plan.reading.energy_well, "full": plan.reading.energy_max,
        "wanting": _short(shown["wanting"], 4), "safety": _short(shown["safety"], 4),
        "held": _short(shown["safety_held"], 4), "columns": list(COLUMNS),
        "looks": {name: [[_cell(value) for value in look] for look in rows] for name, rows in sensed.looks.items()},
        "fans": {cycle: [round(r, 4) for r in fan] for cycle, fan in sensed.fans.items()},
        "blobs": {cycle: [[round(v, 4) for v in blob] for blob in seen] for cycle, seen in sensed.blobs.items()},
        "meals": meals(shown, starts), "tables": tables_of(run.table("policy")),
        "periods": list(plan.settings.periods), "model": model, "why": why}


def label_of(run: Recorded) -> str:
    """What the run's condition is called in its study."""
    condition = run.about.get("condition")
    labels = run.config.get("labels") or {}
    curiosity = str(run.config["curiosity"]["name"])
    return str(condition or labels.get(curiosity) or f"curiosity={curiosity}")


def meals(cycles: pd.DataFrame, starts: Mapping[str, float]) -> list[list[Any]]:
    """[cycle, need] wherever a need fell; ``starts``: its value before the first cycle."""
    import numpy as np
    return sorted([int(cycle), need] for need, start in starts.items()
                  for cycle in np.flatnonzero(np.diff(cycles[need].to_numpy(), prepend=start) < 0))


def tables_of(policy: pd.DataFrame) -> dict[str, dict[str, list[float]]]:
    """By behaviour and state ("level|period|percept"): the value of each period, in the order of the periods."""
    found: dict[str, dict[str, list[float]]] = {}
    order = ["behaviour", "curiosity_level", "period", "percept"]
    for (behaviour, level, period, percept), rows in policy.groupby(order, sort=False):
        found.setdefault(str(behaviour), {})[f"{level}|{period}|{percept}"] = [round(q, 3) for q in rows["q"].tolist()]
    return found


def _poses(cycles: pd.DataFrame) -> dict[str, list[float]]:
    return {short: [round(value, 11) for value in cycles[name].tolist()]
            for short, name in (("x", "x_m"), ("y", "y_m"), ("h", "heading_rad"))}


def _short(values: pd.Series, digits: int = 2) -> list[float | None]:
    return [None if value is None or value != value else round(float(value), digits) for value in values.tolist()]


def _cell(value: Any) -> Any:
    return int(value) if isinstance(value, bool) else round(value, 5) if isinstance(value, float) else value
