"""Is there any reading in which the paper is true? The certificate of pairs of claims, and what the search found."""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from found import Row, table

from attnlab.audit.certificate import words
from attnlab.search import answer

SEARCH, AUDIT = "search", "audit"
COMMAND = ("attnlab.search", "--minutes", "60")
TABLES = ("rungs", "claims", "finalists")
SEEN = ("cr_vs_ncr", "cr_vs_ncr_planar", "cr_vs_ncr_table4", "controls")


def make(names: Sequence[str], outputs: Path, to: Path) -> bool:
    """The certificate, if it or nothing is named; the search, an hour, if it is. False if it was stopped."""
    if SEARCH in names:
        made = outputs / SEARCH
        done = subprocess.run([sys.executable, "-m", *COMMAND, "--out", str(made)], check=False)
        if done.returncode != 0:
            return False
        (to / SEARCH).mkdir(parents=True, exist_ok=True)
        for name in TABLES:
            shutil.copy(made / f"{name}.csv", to / SEARCH)
    if AUDIT in names or not names:
        seen = [str(file) for study in SEEN if (file := to / study / "verdicts.csv").exists()]
        words_of = ["--claims", *(["--seen", *seen] if seen else []), "--out", str(to / AUDIT / "pairs.csv")]
        subprocess.run([sys.executable, "-m", "attnlab.audit", *words_of], check=True)
    return True


def section(folder: Path) -> list[str]:
    """Paragraphs and a table, from the tables of a folder; none if there are none."""
    pairs, rows = table(folder, AUDIT, "pairs"), table(folder, SEARCH, "finalists")
    parts = [f"`python -m attnlab.audit --claims`: {words(pairs)} Each pair with its reason: "
             f"[{AUDIT}/pairs.csv]({AUDIT}/pairs.csv)."] if pairs else []
    if rows:
        tried = table(folder, SEARCH, "rungs")
        parts += [f"`python -m attnlab.search --rungs {','.join(rungs(tried))}`: {ladder(tried)}",
                  "\n".join(f"- {said}" for said in [*answer.sentences(rows), reading(rows)]), finalists(rows)]
    return ["## Is there any reading in which the paper is true?", *parts] if parts else []


def rungs(rows: Sequence[Row]) -> list[str]:
    """Readings, seeds and episodes of each rung: what ``--minutes`` chose, as it can be typed to do the same again."""
    return [f"{len(of)}:{of[0]['seeds']}:{of[0]['episodes']}" for rung in dict.fromkeys(row["rung"] for row in rows)
            if (of := [row for row in rows if row["rung"] == rung])]


def ladder(rows: Sequence[Row]) -> str:
    """What was tried, rung by rung."""
    said = []
    for rung in dict.fromkeys(row["rung"] for row in rows):
        of = [row for row in rows if row["rung"] == rung]
        sound = [float(row["score"]) for row in of if row["score"]]
        said.append(f"{len(of)} readings ({len(sound)} sound) with {of[0]['seeds']} seeds over {of[0]['episodes']} "
                    f"episodes, best score {max(sound):.1f}")
    different = len({row["reading"] for row in rows})
    return f"{different} different readings were tried. " + "; then ".join(said) + "."


def reading(rows: Sequence[Row]) -> str:
    """How the best reading differs from ``inferred``."""
    top = answer.best(rows)
    if top is None or not top["code"]:
        return "No reading that was found is better than those that it was held against."
    columns = list(top)
    points = columns[columns.index(answer.ids(rows)[-1]) + 1:]
    changed = [f"{point} {top[point]}" for point, digit in zip(points, top["code"], strict=True) if digit != "0"]
    return f"Reading {top['reading']} differs from `inferred` in {len(changed)} of {len(points)} open points: " \
           f"{', '.join(changed)}."


def finalists(rows: Sequence[Row]) -> str:
    """Every reading that was judged, and what holds in it."""
    claims = answer.ids(rows)
    lines = [["reading", "sound", "hold", "reproduced", "contradicted", "claims that hold"],
             ["---", "---", *["---:"] * 3, "---"]]
    lines += [[row["reading"], f"no: {row['not_sound']}" if row["not_sound"] else "yes", row["hold"],
               row["reproduced"], row["contradicted"], answer.listed(answer.holds(row, claims))] for row in rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)
