"""Tables of the project's own studies that no report has: the front of looks, the map of worlds, held levels."""

from __future__ import annotations

import csv
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from attnlab.results.conditions import Conditions
    from attnlab.results.load import Study

Rows = list[dict[str, object]]
ALL = "all"


def write(name: str, study: Study, target: Path) -> None:
    """Those of this study into a folder, if it has some."""
    from attnlab.results.conditions import Conditions
    for table, make in TABLES.get(name, {}).items():
        rows = make(Conditions(study))
        with (target / f"{table}.csv").open("w", newline="") as sink:
            writer = csv.DictWriter(sink, list(rows[0]) if rows else [], lineterminator="\n")
            writer.writeheader()
            writer.writerows({key: f"{value:.6g}" if isinstance(value, float) else value for key, value in row.items()}
                             for row in rows)


def ends(values: Iterable[float], prefix: str = "") -> dict[str, float]:
    """Mean over seeds with Student's t interval (95 %)."""
    from attnlab.stats import mean_interval
    return dict(zip((f"{prefix}{word}" for word in ("mean", "low", "high")), mean_interval(list(values)), strict=True))


def front(conditions: Conditions) -> Rows:
    """Of each condition under each cap: looks a second, the outcome, and whether it is on the front of both."""
    from attnlab.figures import budget_front
    rows: Rows = []
    for which in budget_front.SHOWN:
        spent = budget_front.spent(conditions, which)
        on = budget_front.front(spent)
        rows += [{"outcome": which, "condition": one.name, "cap": f"{one.cap:g}", "seeds": len(one.got),
                  **ends(one.looks.values(), "looks_"), **ends(one.got.values()), "on_front": int(one in on)}
                 for one in sorted(spent, key=lambda one: (one.cap, one.name))]
    return rows


def worlds(conditions: Conditions) -> Rows:
    """Of each world and comparison: the difference in survival over seeds."""
    from attnlab.figures.phase_map import ROWS, cells
    rows: Rows = []
    for title, row in ROWS.items():
        for (distance, obstacles, well), cell in sorted(cells(conditions).items()):
            step = cell.step(*row)
            if step is not None:
                rows.append({"what": title, "distance_m": distance, "obstacles": int(obstacles), "energy_well": well,
                             "sound": int(cell.sound), "seeds": step.seeds, "difference": step.value, "low": step.low,
                             "high": step.high})
    return rows


def together(conditions: Conditions) -> Rows:
    """The same over all sound worlds, and those of each E_well: a seed's mean difference over worlds, then over seeds;
    how many worlds are clearly better and worse."""
    import numpy as np

    from attnlab.figures.compared import survival
    from attnlab.figures.phase_map import ROWS, cells
    found, rows = cells(conditions), []
    for title, (one, other, which) in ROWS.items():
        for well in (None, *sorted({well for _, _, well in found})):
            of = [cell for place, cell in found.items() if cell.sound and well in (None, place[2])
                  and {one, other} <= set(cell.runs)]
            apart: dict[int, list[float]] = {}
            for cell in of:
                mine, theirs = survival(cell.runs[one], which), survival(cell.runs[other], which)
                for seed in sorted(set(mine) & set(theirs)):
                    apart.setdefault(seed, []).append(mine[seed] - theirs[seed])
            sides = [step.side for cell in of if (step := cell.step(one, other, which)) is not None]
            rows.append({"what": title, "energy_well": ALL if well is None else f"{well:g}", "worlds": len(of),
                         "better": sides.count(1), "worse": sides.count(-1), "seeds": len(apart),
                         **ends(float(np.mean(of_seed)) for of_seed in apart.values() if len(of_seed) == len(of))})
    return rows


def levels(conditions: Conditions) -> Rows:
    """Of each held level: looks in 100 cycles by behaviour, and the share of its states that were visited."""
    from attnlab.figures.compared import asked
    from attnlab.figures.held_levels import CLAMP, looks_in_100, visited
    rows: Rows = []
    behaviours = list(conditions.frame("behaviours")["behaviour"].unique())
    for one in asked(conditions):
        level = one.settings[CLAMP]
        quantities: dict[str, Mapping[int, float]] = {
            "looks in 100 cycles": looks_in_100(one.runs),
            **{f"looks of {name.upper()} in 100 cycles": looks_in_100(one.runs, name) for name in behaviours}}
        seen = visited(conditions, level)
        if seen:
            quantities["states visited in training, %"] = {seed: seen[run] for seed, run in one.runs.runs.items()}
        rows += [{"condition": conditions.labels.get(level, level), "quantity": quantity, "seeds": len(of),
                  **ends(of.values())} for quantity, of in quantities.items()]
    return rows


TABLES: dict[str, dict[str, Callable[[Conditions], Rows]]] = {
    "matched_budget": {"front": front},
    "where_curiosity_pays": {"map": worlds, "together": together},
    "clamped_levels": {"levels": levels},
}
