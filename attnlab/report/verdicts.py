"""Verdicts as tables: in the page, as CSV, in the terminal."""

from __future__ import annotations

import math
from collections.abc import Sequence
from html import escape

from attnlab.claims.findings import Finding
from attnlab.claims.judge import Verdict
from attnlab.claims.parts import PAIRED
from attnlab.console import table_width
from attnlab.report.page import Section
from attnlab.report.plates import chip
from attnlab.tables.csvs import csv_bytes


def _n(value: float, form: str = ".3g") -> str:
    return "-" if math.isnan(value) else ("∞" if value > 0 else "−∞") if math.isinf(value) else format(value, form)


def section(verdicts: Sequence[Verdict], stratum: str = "") -> Section:
    """The table of all claims: what the paper says, the verdict, its numbers and its reason. ``stratum``: the settings
    that they are for, if there are others."""
    head = "".join(f"<th{' class=n' if n else ''}>{name}</th>" for name, n in (
        ("claim", 0), ("verdict", 0), ("found, and why", 0), ("effect d", 1), ("p", 1), ("Holm", 1), ("seeds", 1)))
    rows = []
    for v in verdicts:
        lead = v.lead
        rows.append(
            f'<tr id="claim-{escape(v.id)}"><td><b>{escape(v.id)}</b> {escape(v.claim.title)}'
            f'<span class="small line">{escape(v.claim.where)}: {escape(v.claim.says)}</span></td><td>'
            f"{chip(v.verdict, v.word)}</td>"
            f"<td>{_why(v)}{_seeds(v)}{''.join(map(_small, _asides(v)))}</td>"
            f'<td class=n data-name="effect d">{_n(lead.effect, ".2f")}</td><td class=n data-name="p">{_n(v.p)}</td>'
            f'<td class=n data-name="Holm">{_n(v.p_holm)}</td>'
            f'<td class=n data-name="seeds">{lead.seeds or "-"}</td></tr>')
    where = f"<p>For {escape(stratum)}, the first combination of settings in which a claim can be tested; of the " \
            "others: verdicts.csv.</p>" if stratum else ""
    html = (f'{where}<div class="scroll" tabindex="0" role="region" aria-label="claims"><table class=claims>'
            f'<thead><tr>{head}</tr></thead>'
            f'<tbody>{"".join(rows)}</tbody></table></div>'
            "<p class=small>Differences are paired by seed; in brackets 95 % t intervals over seeds, which decide (of "
            "a median: between order statistics). Effect d: mean over standard deviation of the differences. p: of the "
            "comparison that decided, two-sided, by the test behind its interval. Holm: corrected for the number of "
            "claims. BCa intervals and exact sign-flip p of every comparison: verdicts.csv; values of every seed: "
            "seeds.csv.</p>")
    return Section("claims", "Claims one by one", html)


def _why(v: Verdict) -> str:
    """The reason of a verdict; where a claim has several comparisons, each that counts with its tick, cross or question
    mark, and what the reason says besides."""
    counting = [p for p in v.parts if p.part.counts]
    if len(counting) < 2:
        return f"{escape(v.reason)}."
    items = []
    for p in counting:
        mark, word = ("?", "cannot say") if p.verdict is Finding.UNTESTABLE else \
            ("✓", "holds") if p.verdict.holds else ("✗", "does not hold")
        items.append(f'<li><span role="img" aria-label="{word}">{mark}</span> {escape(p.reason)}</li>')
    each = [p.reason for p in counting]
    more = v.reason
    for reason in sorted(filter(None, each), key=len, reverse=True):
        more = more.replace(reason, "")
    more = "; ".join(filter(None, map(str.strip, more.split(";"))))
    return f"<ul class=ticks>{''.join(items)}</ul>" + (f"{escape(more[0].upper() + more[1:])}." if more else "")


def _seeds(v: Verdict) -> str:
    """What each seed contributed to the comparison that decided, from the most to the least, with links to its runs."""
    sample = v.lead.sample
    if len(sample) < 2:
        return ""
    unit = f" {v.lead.part.unit}" if v.lead.part.unit not in (None, "1") else ""
    items = ", ".join(f'<a href="#seed-{seed}">{seed}</a>&nbsp;{_n(value, "+.3g")}' for seed, value in
                      sorted(sample.items(), key=lambda item: (-item[1], item[0])))
    return f"<details class=small><summary>seed by seed</summary>{items}{escape(unit)}</details>"


def _small(text: str) -> str:
    return f'<span class="small line">{escape(text)}</span>'


def _asides(v: Verdict) -> list[str]:
    """What stands beside a verdict: comparisons that do not count, other forms, failed runs, what to mind."""
    found = [f"Beside it: {p.reason} ({p.verdict})." for p in v.parts if not p.part.counts]
    forms = [f"{p.part.measure_name} {name}: {finding}" for p in v.parts for name, finding in p.forms.items()]
    if forms:
        found.append(f"In other forms: {'; '.join(forms)}.")
    if v.worst is not None:
        found.append(f"At worst, if the runs that failed count as the least favourable seen: {v.worst}.")
    return [*found, f"Mind: {v.claim.mind}"] if v.claim.mind else found


def matrix(judged: dict[str, list[Verdict]], most: int = 12) -> Section:
    """Claims by combinations of the other settings, for a study that sweeps more than curiosity."""
    names = list(judged)[:most]
    head = "<th>claim</th>" + "".join(f"<th>{i + 1}</th>" for i in range(len(names)))
    rows = []
    for place, first in enumerate(judged[names[0]]):
        cells = "".join(f"<td>{chip(judged[n][place].verdict, judged[n][place].verdict.letter)}</td>" for n in names)
        rows.append(f"<tr><td>{escape(first.id)} {escape(first.claim.title)}</td>{cells}</tr>")
    listed = "".join(f"<li>{escape(name)}</li>" for name in names)
    more = f"<p class=small>The first {most} of {len(judged)}; all are in verdicts.csv.</p>" \
        if len(judged) > most else ""
    return Section("combinations", "Claims in every combination of settings",
                   '<div class="scroll" tabindex="0" role="region" aria-label="claims by combination">'
                   f'<table class=matrix><thead><tr>{head}</tr></thead><tbody>{"".join(rows)}'
                   f"</tbody></table></div><ol class=small>{listed}</ol>{more}")


def as_csv(judged: dict[str, list[Verdict]]) -> bytes:
    """A row for every comparison of every claim in every combination of the other settings."""
    heads = ["settings", "claim", "title", "verdict", "at_worst", "p", "p_holm", "part", "counts", "measure", "test",
             "part_verdict", "value", "low", "high", "bca_low", "bca_high", "unit", "paper", "tolerance", "role",
             "against", "role_level", "against_level", "effect_d", "part_p", "p_sign_flip", "seeds", "forms", "reason"]
    rows = list[list[object]]()
    for stratum, verdicts in judged.items():
        for v in verdicts:
            for i, p in enumerate(v.parts):
                part, against = p.part, p.part.against if p.part.test in PAIRED else ""
                forms = "; ".join(f"{name}: {finding}" for name, finding in p.forms.items())
                rows.append([stratum, v.id, v.claim.title, v.verdict, v.worst or "", _plain(v.p), _plain(v.p_holm),
                             i, "yes" if part.counts else "no", part.measure_name, part.test, p.verdict,
                             *map(_plain, (*p.value, *p.bca)), part.unit, _plain(part.number), _plain(part.known),
                             part.role, against, _plain(p.levels.get(part.role)), _plain(p.levels.get(against)),
                             _plain(p.effect), _plain(p.p), _plain(p.p_flip), p.seeds, forms, p.reason])
    return csv_bytes(heads, rows)


def seeds_csv(judged: dict[str, list[Verdict]]) -> bytes:
    """What every seed contributed to every comparison: a difference, a sign in %, or a level."""
    return csv_bytes(
        ["settings", "claim", "part", "measure", "test", "unit", "seed", "value"],
        ([stratum, v.id, i, p.part.measure_name, p.part.test, p.part.unit, seed, f"{value:.9g}"]
         for stratum, verdicts in judged.items() for v in verdicts for i, p in enumerate(v.parts)
         for seed, value in sorted(p.sample.items())))


def _plain(value: float | None) -> str:
    return "" if value is None or math.isnan(value) else f"{value:.6g}"


def print_table(verdicts: Sequence[Verdict], where: str = "") -> None:
    """Verdicts in the terminal; ``where``: the settings they are for, if there are others."""
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text
    shown = Table(title=Text(f"Claims ({where})" if where else "Claims"), title_justify="left")
    for head in ("claim", "", "verdict", "effect d", "p, Holm"):
        shown.add_column(head, justify="right" if head in ("effect d", "p, Holm") else "left")
    for v in verdicts:
        shown.add_row(v.id, Text(v.claim.title), Text(v.word, style=v.verdict.style), _n(v.lead.effect, ".2f"),
                      _n(v.p_holm))
    Console(width=table_width(118)).print(shown)
