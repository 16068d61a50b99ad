"""A figure on the page: its picture, what it says in three parts, and links to its files."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from dataclasses import dataclass, field
from html import escape

from attnlab.claims.findings import Finding
from attnlab.claims.judge import Verdict
from attnlab.report.slim import address, palette

MARK = b'id="of-'  # of what belongs to a condition (attnlab.figures.values.gid_of)
MORE = 1.5  # so many times the size of the PNG, an SVG whose lines can be hidden is worth
ROOM = 1_200_000  # bytes of all pictures of a page: beyond it the largest SVGs give way to small PNGs


@dataclass
class Shown:
    """A figure on the page. ``paper``: what the paper shows there; ``found``: what was found here; ``png``, ``svg``:
    its bytes; ``values``: of its lines, as JSON (:mod:`attnlab.figures.values`); ``claims``: ids whose place in the
    paper it shows; ``how``: how to read it; ``failed``: why it could not be drawn; ``picture``: its address on the
    page (:func:`choose`).
    """
    key: str
    title: str
    paper: str
    found: str = ""
    png: bytes = b""
    svg: bytes = b""
    values: str = ""
    claims: list[str] = field(default_factory=list)
    how: str = ""
    failed: str = ""
    picture: str = ""


def chip(verdict: Finding, text: str = "") -> str:
    return f'<span class="chip {verdict.css}">{escape(text or verdict)}</span>'


def plate(shown: Shown, verdicts: Sequence[Verdict], watch: bool = False) -> str:
    """HTML of a figure; ``verdicts``: all, of which it links to its own; ``watch``: to the runs, seed by seed, too."""
    head = f'<figure id="{escape(shown.key)}"><h3>{escape(shown.title)}</h3>'
    if shown.failed:
        return f"{head}<figcaption><p><b>Not drawn:</b> {escape(shown.failed)}</p></figcaption></figure>"
    mine = [v for v in verdicts if v.id in shown.claims]
    chips = " ".join(f'<a href="#claim-{escape(v.id)}">{chip(v.verdict, f"{v.id} {v.word}")}</a>' for v in mine)
    parts = "".join(f"<p><b>{name}:</b> {escape(text)}</p>" for name, text in (
        ("The paper says", shown.paper), ("Here", shown.found), ("How to read it", shown.how)) if text)
    told = escape(shown.values, quote=False).replace("'", "&#39;")  # it is full of double quotes
    values = f" data-values='{told}'" if shown.values else ""
    files = ["svg", "png", *(["csv"] if shown.values else [])]
    links = " ".join(f'<a href="figures/{escape(shown.key)}.{kind}">{kind.upper()}</a>' for kind in files)
    links += ' <a href="#seeds">watch the runs</a>' if watch else ""
    label = f"{shown.title}: the figure" + (", whose values the arrow keys tell" if shown.values else "")
    return (f'{head}<div class=scroll><div class=plot tabindex=0 role=group aria-label="{escape(label)}"{values}>'
            f'<img alt="{escape(shown.title)}. {escape(shown.found)}" src="{shown.picture}"></div></div><figcaption>'
            f'{parts}{f"<p>{chips}</p>" if chips else ""}<p class=files>{links}</p></figcaption></figure>')


def choose(figures: Sequence[Shown]) -> None:
    """The address of each figure's picture: its SVG, if that has lines to hide or is the smaller one; else its PNG in
    few colours. If all are more than a page has room for, the largest SVGs become PNGs."""
    there = [shown for shown in figures if shown.png]
    small = {shown.key: f"data:image/png;base64,{base64.b64encode(palette(shown.png)).decode()}" for shown in there}
    for shown in there:
        svg = address(shown.svg) if shown.svg else ""
        worth = 4 / 3 * len(shown.png) * MORE if MARK in shown.svg else len(small[shown.key])
        shown.picture = svg if svg and len(svg) <= worth else small[shown.key]
    for shown in sorted(there, key=lambda of: -len(of.picture)):
        if sum(len(of.picture) for of in there) > ROOM:
            shown.picture = min(shown.picture, small[shown.key], key=len)
