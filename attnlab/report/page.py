"""The page: one HTML file that needs no network, and says all without a script. What a user named is escaped."""

from __future__ import annotations

import base64
import hashlib
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path

from attnlab.claims.files import Claims
from attnlab.claims.findings import Finding
from attnlab.claims.judge import Verdict
from attnlab.report.plates import Shown, chip, plate

NO_SCRIPT = ("<noscript><p class=small>This browser runs no script: tables stay in their order and no value is told at "
             "the pointer; all else is here.</p></noscript>")
PROVENANCE = ("<!-- provenance:begin -->", "<!-- provenance:end -->")  # all that may differ between two builds


@dataclass
class Section:
    """A part of the page made elsewhere; ``html`` is already escaped."""
    key: str
    title: str
    html: str


def page(title: str, lead: str, notes: Sequence[str], told: str, verdicts: Sequence[Verdict],
         figures: Sequence[Shown], sections: Sequence[Section], provenance: str, found: str = "",
         first: Sequence[Section] = (), script: str = "", shown: str = "") -> str:
    """The whole page. ``told``: HTML of the verdicts in short, which ``verdicts`` are for figures to link to;
    ``sections`` follow the figures; ``provenance`` is HTML, and so is ``found``, the first screen; sections in
    ``first`` follow that one. ``script``: of this page alone; ``shown``: HTML, by which conditions are hidden."""
    links = [*([("found", "What was found")] if found else []), *((s.key, s.title) for s in first),
             ("verdicts", "Verdicts"), *([("figures", "Figures")] if figures else []),
             *((s.key, s.title) for s in sections), ("provenance", "Provenance")]
    parts = [
        f'<p class="lead">{escape(lead)}</p>', notes_block(notes),
        nav(links), shown, found, *map(_section, first), told,
        '<h2 id="figures">Figures</h2>' if figures else "",
        *(plate(figure, verdicts, any(s.key == "seeds" for s in sections)) for figure in figures),
        *map(_section, sections),
        PROVENANCE[0], '<h2 id="provenance">Provenance</h2>', provenance, PROVENANCE[1]]
    return document(title, parts, script)


def plain_page(title: str, lead: str, found: str, sections: Sequence[Section]) -> str:
    """A page of the same look: ``found`` is HTML, the sections follow it."""
    links = nav([(s.key, s.title) for s in sections]) if sections else ""
    return document(title, [f'<p class="lead">{escape(lead)}</p>', links, found, *map(_section, sections)])


def nav(links: Sequence[tuple[str, str]]) -> str:
    """Links to the parts of a page."""
    return "<nav>" + " ".join(f'<a href="#{key}">{escape(name)}</a>' for key, name in links) + "</nav>"


def document(title: str, parts: Sequence[str], script: str = "", style: str = "") -> str:
    """A page that asks for nothing from elsewhere. ``parts``: HTML of its body; ``script`` is run after that of all
    pages (page.js), which together are the only code it lets run; ``style``: more of it than all pages have."""
    script = (Path(__file__).parent / "page.js").read_text() + script
    style = (Path(__file__).parent / "style.css").read_text() + style
    mark = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    whole = [
        "<!doctype html>", '<html lang="en">', "<head>", '<meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        '<meta http-equiv="Content-Security-Policy" content="default-src \'none\'; img-src data:; '
        f"style-src 'unsafe-inline'; script-src 'sha256-{mark}'\">",
        '<link rel="icon" href="data:,">', f"<title>{escape(title)}</title>", f"<style>\n{style}</style>", "</head>",
        "<body>", "<main>", f"<h1>{escape(title)}</h1>", NO_SCRIPT, *parts,
        "</main>", f"<script>{script}</script>", "</body>", "</html>"]
    return "\n".join(part for part in whole if part) + "\n"


def _section(section: Section) -> str:
    return f'<h2 id="{section.key}">{escape(section.title)}</h2>\n{section.html}'


def notes_block(notes: Sequence[str]) -> str:
    """What a reader must mind, first."""
    if not notes:
        return ""
    return '<div class="notes" role="note"><strong>Mind</strong><ul>' + \
        "".join(f"<li>{escape(note)}</li>" for note in notes) + "</ul></div>"


def nothing_testable(verdicts: Sequence[Verdict]) -> bool:
    """Is this a study of other things than these claims?"""
    return all(v.verdict is Finding.UNTESTABLE for v in verdicts)


def told_of(claims: Claims, count: int) -> str:
    """HTML: how many claims, of whom."""
    number = f"{count} " + ("hypothes" + ("es" if count > 1 else "is") if claims.own else "claim" + "s" * (count > 1))
    source = f", {escape(claims.source)}" if claims.source else ""
    return f"{number} of <cite>{escape(claims.title)}</cite>{source}"


def _typed(value: object) -> str:
    """A setting's value as one types it."""
    return f"[{','.join(map(str, value))}]" if isinstance(value, list) else str(value)


def headline(claims: Claims, verdicts: Sequence[Verdict], where: str = "", others: int = 0) -> str:
    """How many claims fared how, and which; ``where``: under which settings, ``others``: of so many besides."""
    if not verdicts:
        return '<h2 id="verdicts">Verdicts</h2><p>There are no complete runs to judge by.</p>'
    if nothing_testable(verdicts):
        (reason, count), = Counter(v.reason for v in verdicts).most_common(1)
        many, why = len(verdicts), escape(reason)
        none = f"None of the {many} claims of" if many > 1 else "The one claim of"
        told = f"{count} of them: {why}. All reasons are in verdicts.csv" if many > 1 else why[:1].upper() + why[1:]
        return (f'<h2 id="verdicts">Verdicts</h2><p>{none} <cite>{escape(claims.title)}</cite> '
                f"can{'not' * (many == 1)} be tested here. {told}.</p>")
    counts = Counter(v.verdict for v in verdicts)
    bar = "".join(f'<span class="{v.css}" style="flex: {counts[v]}">{counts[v]}</span>' for v in Finding
                  if counts[v])
    own, called = claims.own, {v: v.own if claims.own else str(v) for v in Finding}
    meaning = {v: v.meaning.replace("the paper's number", "the expected number") if own else v.meaning for v in Finding}
    key = "".join(f"<span>{chip(v, called[v])} {escape(meaning[v])}</span>" for v in Finding if counts[v])
    items = []
    for verdict in Finding:
        mine = [v for v in verdicts if v.verdict == verdict]
        if mine:
            said = "; ".join(f'<a href="#claim-{escape(v.id)}">{escape(v.id)}</a> {escape(v.claim.title)}'
                             for v in mine)
            items.append(f"<li>{chip(verdict, called[verdict])} {said}.</li>")
    holds = sum(counts[v] for v in Finding if v.holds)
    chosen = f" for <b>{escape(where)}</b>, the first of {others + 1} combinations of settings in which a claim can " \
             "be tested (all of them: below)" if where else ""
    who = "; ".join(f"{role.label} is {', '.join(f'{name}={_typed(value)}' for name, value in role.where.items())}"
                    for role in claims.roles.values())
    met = counts[Finding.REPRODUCED]
    exact = "" if own else f", {met} of which {'is' if met == 1 else 'are'} reproduced, number and all"
    return (f'<h2 id="verdicts">Verdicts</h2>\n<p>{told_of(claims, len(verdicts))}, judged by the rules of '
            f"{escape(claims.path.name)}{chosen}: the claimed direction holds in <b>{holds}</b>{exact}. "
            f"{escape(who)}.</p>\n"
            f'<div class="bar" role="img" aria-label="{holds} of {len(verdicts)} claims hold">{bar}</div>\n'
            f'<div class="key small">{key}</div>\n<ul class="headline">{"".join(items)}</ul>')


def table(heads: Sequence[str], rows: Sequence[Sequence[str]], numbers: Sequence[int] = (),
          of: Sequence[str] = ()) -> str:
    """A table of texts, escaped; columns in ``numbers`` are aligned to the right. ``of``: what condition each row is of
    (see :mod:`attnlab.report.toggles`)."""
    def cells(row: Sequence[str], tag: str) -> str:
        return "".join(f'<{of}{" class=n" if i in numbers else ""}>{escape(str(c))}</{of}>'
                       for i, c in enumerate(row) for of in (tag if str(c) else "td",))
    marks = [f' data-of="{escape(key)}"' if key else "" for key in of] or [""] * len(rows)
    body = "".join(f"<tr{mark}>{cells(row, 'td')}</tr>" for mark, row in zip(marks, rows, strict=True))
    return ('<div class="scroll" tabindex="0" role="group" aria-label="table"><table><thead><tr>'
            f'{cells(heads, "th")}</tr></thead><tbody>{body}</tbody></table></div>')
