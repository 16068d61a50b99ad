"""Table 5 side by side: the paper, here, and the difference, for each role of the claims file.

None of the paper's 100 validation episodes can have died: deviations of 2 and 9 hold no -1500. Its cells are compared
on episodes that were survived; the other form, all episodes with penalties as eqs 7-9 have them, stands beside it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from attnlab.audit.table import Cell, Table
from attnlab.console import table_width
from attnlab.measures.frames import of_seeds, phase_rows
from attnlab.measures.once import once_a_study
from attnlab.results.conditions import Conditions, Runs
from attnlab.tables.csvs import csv_bytes

UNITS = {"energy": "UoE", "safety": "0-1", "hunger": "UoE", "thirst": "UoE", "reward": "UoR",
         "activations": "1", "active_cycles": "mc"}
NAMES = {"energy_max": "energy, largest", "energy_min": "energy, smallest", "energy_mean": "energy, mean",
         "safety_max": "safety, largest", "safety_min": "safety, smallest", "safety_mean": "safety, mean",
         "hunger_mean": "hunger, mean", "thirst_mean": "thirst, mean",
         "active_cycles": "cycles with an active behaviour"}


class Here(NamedTuple):
    """A cell as found: mean over seeds of their episode means, deviation over the episodes of a seed (root of the mean
    variance; what the paper's is), and deviation between the seeds' means."""
    mean: float
    within: float
    between: float


@dataclass
class Row:
    """One cell of Table 5. ``here``: over validation episodes that were survived, ``every``: over all of them, rewards
    with penalties; None where there are none."""
    quantity: str
    condition: str
    paper: Cell | None
    here: Here | None
    every: Here | None
    undecided: bool

    @property
    def name(self) -> str:
        group, _, behaviour = self.quantity.partition(".")
        return NAMES.get(self.quantity) or f"{group}, {behaviour.upper() if behaviour != 'global' else 'all'}"

    @property
    def unit(self) -> str:
        return UNITS.get(self.quantity) or UNITS.get(self.quantity.replace(".", "_").partition("_")[0], "")

    @property
    def difference(self) -> float | None:
        return self.here.mean - self.paper.mean if self.here and self.paper else None


def rows(table: Table, roles: Mapping[str, Runs]) -> list[Row]:
    """A row for every quantity and condition of the paper's table; ``roles``: condition's label -> its runs."""
    found = []
    for quantity, cells in table.cells.items():
        for condition in table.conditions:
            runs = roles.get(condition)
            here, every = (_here(quantity, runs, survived) if runs is not None and runs.runs else None
                           for survived in (True, False))
            found.append(Row(quantity, condition, cells.get(condition), here, every,
                             table.is_undecided(quantity, condition)))
    return found


def _here(quantity: str, runs: Runs, survived: bool) -> Here | None:
    cells = [cell for cell in of_seeds(runs, _by_run(runs.conditions, quantity, survived)).values()
             if np.isfinite(cell[0])]
    if not cells:
        return None
    means, variances = np.array(cells).T
    known = variances[np.isfinite(variances)]
    return Here(float(means.mean()), float(np.sqrt(known.mean())) if known.size else float("nan"),
                float(means.std(ddof=1)) if means.size > 1 else float("nan"))


@once_a_study
def _by_run(conditions: Conditions, quantity: str, survived: bool) -> dict[str, tuple[float, float]]:
    """Run -> (mean, variance) of a quantity over its validation episodes, or those of them that were survived."""
    group, _, behaviour = quantity.partition(".")
    rows = phase_rows(conditions, "behaviours" if behaviour else "episodes", "validation")
    if (group if behaviour else quantity) not in rows or not len(rows):
        return {}
    if survived:
        episodes = phase_rows(conditions, "episodes", "validation")
        rows = rows.merge(episodes.loc[episodes["death"] == "none", ["run", "episode"]])
    if behaviour:
        mine = rows if behaviour == "global" else rows[rows["behaviour"] == behaviour]
        value = mine[group] + mine["penalty"] if group == "reward" else mine[group]
        values = value.groupby([mine["run"], mine["episode"]], observed=True).sum()
    else:
        values = rows.set_index(["run", "episode"])[quantity]
    of_run = values.groupby(level="run", observed=True)
    return {str(run): (float(mean), float(variance)) for run, mean, variance in
            zip(of_run.mean().index, of_run.mean(), of_run.var(ddof=1), strict=True)}


def number(value: float | None, like: float | None = None, sign: bool = False) -> str:
    """A number with the digits that its size deserves."""
    if value is None or not np.isfinite(value):
        return "-"
    size = abs(like if like is not None else value)
    digits = 2 if size < 2 else 1 if size < 20 else 0
    text = f"{value:+.{digits}f}" if sign else f"{value:.{digits}f}"
    return text.replace("-", "−") if sign else text


def texts(row: Row) -> tuple[str, str, str, str]:
    """(paper, here, difference, all episodes) as shown."""
    paper = "-"
    if row.paper:
        digits = 2 if row.paper.rounding < 0.1 else 0
        paper = f"{row.paper.mean:.{digits}f}" + (f" ± {row.paper.sd:.{digits}f}" if row.paper.sd else "")
        paper += " †" if row.undecided else ""
    like = row.paper.mean if row.paper else None
    here = f"{number(row.here.mean, like)} ± {number(row.here.within, like)}" if row.here else "-"
    if row.here and np.isfinite(row.here.between):
        here += f" ({number(row.here.between, like)})"
    every = number(row.every.mean, like) if row.every else "-"
    return paper, here, number(row.difference, like, sign=True), every


def as_csv(tables: list[tuple[str, list[Row]]]) -> bytes:
    """All tables in long form; ``tables``: (combination of the other settings, rows)."""
    heads = ["settings", "quantity", "unit", "condition", "paper_mean", "paper_sd", "here_mean", "here_sd_within_seeds",
             "here_sd_between_seeds", "difference", "all_mean", "all_sd_within_seeds", "all_sd_between_seeds",
             "undecided"]
    lines = list[list[object]]()
    nothing = (float("nan"),) * 3
    for stratum, of in tables:
        for row in of:
            paper = (row.paper.mean, row.paper.sd) if row.paper else (None, None)
            numbers = (*paper, *(row.here or nothing), row.difference, *(row.every or nothing))
            lines.append([stratum, row.quantity, row.unit, row.condition,
                          *("" if v is None or not np.isfinite(v) else f"{v:.6g}" for v in numbers),
                          "yes" if row.undecided else ""])
    return csv_bytes(heads, lines)


def print_table(of: list[Row], title: str) -> None:
    """The table in the terminal."""
    from rich.console import Console
    from rich.table import Table as Shown
    from rich.text import Text
    labels = list(dict.fromkeys(row.condition for row in of))
    shown = Shown(title=Text(title), title_justify="left")
    shown.add_column("Table 5")
    for label in labels:
        for head in (f"{label}\npaper", "\nhere", "\ndiff.", "\nall"):
            shown.add_column(Text(head), justify="right", no_wrap=True)
    for quantity in dict.fromkeys(row.quantity for row in of):
        mine = [row for row in of if row.quantity == quantity]
        shown.add_row(mine[0].name, *(Text(text) for row in mine for text in texts(row)))
    Console(width=table_width(118)).print(shown)
    print("here: episodes that were survived, ± within a seed (between seeds); all: every episode, with penalties")
    if any(row.undecided for row in of):
        print("† the paper's text does not tell which of two cells this is")
