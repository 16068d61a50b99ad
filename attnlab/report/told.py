"""A multiverse's page: first screen with the curve, then every comparison and what moves it."""

from __future__ import annotations

from html import escape

import numpy as np

from attnlab.arithmetic import total
from attnlab.report.curve import in_order, p_text, ranked
from attnlab.report.explorer import curve_svg, explorer, short
from attnlab.report.matrix import css, matrix
from attnlab.report.multiverse import Curves, Multiverse
from attnlab.report.page import Section, table
from attnlab.report.sentences import HEADS, how_many, in_short, rules, sentences
from attnlab.report.statements import Kind

MOVERS = 3  # factors that a row names


def first_screen(found: Multiverse) -> str:
    """HTML: what is robust, what hangs on one factor, what is noise; then the curve."""
    of = found.curves
    if of is None:
        return ('<h2 id="found">What was found</h2><p>There is nothing to compare: no signed comparison of the claims '
                "has two seeds in any reading.</p>")
    parts = ['<h2 id="found">What was found</h2>', f"<p>{escape(how_many(len(found.names), of))}</p>",
             matrix(of), '<div class=kinds>']
    for kind, count, texts in sentences(of):
        whole = kind in (Kind.ROBUST, Kind.HANGS)  # a sentence a measure; of the others, one that lists them
        items = "".join(f"<li>{_bold(text) if whole else escape(text)}</li>" for text in texts)
        parts.append(f"<section><h3>{escape(HEADS[kind])} <span class=small>{count} of "
                     f"{len(of.contrasts)}</span></h3><ul>{items}</ul></section>")
    parts += ["</div>", "<h3 id=curve>The specification curve</h3>", explorer(found, of),
              "<p class=small>A column a reading: its effect, CR less the control over the standard deviation between "
              "seeds, with the 95 % t interval of its mean; blue clear as claimed, orange clear on the other side, "
              "grey neither. Below, which level of each factor it has (+1: and of one setting more, which always "
              "changes with it). d beyond the scale is drawn at its edge.</p>"]
    return "".join(parts)


def _bold(text: str) -> str:
    """A sentence with its measure in bold: what stands before the claim's brackets."""
    name, bracket, rest = text.partition(" [")
    return f"<b>{escape(name)}</b>{escape(bracket + rest)}" if bracket else escape(text)


def sections(found: Multiverse) -> list[Section]:
    """All comparisons, and what moves them."""
    of = found.curves
    return [_comparisons(of), _moves(found, of)] if of is not None else []


def _comparisons(of: Curves) -> Section:
    j, rows = of.joint, []
    for m in ranked(of):
        c, said = of.contrasts[m], of.statements[m]
        cells = [f"{int((of.effects[:, m] > 0).sum())} of {said.values}", f"{j.clear[m]}", f"{j.opposite[m]}",
                 f"{j.median[m]:+.2f}", p_text(j.p[m]), p_text(j.p_family[m])]
        rows.append(f"<tr><td><b>{escape(c.claim)}</b> {escape(c.measure)}<br><span class=small>claimed "
                    f"{escape(c.told(1.0))} in {escape(c.who)} than in {escape(c.whom)}</span></td>"
                    f'<td><span class="chip wraps {css(said)}">{escape(in_short(of, m))}</span></td>'
                    f"<td class=spark>{curve_svg(of, m, in_order(of, m).tolist(), bars=False)}</td>"
                    + "".join(f"<td class=n>{escape(cell)}</td>" for cell in cells) + "</tr>")
    heads = ("comparison", "statement", "curve", "above 0", "clear", "clear below", "median d", "joint p", "p of all")
    head = "".join(f'<th scope="col"{" class=n" if i > 2 else ""}>{name}</th>' for i, name in enumerate(heads))
    how = (f"all {j.patterns} exchanges" if j.exact else f"{j.patterns} exchanges drawn") + \
        f" of {of.differences.shape[-1]} seeds"
    html = ('<div class="scroll" tabindex="0" role="region" aria-label="every comparison"><table class=curves><thead>'
            f"<tr>{head}</tr></thead><tbody>{''.join(rows)}</tbody></table></div>"
            "<p class=small>Above 0: as claimed, of the readings that have a value; a reading without one counts "
            "nowhere. Clear: the t interval leaves out 0. Joint test: the labels of a whole seed are exchanged in "
            f"every reading at once ({how}), which keeps how readings hang together; the statistic is the mean effect. "
            "p of all: corrected for the number of comparisons (max-T). The readings are a fixed design: nothing is "
            f"inferred over them. {escape(rules())} Every effect with its interval and its p of all readings and "
            "comparisons: curve.csv; this table, with p by median and by clear readings: joint.csv.</p>")
    return Section("comparisons", "Every comparison", html)


def _moves(found: Multiverse, of: Curves) -> Section:
    """Share of the variance of each comparison's effects by factor."""
    rows = []
    for m in ranked(of):
        top = of.movers(m)[:MOVERS]
        bar = "".join(f'<rect class="m{i}" x="{100 * total(s for _, s in top[:i]):.1f}" width="{100 * share:.1f}" '
                      'height="1"/>' for i, (_, share) in enumerate(top))
        named = ", ".join(f"{short(name)} {100 * share:.0f} %" for name, share in top)
        rows.append(f"<tr><td><b>{escape(of.contrasts[m].claim)}</b> {escape(of.contrasts[m].measure)}, against "
                    f'{escape(of.contrasts[m].whom)}</td><td class=share><svg viewBox="0 0 100 1" '
                    f'preserveAspectRatio="none" aria-hidden="true">{bar}</svg></td><td>{escape(named)}</td></tr>')
    factors = []
    for name, levels in found.levels.items():
        mean = float(np.mean([shares[name] for shares in of.shares]))
        hang = [f"{c.claim} {c.measure}, against {c.whom}" for c, said in zip(of.contrasts, of.statements, strict=True)
                if name in said.factors]
        factors.append((mean, [name, ", ".join(dict.fromkeys(levels)), f"{100 * mean:.1f} %", str(len(hang))]))
    by_factor = [row for _, row in sorted(factors, key=lambda item: -item[0])]
    html = ("<p>Share of the variance of the effects over readings that lies between the levels of a factor.</p>"
            + table(("factor", "levels", "mean share", "comparisons that hang on it"), by_factor, (2, 3))
            + '<div class="scroll" tabindex="0" role="region" aria-label="what moves each comparison"><table '
            'class=moves><thead><tr><th scope="col">comparison</th><th scope="col">the three factors that move it most'
            '</th><th scope="col">share of variance</th></tr></thead><tbody>' + "".join(rows) + "</tbody></table></div>"
            "<p class=small>Eta squared: what lies outside the bar is of other factors, of factors together, and "
            "chance; chance alone gives a factor of two levels about 1 in the number of readings. All shares: "
            "shares.csv.</p>")
    return Section("moves", "What moves each claim", html)
