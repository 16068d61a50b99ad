"""Which readings were kept: what the study's pilots decided, if there were any, with the casualties of the filter and
the balance of what is left."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from html import escape
from pathlib import Path

from attnlab.report.page import Section, table
from attnlab.tables.readings import FILE, TABLE, Decided, read_decided

MOST = 40  # casualties on the page
RARE = 0.2  # a level that is kept less often than this, of its even share, can say little


def section(study: Path) -> tuple[Section | None, str]:
    """(the section, a note): nothing if no pilots decided, a note alone if what they decided cannot be read."""
    decided = read_decided(study)
    if decided is None:
        return None, f"{FILE} cannot be read, so that the filter of the readings is not shown" \
            if (study / FILE).is_file() else ""
    unsound = [of for of in decided.tried if of.reason]
    spare = decided.sound - len(decided.taken)
    parts = [f"<p>{escape(told(decided))}" + (f" {spare} sound ones were not needed." if spare else "") + "</p>"]
    if unsound:
        listed = [[of.reading, of.reason, f"{of.survival:.1f} %", str(of.meals), str(of.drinks), _levels(of.levels)]
                  for of in unsound[:MOST]]
        more = f" The first {MOST} of {len(unsound)}; all are in {TABLE}." if len(unsound) > MOST else ""
        parts += ["<details><summary>The casualties, one by one</summary>",
                  table(("reading", "reason", "survival", "meals", "drinks", "levels"), listed, (2, 3, 4)),
                  f"<p class=small>Survival, meals and drinks of the pilots.{more}</p></details>"]
    parts += ["<h3>Balance of what was kept</h3>", _balance(decided), f"<p class=small>{escape(pairs(decided))}</p>"]
    return Section("readings", "Which readings are sound", "".join(parts)), ""


def told(decided: Decided) -> str:
    """How many were tried, are sound and make the study, by which rule; why the others are not."""
    fell = len(decided.tried) - decided.sound
    why = ", ".join(f"{reason}: {count}" for reason, count in decided.casualties().items())
    return (f"{len(decided.tried)} of {decided.candidates} readings were tried, in the order of the design, by pilots "
            f"of seeds that take no part. Sound is one in which {decided.rule}. {fell} are not"
            + (f" ({why}; some for two reasons)" if fell else "") + f"; {len(decided.taken)} make the study.")


def _levels(of: Mapping[str, str]) -> str:
    return ", ".join(f"{factor}={level}" for factor, level in of.items())


def _balance(decided: Decided) -> str:
    """How often each level was tried, fell and was kept."""
    rows = []
    for factor in decided.tried[0].levels:
        tried, fell, kept = (Counter(of.levels[factor] for of in some) for some in (
            decided.tried, [of for of in decided.tried if of.reason], [of for of in decided.tried if of.taken]))
        rows.append([factor, *(", ".join(f"{level} {of[level]}" for level in tried) for of in (tried, fell, kept))])
    return table(("factor", "tried", "not sound", "kept"), rows)


def pairs(decided: Decided) -> str:
    """How evenly levels are met in what was kept, in two or three sentences."""
    one, other, v = decided.confounded
    return (f"{_rare(decided)}Levels of two factors meet as often as they would if each met each evenly, within "
            f"{decided.uneven:.1f} readings. Of all pairs of factors {one} and {other} tell most of each other "
            f"(Cramer's V = {v:.2f}; 0 is nothing, 1 all).")


def _rare(decided: Decided) -> str:
    """Levels that hardly any sound reading has: of them the study can say nothing, or little."""
    found = [f"{factor}={level} ({count})" for factor, counts in decided.counts.items() for level, count in
             counts.items() if count < RARE * len(decided.taken) / len(counts)]
    return f"Hardly any sound reading has {', '.join(found)}: of these the study can say little. " if found else ""
