"""Table 5 side by side: the paper, here, and the difference, for each role of the claims file."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from attnlab.audit.table import Cell, Table
from attnlab.measures.frames import means as run_means
from attnlab.measures.frames import of_seeds, phase_rows, split
from attnlab.measures.once import once_a_study
from attnlab.measures.rewards import sums
from attnlab.results.conditions import Conditions, Runs

UNITS = {"energy": "UoE", "safety": "0-1", "hunger": "UoE", "thirst": "UoE", "reward": "UoR",
         "activations": "1", "active_cycles": "mc"}
NAMES = {"energy_max": "energy, largest", "energy_min": "energy, smallest", "energy_mean": "energy, mean",
         "safety_max": "safety, largest", "safety_min": "safety, smallest", "safety_mean": "safety, mean",
         "hunger_mean": "hunger, mean", "thirst_mean": "thirst, mean",
         "active_cycles": "cycles with an active behaviour"}


@dataclass
class Row:
    """One cell of Table 5. ``here``: (mean over seeds of their episode means, deviation over episodes), or None."""
    quantity: str
    condition: str
    paper: Cell | None
    here: tuple[float, float] | None
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
        return self.here[0] - self.paper.mean if self.here and self.paper else None


def rows(table: Table, roles: Mapping[str, Runs]) -> list[Row]:
    """A row for every quantity and condition of the paper's table; ``roles``: condition's label -> its runs."""
    found = []
    for quantity, cells in table.cells.items():
        for condition in table.conditions:
            runs = roles.get(condition)
            here = _here(quantity, runs) if runs is not None and runs.runs else None
            found.append(Row(quantity, condition, cells.get(condition), here,
                             table.is_undecided(quantity, condition)))
    return found


def _here(quantity: str, runs: Runs) -> tuple[float, float] | None:
    import pandas as pd
    means, values = (of_seeds(runs, of) for of in _by_run(runs.conditions, quantity))
    episodes = pd.Series(np.concatenate(list(values.values()))) if values else pd.Series(dtype=float)
    if episodes.isna().all():
        return None
    spread = episodes.std(ddof=1) if len(episodes) > 1 else float("nan")
    return float(pd.Series(means).mean()), float(spread)


@once_a_study
def _by_run(conditions: Conditions, quantity: str) -> tuple[dict[str, float], dict[str, np.ndarray]]:
    """(run -> mean, run -> values) of a quantity in the validation episodes."""
    group, _, behaviour = quantity.partition(".")
    if behaviour:
        rows = sums(conditions, "validation", "all" if behaviour == "global" else behaviour, group, None)
    else:
        rows = phase_rows(conditions, "episodes", "validation").rename(columns={quantity: "value"})
    if "value" not in rows or not len(rows):
        return {}, {}
    return run_means(rows, "value"), {run: mine["value"].to_numpy(float) for run, mine in split(rows).items()}


def number(value: float | None, like: float | None = None, sign: bool = False) -> str:
    """A number with the digits that its size deserves."""
    if value is None or not np.isfinite(value):
        return "-"
    size = abs(like if like is not None else value)
    digits = 2 if size < 2 else 1 if size < 20 else 0
    text = f"{value:+.{digits}f}" if sign else f"{value:.{digits}f}"
    return text.replace("-", "−") if sign else text


def texts(row: Row) -> tuple[str, str, str]:
    """(paper, here, difference) as shown."""
    paper = "-"
    if row.paper:
        digits = 2 if row.paper.rounding < 0.1 else 0
        paper = f"{row.paper.mean:.{digits}f}" + (f" ± {row.paper.sd:.{digits}f}" if row.paper.sd else "")
        paper += " †" if row.undecided else ""
    like = row.paper.mean if row.paper else None
    here = f"{number(row.here[0], like)} ± {number(row.here[1], like)}" if row.here else "-"
    return paper, here, number(row.difference, like, sign=True)


def as_csv(tables: list[tuple[str, list[Row]]]) -> bytes:
    """All tables in long form; ``tables``: (combination of the other settings, rows)."""
    sink = io.StringIO()
    writer = csv.writer(sink, lineterminator="\n")
    writer.writerow(["settings", "quantity", "unit", "condition", "paper_mean", "paper_sd", "here_mean", "here_sd",
                     "difference", "undecided"])
    for stratum, of in tables:
        for row in of:
            paper = (row.paper.mean, row.paper.sd) if row.paper else (None, None)
            here = row.here or (None, None)
            writer.writerow([stratum, row.quantity, row.unit, row.condition,
                             *("" if v is None else f"{v:.6g}" for v in (*paper, *here, row.difference)),
                             "yes" if row.undecided else ""])
    return sink.getvalue().encode()


def print_table(of: list[Row], title: str) -> None:
    """The table in the terminal."""
    from rich.console import Console
    from rich.table import Table as Shown
    from rich.text import Text
    labels = list(dict.fromkeys(row.condition for row in of))
    shown = Shown(title=Text(title), title_justify="left")
    shown.add_column("Table 5")
    for label in labels:
        for head in (f"{label}\npaper", "\nhere", "\ndiff."):
            shown.add_column(Text(head), justify="right", no_wrap=True)
    for quantity in dict.fromkeys(row.quantity for row in of):
        mine = [row for row in of if row.quantity == quantity]
        shown.add_row(mine[0].name, *(Text(text) for row in mine for text in texts(row)))
    console = Console()
    if not console.is_terminal:
        console = Console(width=118)
    console.print(shown)
    if any(row.undecided for row in of):
        print("† the paper's text does not tell which of two cells this is")
