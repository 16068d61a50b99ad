"""What a study of many readings says of claims and conditions: in how many readings, never what one of them says."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from html import escape

import numpy as np

from attnlab.claims.files import Claims
from attnlab.claims.findings import Finding
from attnlab.claims.roles import Combinations
from attnlab.console import table_width
from attnlab.report.explorer import short
from attnlab.report.multiverse import Multiverse
from attnlab.report.page import Section, table, told_of
from attnlab.report.plates import chip
from attnlab.results.conditions import Conditions
from attnlab.results.summary import shown, summary_frame
from attnlab.tables.csvs import frame_csv

# Groups of claims by the share of readings in which they hold: (least share, words, class of the chip).
GROUPS = ((0.9, "in nearly all", "v-reproduced"), (0.5, "in most", "v-compatible"), (0.1, "in some", "v-direction"),
          (0.0, "in hardly any", "v-not"))


def headline(found: Multiverse, claims: Claims) -> str:
    """HTML: in how many readings each claim holds, grouped; no reading is chosen."""
    groups: dict[str, list[tuple[float, str]]] = {}
    for row, (key, claim) in enumerate(found.claims.items()):
        value, testable = found.share(row)
        name = next((words for least, words, _ in GROUPS if value >= least), "") if testable else ""
        share = f" ({100 * value:.0f} %)" if testable else ""
        said = f'<a href="#claim-{escape(key)}">{escape(key)}</a> {escape(claim.title)}{share}'
        groups.setdefault(name, []).append((-value if testable else 0.0, said))
    items = []
    for words, css in [*((words, css) for _, words, css in GROUPS), ("", "v-untestable")]:
        if words in groups:
            said = "; ".join(text for _, text in sorted(groups[words], key=lambda one: one[0]))
            name = f"holds {words}" if words else "untestable in every reading"
            items.append(f'<li><span class="chip {css}">{name}</span> {said}.</li>')
    edges = ", ".join(f"{words} {100 * least:.0f} % or more" for least, words, _ in GROUPS[:-1])
    return (f'<h2 id="verdicts">Verdicts</h2>\n<p>{told_of(claims, len(found.claims))}, judged in each of '
            f"{len(found.names)} readings by the rules of {escape(claims.path.name)}. No reading is singled out: what "
            f"stands here is in how many of those that can test a claim its direction holds ({edges}).</p>\n"
            f'<ul class="headline">{"".join(items)}</ul>')


def section(found: Multiverse) -> Section:
    """Every claim with what was found of it, reading by reading."""
    rows = []
    for row, (key, claim) in enumerate(found.claims.items()):
        value, testable = found.share(row)
        counts = Counter(found.findings[row])
        top = sorted((e for e in found.moved if e.claim == key and e.difference), key=lambda e: -abs(e.difference))[:2]
        moved = "; ".join(f"{short(e.factor)}={short(e.level)} {100 * e.difference:+.0f}" for e in top) or "nothing"
        said = ", ".join(f"{counts[of]} {of.own if found.own else of}" for of in Finding if counts[of])
        held = f"{100 * value:.0f} %" if testable else "-"
        rows.append(f'<tr id="claim-{escape(key)}"><td><b>{escape(key)}</b> {escape(claim.title)}<br><span class=small>'
                    f"{escape(claim.where)}: {escape(claim.says)}</span></td><td class=n>{held}</td>"
                    f"<td class=share>{_bar(counts)}<span class=small>{escape(said)}</span></td>"
                    f"<td>{escape(moved)}</td></tr>")
    head = "".join(f'<th scope="col"{" class=n" if i == 1 else ""}>{name}</th>' for i, name in enumerate(
        ("claim", "holds in", "readings by verdict", "moved most by (percent points)")))
    names = [of.own if found.own else str(of) for of in Finding if of.holds]
    key = "".join(f"<span>{chip(of, of.own if found.own else '')}</span> " for of in Finding
                  if any(of in row for row in found.findings))
    html = (f"<p>A claim holds in a reading if its verdict is <i>{'</i>, <i>'.join(map(escape, names))}</i>; readings "
            f'in which it is untestable do not count.</p><p class="key">{key}</p>'
            '<div class="scroll" tabindex="0" role="region" aria-label="claims over readings"><table class=moves>'
            f"<thead><tr>{head}</tr></thead><tbody>{''.join(rows)}</tbody></table></div>"
            + "<h3>Readings that satisfy most claims</h3>" + _best(found)
            + f"<p class=small>All {len(found.names)} readings: combinations.csv; verdicts in each: verdicts.csv. "
            "Moved: the share with a level less the share with the default level, all "
            f"{len(found.moved)} in effects.csv; differences within a fixed design, without intervals.</p>")
    return Section("multiverse", "In how many readings each claim holds", html)


def _bar(counts: Mapping[Finding, int]) -> str:
    """Readings by verdict, side by side."""
    every, at, parts = sum(counts.values()), 0, []
    for finding in Finding:
        if counts[finding]:
            parts.append(f'<rect class="{finding.css}" x="{at}" width="{counts[finding]}" height="1"/>')
            at += counts[finding]
    return f'<svg viewBox="0 0 {max(1, every)} 1" preserveAspectRatio="none" aria-hidden="true">{"".join(parts)}</svg>'


def _best(found: Multiverse, most: int = 5) -> str:
    best = sorted(range(len(found.names)), key=lambda j: (-np.nansum(found.holds[:, j]), j))[:most]
    rows: list[Sequence[str]] = [[
        found.names[j], f"{np.nansum(found.holds[:, j]):.0f}", f"{found.reproduced[:, j].sum()}",
        ", ".join(f"{short(f)}={short(of[j])}" for f, of in found.levels.items() if of[j] != found.defaults[f])
        or "nothing"] for j in best]
    exact = "supported, number and all" if found.own else "reproduced"
    return table(("reading", "claims that hold", exact, "differs from the default in"), rows, (1, 2))


def conditions(claims: Claims, of: Conditions, combinations: Combinations) -> tuple[Section, bytes]:
    """A row a role of the claims: what its robots are like over all readings, for the page; every condition, as CSV."""
    named = of.study.named()
    frame = summary_frame(of.study, named)
    csv = frame_csv(frame, "%.6g")
    columns = [name for name in frame.columns if name not in ("condition", "runs", "activations")]
    rows = []
    for role in claims.roles.values():
        runs = {run for within in combinations.values() for run in of.matching(role.where, within)[0].runs.values()}
        names = {named[run] for run in runs if run in named}
        mine = frame[frame["condition"].isin(names)]
        if len(mine):
            ends = [dict(zip(columns, of_all, strict=True)) for of_all in
                    (mine[columns].median(), mine[columns].min(), mine[columns].max())]
            rows.append([role.label, str(len(mine)), *_spans(*map(shown, ends))])
    html = table(("condition", "readings", *columns), rows, range(1, 2 + len(columns))) + (
        "<p class=small>Medians over readings of the mean over seeds, in brackets the least and the most of any "
        "reading. Early, late, validation: survival in % of the episode, first and second half of training and in "
        "validation. The rest over validation episodes: crashed in % of them, needs and energy in UoE, safety by eq "
        "13. Every condition of every reading: conditions.csv.</p>")
    return Section("conditions", "Conditions over all readings", html), csv


def _spans(middle: Iterable[str], low: Iterable[str], high: Iterable[str]) -> list[str]:
    return [f"{m} [{one}, {other}]" for m, one, other in zip(middle, low, high, strict=True)]


def print_table(found: Multiverse) -> None:
    """In the terminal: in how many readings each claim holds."""
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text
    rows = Table(title=Text(f"Claims over {len(found.names)} readings"), title_justify="left")
    for head in ("claim", "", "holds in", "readings that can test it"):
        rows.add_column(head, justify="right" if head.startswith(("holds", "readings")) else "left")
    for row, (key, claim) in enumerate(found.claims.items()):
        value, testable = found.share(row)
        rows.add_row(key, Text(claim.title), f"{100 * value:.0f} %" if testable else "-", str(testable))
    Console(width=table_width(118)).print(rows)
