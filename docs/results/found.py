"""What was found, in sentences whose numbers and words come from the tables of this folder."""

from __future__ import annotations

import csv
import io
import json
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from studies import BY_NAME, CR, FIXED, LEARNED, NCR, PLAIN, SAME

from attnlab.claims import DEFAULT, claims_hash
from attnlab.claims.findings import Finding

Row = dict[str, str]
MISSING = "This is not known yet: {} has not been made under today's rules."
EARLY, LATE, VALID = "survival, first half of training", "survival, second half", "survival, validation"
MORE, LESS, UNCLEAR = "more", "less", "neither clearly more nor clearly less"


def table(folder: Path, study: str, name: str) -> list[Row]:
    """Rows of a table of a study; none if it is not there."""
    file = folder / study / f"{name}.csv"
    return list(csv.DictReader(io.StringIO(file.read_text()))) if file.exists() else []


def made(folder: Path, study: str) -> dict[str, Any]:
    """What a study was made with; empty if that is not known, or if it was made under other rules than today's."""
    file = folder / study / "made.json"
    with_ = dict(json.loads(file.read_text())) if file.exists() else {}
    claims = BY_NAME[study].claims if study in BY_NAME else DEFAULT
    return with_ if with_.get("claims_sha256") == claims_hash(claims) else {}


def contrast(folder: Path, study: str, quantity: str, treatment: str, control: str) -> Row | None:
    """One difference."""
    wanted = (quantity, treatment, control)
    return next((row for row in table(folder, study, "contrasts")
                 if (row["quantity"], row["treatment"], row["control"]) == wanted), None)


def side(row: Row, more: str = MORE, less: str = LESS, unclear: str = UNCLEAR) -> str:
    """The word for a difference: by its interval over seeds, never by its mean alone."""
    if not row["low"]:
        return unclear
    return more if float(row["low"]) > 0 else less if float(row["high"]) < 0 else unclear


def places(unit: str, size: float) -> int:
    """Digits after the point: of a unit, for numbers of this size."""
    return {"%": 1, "UoR": 1, "1": 2 if size < 2 else 1}.get(unit, 0)


def number(value: str, unit: str, size: float | None = None, sign: bool = False) -> str:
    """A number of a table as text, with the digits of numbers of this ``size`` (its own if left out); a dash if there
    is none."""
    if value in ("", "nan"):
        return "-"
    digits = places(unit, abs(float(value)) if size is None else size)
    return f"{float(value):{'+' if sign else ''}.{digits}f}"


def size(row: Row) -> float:
    """Of what a difference is between."""
    return max(abs(float(row[column])) for column in ("treatment_mean", "control_mean"))


def levels(row: Row) -> list[str]:
    """What a difference is between, as texts."""
    return [number(row[column], row["unit"], size(row)) for column in ("treatment_mean", "control_mean")]


def difference(row: Row) -> str:
    """``-1.5 [-2.0, -1.1] points``."""
    mean, low, high = (number(row[column], row["unit"], size(row), sign=True)
                       for column in ("difference", "low", "high"))
    unit = {"%": " points", "1": ""}.get(row["unit"], f" {row['unit']}")
    return f"{mean} [{low}, {high}]{unit}"


def against(row: Row) -> str:
    """``95.3 against 96.8 %, -1.5 [-2.0, -1.1] points``."""
    unit = {"%": " %", "1": ""}.get(row["unit"], f" {row['unit']}")
    one, other = levels(row)
    return f"{one} against {other}{unit}, {difference(row)}"


def verdicts(folder: Path, study: str) -> dict[str, Finding]:
    """Claim -> verdict, where the study has one combination of settings."""
    return {row["claim"]: Finding(row["verdict"]) for row in table(folder, study, "verdicts")}


def counts(found: dict[str, Finding]) -> str:
    """``4 reproduced, 2 direction with number compatible, 7 direction only, ...``, worst last."""
    of = Counter(found.values())
    return ", ".join(f"{of[finding]} {finding.replace(', ', ' with ')}" for finding in Finding)


def sentences(folder: Path) -> list[str]:
    """The five sentences at the head of the page."""
    return [first(folder), second(folder), third(folder), fourth(folder), fifth(folder)]


def first(folder: Path) -> str:
    """How the claims fare."""
    found, with_ = verdicts(folder, "cr_vs_ncr"), made(folder, "cr_vs_ncr")
    if not found or not with_:
        return MISSING.format("cr_vs_ncr")
    return (f"Of the paper's {len(found)} claims, {counts(found)}: the curious robot (CR) held against the non-curious "
            f"one of 2012 ({PLAIN}) on pybullet with {with_['seeds']} seeds, by rules written before these runs.")


def second(folder: Path) -> str:
    """Survival against the control of the study."""
    rows = [contrast(folder, "cr_vs_ncr", quantity, CR, NCR) for quantity in (EARLY, LATE, VALID)]
    if None in rows:
        return MISSING.format("cr_vs_ncr")
    said = [f"{side(row)} {when} ({against(row)})" for row, when in
            zip(rows, ("in the first half of training", "in the second", "in validation"), strict=True) if row]
    return f"Against {PLAIN}, CR survives {said[0]}, {said[1]}, and {said[2]}."


def third(folder: Path) -> str:
    """The two controls: what the bigger table does and what curiosity does."""
    study = "bigger_table" if made(folder, "bigger_table") else "controls"  # the same conditions, more seeds
    early, bigger = (contrast(folder, study, EARLY, *pair) for pair in ((CR, SAME), (SAME, PLAIN)))
    safe = [contrast(folder, study, "safety", CR, control) for control in (SAME, PLAIN)]
    if early is None or bigger is None or None in safe:
        return MISSING.format(study)
    words = [f"{side(row, 'safer', 'less safe', 'neither clearly safer nor clearly less safe')} than {control} "
             f"({difference(row)})" for row, control in zip(safe, (SAME, PLAIN), strict=True) if row]
    costs = side(bigger, "gains", "costs", "neither clearly costs nor clearly gains")
    older = contrast(folder, "controls", EARLY, CR, SAME) if study != "controls" else None
    before = f"; the {older['seeds']} seeds of controls: {difference(older)}" if older else ""
    return (f"Against the same 72 states with nothing curious in the reward ({SAME}), CR survives {side(early)} in the "
            f"first half of training ({difference(early)}{before}), while the bigger table by itself, {SAME} against "
            f"{PLAIN}, {costs} survival there ({difference(bigger)}); CR is {words[0]} and {words[1]} "
            f"({study}, {early['seeds']} seeds).")


def fourth(folder: Path) -> str:
    """What learning is worth."""
    row = contrast(folder, "generations", VALID, FIXED, LEARNED)
    looks = [table_row(folder, "generations", name).get("activations", "") for name in (FIXED, LEARNED)]
    if row is None or not all(looks):
        return MISSING.format("generations")
    one, other = (sum(map(int, text.split())) for text in looks)
    return (f"A fixed period of 4 for everybody survives {side(row)} in validation than what is learned without "
            f"curiosity ({against(row)}, {row['seeds']} seeds), with {one} activations an episode against {other}.")


def fifth(folder: Path) -> str:
    """Whether it hangs on the simulator."""
    here, there = verdicts(folder, "cr_vs_ncr"), verdicts(folder, "cr_vs_ncr_planar")
    if not (here and there and made(folder, "cr_vs_ncr") and made(folder, "cr_vs_ncr_planar")):
        return MISSING.format("cr_vs_ncr on one of the two simulators")
    return f"On planar, {agreement(here, there)}."


def agreement(here: dict[str, Finding], there: dict[str, Finding]) -> str:
    """How two studies' verdicts agree."""
    both = sorted(set(here) & set(there), key=lambda claim: int(claim[1:]))
    same = sum(here[claim] == there[claim] for claim in both)
    apart = [claim for claim in both for a, b in ((here[claim], there[claim]), (there[claim], here[claim]))
             if a.holds and b == Finding.CONTRADICTED]
    opposite = f"claims that hold in one and are contradicted in the other: {', '.join(apart)}" if apart else \
        "no claim that holds in one is contradicted in the other"
    return f"{same} of {len(both)} verdicts are the same, and {opposite}"


def table_row(folder: Path, study: str, condition: str) -> Row:
    """A condition's row of conditions.csv; empty if there is none."""
    return next((row for row in table(folder, study, "conditions") if row["condition"] == condition), {})


def clearly(folder: Path, study: str, control: str, quantity: str) -> Iterator[tuple[str, str]]:
    """(condition, more or less) of those that differ clearly from a control."""
    for row in table(folder, study, "contrasts"):
        if (row["quantity"], row["control"]) == (quantity, control) and (word := side(row)) != UNCLEAR:
            yield row["treatment"], word
