"""All statements of a multiverse at once: a row a measure, a column a control, a chip what is said of them."""

from __future__ import annotations

from collections import Counter
from html import escape

from attnlab.report.explorer import short
from attnlab.report.multiverse import Curves
from attnlab.report.statements import Kind, Statement

CHIPS = {Kind.HANGS: "v-compatible", Kind.MIXED: "v-not", Kind.NOISE: "v-untestable"}


def css(said: Statement) -> str:
    """The class of a statement's chip."""
    return CHIPS.get(said.kind) or ("v-reproduced" if said.side > 0 else "v-contradicted")


def matrix(of: Curves) -> str:
    """HTML: a key with counts, and the table, the measures of which most can be said first."""
    whom = list(dict.fromkeys(c.whom for c in of.contrasts))
    rows: dict[tuple[str, bool], dict[str, int]] = {}
    for m, c in enumerate(of.contrasts):
        rows.setdefault((c.measure, c.order), {})[c.whom] = m
    kinds = list(Kind)

    def first(cells: dict[str, int]) -> tuple[int, float]:
        """The best kind among them, then how many readings are on one side."""
        return min((kinds.index(of.statements[m].kind), -_share(of.statements[m])) for m in cells.values())
    body = []
    for (measure, _), cells in sorted(rows.items(), key=lambda item: (*first(item[1]), item[0])):
        claim = of.contrasts[next(iter(cells.values()))].claim
        chips = "".join(f"<td>{_chip(of, cells[name]) if name in cells else ''}</td>" for name in whom)
        body.append(f'<tr><th scope="row">{escape(measure)} <span class=small>{escape(claim)}</span></th>{chips}</tr>')
    head = "".join(f'<th scope="col">{escape(of.contrasts[0].who)} against {escape(name)}</th>' for name in whom)
    return (f'<p class=key>{_key(of)}</p><table class=glance><thead><tr><th scope="col">measure</th>{head}</tr>'
            f"</thead><tbody>{''.join(body)}</tbody></table>")


def _share(said: Statement) -> float:
    return said.on_side / max(1, said.values)


def _chip(of: Curves, m: int) -> str:
    said, d = of.statements[m], of.joint.median[m]
    mostly = f"{of.contrasts[m].told(said.side)} in {said.on_side} of {said.values}"
    text = {Kind.ROBUST: mostly, Kind.HANGS: f"hangs on {short(said.factors[0])}" if said.factors else "",
            Kind.MIXED: f"mixed: {mostly}", Kind.NOISE: "noise"}[said.kind]
    return f'<span class="chip wraps {css(said)}" title="{escape(mostly)}, median d {d:+.2f}">{escape(text)}</span>'


def _key(of: Curves) -> str:
    """What the colours mean, each with its count."""
    words = {"v-reproduced": "robust, as claimed", "v-contradicted": "robust, the opposite",
             "v-compatible": "hangs on a factor", "v-not": "mixed", "v-untestable": "noise"}
    counts = Counter(map(css, of.statements))
    return " ".join(f'<span class="chip {name}">{word} {counts[name]}</span>' for name, word in words.items())
