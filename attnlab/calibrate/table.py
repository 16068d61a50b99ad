"""The figures of the verdict engine: how often it is wrong where nothing is, how many seeds it needs."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from attnlab.calibrate.plant import Effect, findings, noise, studies
from attnlab.claims import rules as decide
from attnlab.claims.files import Claims
from attnlab.claims.parts import Claim
from attnlab.errors import ConfigError
from attnlab.tables.csvs import csv_bytes

GRID = (6, 8, 10, 12, 15, 20, 30, 40, 60, 80, 120, 200, 400)
POWER = 0.8
HEADS = ("claim", "title", "planted", "seeds", "false_reproduced", "false_reproduced_high", "false_contradicted",
         "false_contradicted_high", "false_holds", "power_holds", "power_reproduced", "seeds_to_hold",
         "seeds_to_reproduce", "noise")
Samples = Mapping[tuple[str, int], Mapping[int, float]]  # (claim, part) -> seed -> what it contributed


@dataclass
class Row:
    """A rule. Rates (0-1) at ``seeds`` seeds with the upper end of their one-sided 95 % interval; ``to_hold``: the
    fewest seeds of the grid with which it holds in 80 % of studies with the paper's effect, None for more than 400 or,
    without ``known`` noise, for nobody knows."""
    id: str
    title: str
    planted: int
    seeds: int
    false_reproduced: tuple[float, float]
    false_contradicted: tuple[float, float]
    false_holds: float
    power_holds: float
    power_reproduced: float
    to_hold: int | None
    to_reproduce: int | None
    known: bool


def read_seeds(path: Path) -> Samples:
    """What every seed contributed, from a report's seeds.csv (or the study whose report has one), of the first
    combination of settings. Raises ConfigError."""
    file = path / "report" / "seeds.csv" if path.is_dir() else path
    if not file.is_file():
        raise ConfigError(str(path), "has no seeds.csv", f"Make the report first: python -m attnlab.report {path}")
    found: dict[tuple[str, int], dict[int, float]] = {}
    try:
        rows = list(csv.DictReader(io.StringIO(file.read_text())))
        settings = rows[0]["settings"] if rows else ""
        for row in rows:
            if row["settings"] == settings:
                found.setdefault((row["claim"], int(row["part"])), {})[int(row["seed"])] = float(row["value"])
    except (KeyError, TypeError, ValueError, UnicodeDecodeError) as cause:
        raise ConfigError(str(file), f"is no seeds.csv of a report ({type(cause).__name__}: {cause})") from None
    if not found:
        raise ConfigError(str(file), "has no rows: no claim could be tested")
    return found


def calibrate(claims: Claims, samples: Samples, planted: int, seeds: int, seed: int = 0) -> list[Row]:
    """A row for each claim."""
    if seeds < claims.rules.least_seeds:
        raise ConfigError("--seeds", f"is {seeds}, and under {claims.rules.least_seeds} seeds there is no verdict",
                          f"The rules of {claims.path.name} say least_seeds: {claims.rules.least_seeds}")
    return [_row(claims, key, claim, samples, planted, seeds, seed) for key, claim in claims.claims.items()]


def _row(claims: Claims, key: str, claim: Claim, samples: Samples, planted: int, seeds: int, seed: int) -> Row:
    counting = [i for i, part in enumerate(claim.parts) if part.counts]
    parts = [claim.parts[i] for i in counting]
    of = noise(parts, [samples.get((key, i), {}) for i in counting])

    def codes(effect: Effect, n: int) -> npt.NDArray[np.int64]:
        rng = np.random.default_rng([seed, *key.encode(), n, effect == "paper"])
        return findings(parts, studies(parts, of, effect, n, planted, rng), claims.rules, effect, rng)
    nothing, there = codes("none", seeds), codes("paper", seeds)
    hold, same = None, None
    for n in (n for n in GRID if of.known and n >= claims.rules.least_seeds):
        now = codes("paper", n)
        hold = n if hold is None and (now >= decide.DIRECTION).mean() >= POWER else hold
        same = n if same is None and (now == decide.REPRODUCED).mean() >= POWER else same
        if hold and same:
            break
    return Row(key, claim.title, planted, seeds, rate(nothing == decide.REPRODUCED),
               rate(nothing == decide.CONTRADICTED), float((nothing >= decide.DIRECTION).mean()),
               float((there >= decide.DIRECTION).mean()), float((there == decide.REPRODUCED).mean()), hold, same,
               of.known)


def rate(hits: npt.NDArray[np.bool_]) -> tuple[float, float]:
    """(share, upper end of its exact one-sided 95 % interval, Clopper and Pearson 1934)."""
    from scipy.stats import beta
    k, n = int(hits.sum()), hits.size
    return k / n, float(beta.ppf(0.95, k + 1, n - k)) if k < n else 1.0


def as_csv(rows: Sequence[Row]) -> bytes:
    lines = list[list[object]]()
    for row in rows:
        rates = (*row.false_reproduced, *row.false_contradicted, row.false_holds, row.power_holds, row.power_reproduced)
        lines.append([row.id, row.title, row.planted, row.seeds, *(f"{x:.6f}" for x in rates),
                      *(_seeds(x, row.known) for x in (row.to_hold, row.to_reproduce)),
                      "of the tables" if row.known else "standard"])
    return csv_bytes(HEADS, lines)


def _seeds(found: int | None, known: bool) -> str:
    return "not known" if not known else f"more than {GRID[-1]}" if found is None else str(found)


def as_markdown(rows: Sequence[Row]) -> str:
    """The table of docs/claims.md."""
    lines = ["| claim | false reproduced | false contradicted | holds, at the paper's effect | seeds to hold "
             "| seeds to reproduce |", "|---|---:|---:|---:|---:|---:|"]
    for row in rows:
        wrong = [f"{100 * value:.1f} % (≤ {100 * high:.1f})" for value, high in (row.false_reproduced,
                                                                                row.false_contradicted)]
        power = f"{100 * row.power_holds:.0f} %" if row.known else "not known"
        lines.append(f"| {row.id} {row.title} | {wrong[0]} | {wrong[1]} | {power} | {_seeds(row.to_hold, row.known)} "
                     f"| {_seeds(row.to_reproduce, row.known)} |")
    return "\n".join(lines)
