"""Which readings were kept: the study's readings.csv, if there is one, with the casualties of the filter and the
balance of what is left. Columns: reading, one a factor, sound (true/false), reason, survival, meals, kept."""

from __future__ import annotations

import csv
import io
from collections import Counter
from collections.abc import Mapping, Sequence
from html import escape
from pathlib import Path

from attnlab.report.page import Section, table

FILE = "readings.csv"
OWN = ("reading", "sound", "reason", "survival", "meals", "kept")
MOST = 40  # casualties on the page
Rows = list[Mapping[str, str]]


def section(study: Path) -> tuple[Section | None, str]:
    """(the section, a note): nothing if there is no file, a note alone if it cannot be read."""
    path = study / FILE
    if not path.is_file():
        return None, ""
    try:
        rows: Rows = list(csv.DictReader(io.StringIO(path.read_text()), restval=""))
    except (OSError, UnicodeDecodeError, csv.Error) as cause:
        return None, f"{FILE} cannot be read ({cause})"
    missing = [name for name in OWN if rows and name not in rows[0]]
    if not rows or missing:
        what = f"has no column {missing[0]}" if rows else "has no rows"
        return None, f"{FILE} {what}, so that the filter is not shown"
    return _section(rows), ""


def _true(text: str | None) -> bool:
    return str(text).strip().lower() == "true"


def _section(rows: Rows) -> Section:
    kept = [row for row in rows if _true(row["kept"])]
    unsound = [row for row in rows if not _true(row["sound"])]
    spare = len(rows) - len(kept) - len([row for row in unsound if not _true(row["kept"])])
    factors = [name for name in rows[0] if name and name not in OWN]
    text = (f"{len(rows)} readings were tried on pilot runs of seeds that take no part; {len(unsound)} are not sound, "
            f"{len(kept)} were kept" + (f", {spare} sound ones were not needed" if spare else "") + ".")
    reasons = Counter(row["reason"].strip() or "no reason given" for row in unsound)
    parts = [f"<p>{escape(text)}</p>"]
    if unsound:
        told = "; ".join(f"{reason}: {count}" for reason, count in reasons.most_common(8))
        listed = [[row["reading"], row["reason"], row["survival"], row["meals"],
                   ", ".join(f"{name}={row[name]}" for name in factors)] for row in unsound[:MOST]]
        more = f" The first {MOST} of {len(unsound)}; all are in {FILE}." if len(unsound) > MOST else ""
        parts += [f"<p>{escape(told)}.</p>", "<details><summary>The casualties, one by one</summary>",
                  table(("reading", "reason", "survival", "meals", "levels"), listed, (2, 3)),
                  f"<p class=small>Survival and meals in the pilot runs.{more}</p></details>"]
    parts += ["<h3>Balance of what was kept</h3>", _balance(rows, kept, unsound, factors)]
    return Section("readings", "Which readings are sound", "".join(parts))


def _balance(rows: Rows, kept: Rows, unsound: Rows, factors: Sequence[str]) -> str:
    """How often each level was tried, fell and was kept, and how uneven the worst pair of factors is."""
    table_rows = []
    for name in factors:
        levels = list(dict.fromkeys(row[name] for row in rows))
        tried, fell, left = (Counter(row[name] for row in of) for of in (rows, unsound, kept))
        table_rows.append([name, *(", ".join(f"{level} {of[level]}" for level in levels)
                                   for of in (tried, fell, left))])
    worst = _worst(kept, factors)
    said = f"<p class=small>{escape(worst)}</p>" if worst else ""
    return table(("factor", "tried", "not sound", "kept"), table_rows) + said


def _worst(kept: Rows, factors: Sequence[str]) -> str:
    """The pair of levels that meet least evenly in what was kept."""
    found = []
    for i, one in enumerate(factors):
        for other in factors[:i]:
            met = Counter((row[one], row[other]) for row in kept)
            alone = Counter(row[one] for row in kept), Counter(row[other] for row in kept)
            found += [(abs(met[a, b] - alone[0][a] * alone[1][b] / len(kept)), one, a, other, b)
                      for a in alone[0] for b in alone[1]]
    if not found:
        return ""
    off, one, a, other, b = max(found, key=lambda item: (item[0], *item[1:]))
    return (f"Levels of two factors meet as often as they would if the factors had nothing to do with each other, "
            f"within {off:.1f} readings; the least even are {one}={a} and {other}={b}.")
