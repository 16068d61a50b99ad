"""Differences between conditions, paired by seed, with Student's t intervals over seeds."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pandas as pd

    from attnlab.results.load import Study

COLUMNS = ("quantity", "unit", "treatment", "control", "seeds", "treatment_mean", "control_mean", "difference", "low",
           "high")
Values = dict[str, tuple[str, "pd.Series"]]  # quantity -> (unit, value by condition and seed)


def quantities(study: Study) -> Values:
    """What conditions are compared by. Rewards are of the validation episodes that were survived, extrinsic part."""
    train, valid = (study.episodes[study.episodes["phase"] == phase] for phase in ("train", "validation"))
    half = (int(train["episode"].max()) + 1) / 2
    found: Values = {}

    def add(name: str, unit: str, rows: pd.DataFrame, values: pd.Series) -> None:
        found[name] = unit, values.groupby([rows["condition"], rows["seed"]], observed=True).mean()
    for name, rows in (("survival, first half of training", train[train["episode"] < half]),
                       ("survival, second half", train[train["episode"] >= half]), ("survival, validation", valid)):
        add(name, "%", rows, 100 * rows["survival"])
    add("crashed, validation", "%", valid, 100.0 * (valid["death"] == "crash"))
    for name, unit in (("safety", "1"), ("safety_held", "1"), ("hunger", "UoE"), ("thirst", "UoE"), ("energy", "UoE")):
        if f"{name}_mean" in valid:
            add(name, unit, valid, valid[f"{name}_mean"])
    add("cycles with somebody active", "mc", valid, valid["active_cycles"])
    of = study.behaviours[study.behaviours["phase"] == "validation"]
    lived = of.merge(valid.loc[valid["death"] == "none", ["run", "episode"]])
    for name in of["behaviour"].unique():
        mine, paid = of[of["behaviour"] == name], lived[lived["behaviour"] == name]
        add(f"activations of {name.upper()}", "1", mine, mine["activations"])
        add(f"extrinsic reward of {name.upper()}, survived", "UoR", paid, paid["reward_extrinsic"])
    return found


def rows(study: Study, pairs: Iterable[tuple[str, str]]) -> list[dict[str, object]]:
    """A row a pair and quantity; a pair of which a condition has no runs has none."""
    from attnlab.stats import t_interval
    values, found = quantities(study), []
    names = list(dict.fromkeys(study.named().values()))
    wanted = [(one, other) for first, other in pairs for one in ([first] if first else names) if one != other]
    for one, other in dict.fromkeys(wanted):
        for quantity, (unit, of) in values.items():
            if {one, other} <= set(of.index.get_level_values(0)):
                both = of[one].to_frame("one").join(of[other].rename("other"), how="inner").dropna()
                ends = t_interval(both["one"] - both["other"])
                cells = (quantity, unit, one, other, len(both), both["one"].mean(), both["other"].mean(),
                         *map(float, ends[:3]))
                found.append(dict(zip(COLUMNS, cells, strict=True)))
    return found


def write(file: Path, found: Iterable[Mapping[str, object]]) -> None:
    """As CSV; numbers with six digits."""
    with file.open("w", newline="") as sink:
        writer = csv.writer(sink, lineterminator="\n")
        writer.writerow(COLUMNS)
        for row in found:
            writer.writerow([f"{v:.6g}" if isinstance(v, float) else v for v in row.values()])
