"""The multiverse on the page: which of the paper's directions are robust, hang on one factor, are mixed or noise."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import found
from found import Row, table

from attnlab.report.curve import p_text
from attnlab.report.statements import Kind

if TYPE_CHECKING:
    from attnlab.results.load import Study

NAME = "multiverse"
HEADS = ("measure", "statement", "as claimed in", "clear as claimed", "clear, the opposite", "median d",
         "joint p of all")
MEANT = {Kind.ROBUST: "nearly all readings on one side, told from chance", Kind.MIXED: "told from chance, in too few "
         "readings, and no factor sorts them", Kind.NOISE: "not told from chance"}


def pilots(study: Path, load: Any) -> dict[str, Any]:
    """What decided which readings are sound, for made.json: in words, and what it took. Nothing if there were no
    pilots. ``load``: that of attnlab.results."""
    from attnlab.report.kept import pairs, told
    from attnlab.tables.readings import read_decided
    decided, home = read_decided(study), study.with_name(f"{study.name}_pilots")
    if decided is None or not home.is_dir():
        return {}
    runs: Study = load(home)
    return {"pilots": {"readings": told(decided), "balance": pairs(decided), "runs": len(runs.complete),
                       "cpu_s": round(sum(runs.about(run).get("cpu_s") or 0.0 for run in runs.complete))}}


def section(folder: Path) -> list[str]:
    """Paragraphs, the figure and a table for each control; a sentence where the study has not been made."""
    title, rows, with_ = "## The multiverse", table(folder, NAME, "joint"), found.made(folder, NAME)
    if not rows or not with_:
        return [title, found.MISSING.format(NAME)]
    kept = f" The whole page: [report.html]({NAME}/report.html)." \
        if (folder / NAME / "report.html").exists() else ""
    parts = [title, what(rows, with_), filtered(with_), counted(rows) + kept, listed(rows),
             f"![Specification curves]({NAME}/multiverse_curves.png)"]
    for who, whom in dict.fromkeys((row["role"], row["against"]) for row in rows):
        parts += [f"**{who} less {whom}**", by_control(rows, whom)]
    return parts


def what(rows: Sequence[Row], with_: dict[str, Any]) -> str:
    """What was run, what it took, and how it is judged."""
    cpu, first = with_["cpu_s_of_runs"], rows[0]
    speed = with_["cycles"] / max(1, cpu) / 1e6
    page = f", the page {with_['page_cpu_s'] / 60:.1f}" if "page_cpu_s" in with_ else ""
    before = f", the {with_['pilots']['runs']} pilots {with_['pilots']['cpu_s'] / 60:.0f}" if "pilots" in with_ else ""
    return (f"`{with_['command']}`: {first['readings']} readings of what the paper leaves open, in each CR and both of "
            f"its controls, {first['seeds']} seeds, the same in all: {with_['runs']} runs. They took {cpu / 60:.0f} "
            f"processor minutes ({speed:.2f} million cycles a second){before}{page}. An effect d is the mean "
            "difference over its standard deviation between seeds, above 0 as claimed. The joint test exchanges the "
            f"labels of a whole seed in all readings at once; its p is corrected for all {len(rows)} comparisons "
            "(max-T). Clear is a reading whose own 95 % interval leaves out 0. The kinds of statement were defined "
            "before any run ([docs/claims.md](../claims.md#the-multiverse)).")


def filtered(with_: dict[str, Any]) -> str:
    """Casualties of the pilots and the balance of what is left."""
    of = with_.get("pilots")
    return f"{of['readings']} {of['balance']} Each with its reason: [readings.csv]({NAME}/readings.csv)." if of else ""


def counted(rows: Sequence[Row]) -> str:
    """How many statements are of each kind, and on which factors they hang."""
    of = Counter(Kind(row["statement"]) for row in rows)
    factors = Counter(factor for row in rows for factor in row["hangs_on"].split("; ")[:1] if factor)
    most = ", ".join(f"{_short(factor)} {count}" for factor, count in factors.most_common())
    measures = len({row["measure"] for row in rows})
    return (f"{len(rows)} comparisons of {measures} measures: {', '.join(f'{kind} {of[kind]}' for kind in Kind)}."
            + (f" What they hang on first: {most}." if most else ""))


def listed(rows: Sequence[Row]) -> str:
    """The statements by kind: of a robust one its side and effects, of a hanging one its factor and levels."""
    lines = []
    for kind in Kind:
        mine = sorted((row for row in rows if row["statement"] == kind), key=_order)
        if kind is Kind.HANGS:
            for factor in dict.fromkeys(row["hangs_on"].split("; ")[0] for row in mine):
                of = [f"{row['measure']} [{row['claim']}] against {row['against']} (as claimed with {_levels(row)})"
                      for row in mine if row["hangs_on"].split("; ")[0] == factor]
                lines.append(f"- **hang on {_short(factor)}** ({len(of)}): {'; '.join(of)}.")
        elif mine:
            whole = _robust(mine) if kind is Kind.ROBUST else _names(mine, {row["against"] for row in rows})
            lines.append(f"- **{kind}** ({MEANT[kind]}; {len(mine)}): {'; '.join(whole)}.")
    return "\n".join(lines)


def _robust(rows: Sequence[Row]) -> list[str]:
    """``lower hunger mean [C15] than NCR in 9 of 10 (d +0.8), as claimed``, a text a measure and side."""
    said = []
    for measure, side in dict.fromkeys((row["measure"], row["side"]) for row in rows):
        of = [row for row in rows if (row["measure"], row["side"]) == (measure, side)]
        than = [f"than {row['against']} in {row['readings_on_side']} of {row['with_value']} "
                f"(d {float(row['median_d']):+.2f})" for row in of]
        said.append(f"{side} {measure} [{of[0]['claim']}] {_and(than)}, {_side(of[0])}")
    return said


def _names(rows: Sequence[Row], every: set[str]) -> list[str]:
    """Measures; against whom, where it is not everybody."""
    whom: dict[str, list[str]] = {}
    for row in rows:
        whom.setdefault(row["measure"], []).append(row["against"])
    return [name if set(of) == every else f"{name} against {_and(of)}" for name, of in whom.items()]


def by_control(rows: Sequence[Row], whom: str) -> str:
    """The table of one control, by kind and size."""
    from page import grid
    order = list(Kind)
    mine = sorted((row for row in rows if row["against"] == whom),
                  key=lambda row: (order.index(Kind(row["statement"])), *_order(row)))
    return grid(HEADS, [[f"{row['measure']} [{row['claim']}], claimed {row['claimed']}", _statement(row),
                         f"{row['as_claimed']} of {row['with_value']}", *(_share(row, row[column]) for column in
                                             ("clear_as_claimed", "clear_opposite")),
                         f"{float(row['median_d']):+.2f}", p_text(float(row["p_family"]))] for row in mine])


def _order(row: Row) -> tuple[float, float, str]:
    return float(row["p_family"]), -abs(float(row["median_d"])), row["measure"]


def _statement(row: Row) -> str:
    kind = Kind(row["statement"])
    if kind is Kind.HANGS:
        return f"hangs on {', '.join(map(_short, row['hangs_on'].split('; ')))}"
    return f"{kind}, {_side(row)}" if kind is Kind.ROBUST else kind


def _side(row: Row) -> str:
    return "as claimed" if row["side"] == row["claimed"] else "the opposite"


def _share(row: Row, count: str) -> str:
    values = int(row["with_value"])
    return f"{100 * int(count) / values:.0f} %" if values else "-"


def _levels(row: Row) -> str:
    return row["as_claimed_by_level"].replace(": ", " in ").replace("; ", ", ")


def _short(factor: str) -> str:
    return factor.partition(" + ")[0]


def _and(words: Sequence[str]) -> str:
    return " and ".join(filter(None, [", ".join(words[:-1]), words[-1]]))
