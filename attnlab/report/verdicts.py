"""Verdicts as tables: in the page, as CSV, in the terminal."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence
from html import escape

from attnlab.claims.judge import Verdict
from attnlab.report.page import Section, chip


def _n(value: float, form: str = ".3g") -> str:
    return "-" if math.isnan(value) else ("∞" if value > 0 else "−∞") if math.isinf(value) else format(value, form)


def section(verdicts: Sequence[Verdict], stratum: str = "") -> Section:
    """The table of all claims: what the paper says, the verdict, its numbers and its reason."""
    head = "".join(f"<th{' class=n' if n else ''}>{name}</th>" for name, n in (
        ("claim", 0), ("verdict", 0), ("found, and why", 0), ("effect d", 1), ("p", 1), ("Holm", 1), ("seeds", 1)))
    rows = []
    for v in verdicts:
        lead = v.lead
        asides = "".join(f"<br><span class=small>Beside it: {escape(p.reason)} ({escape(p.verdict)}).</span>"
                         for p in v.parts if not p.part.counts)
        rows.append(
            f'<tr id="claim-{escape(v.id)}"><td><b>{escape(v.id)}</b> {escape(v.claim.title)}<br>'
            f'<span class=small>{escape(v.claim.where)}: {escape(v.claim.says)}</span></td><td>{chip(v.verdict)}</td>'
            f"<td>{escape(v.reason)}.{asides}</td><td class=n>{_n(lead.effect, '.2f')}</td><td class=n>{_n(v.p)}</td>"
            f"<td class=n>{_n(v.p_holm)}</td><td class=n>{lead.seeds or '-'}</td></tr>")
    where = f"<p>For {escape(stratum)}.</p>" if stratum else ""
    html = (f'{where}<div class="scroll"><table class=claims><thead><tr>{head}</tr></thead>'
            f'<tbody>{"".join(rows)}</tbody></table></div>'
            "<p class=small>Differences are paired by seed; in brackets 95 % bootstrap intervals over seeds. Effect "
            "d: mean over standard deviation of the differences. p: sign-flip test, two-sided; of a claim with "
            "several parts the largest. Holm: corrected for the number of claims. With fewer than six seeds no p can "
            "fall below 0.05, and intervals are too narrow.</p>")
    return Section("claims", "Claims one by one", html)


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
                   f'<div class="scroll"><table class=matrix><thead><tr>{head}</tr></thead><tbody>{"".join(rows)}'
                   f"</tbody></table></div><ol class=small>{listed}</ol>{more}")


def as_csv(judged: dict[str, list[Verdict]]) -> bytes:
    """A row for every comparison of every claim in every combination of the other settings."""
    sink = io.StringIO()
    writer = csv.writer(sink, lineterminator="\n")
    writer.writerow(["settings", "claim", "title", "verdict", "p", "p_holm", "part", "counts", "measure", "test",
                     "part_verdict", "value", "low", "high", "unit", "paper", "tolerance", "treatment", "control",
                     "effect_d", "part_p", "seeds", "reason"])
    for stratum, verdicts in judged.items():
        for v in verdicts:
            for i, p in enumerate(v.parts):
                numbers = [p.part.number, p.part.tolerance, p.levels.get("treatment"), p.levels.get("control"),
                           p.effect, p.p]
                writer.writerow([stratum, v.id, v.claim.title, v.verdict, _plain(v.p), _plain(v.p_holm), i,
                                 "yes" if p.part.counts else "no", p.part.measure_name, p.part.test, p.verdict,
                                 *map(_plain, p.value), p.part.unit, *map(_plain, numbers), p.seeds, p.reason])
    return sink.getvalue().encode()


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
        shown.add_row(v.id, Text(v.claim.title), Text(v.verdict, style=v.verdict.style), _n(v.lead.effect, ".2f"),
                      _n(v.p_holm))
    console = Console()
    if not console.is_terminal:
        console = Console(width=118)
    console.print(shown)
