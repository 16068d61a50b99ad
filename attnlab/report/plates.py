"""A figure on the page: its picture, what it says in three parts, and links to its files."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from dataclasses import dataclass, field
from html import escape

from attnlab.claims.findings import Finding
from attnlab.claims.judge import Verdict
from attnlab.report.slim import address

MARK = b'id="of-'  # of what belongs to a condition (attnlab.figures.values.gid_of)
MORE = 1.5  # so many times the size of the PNG, an SVG whose lines can be hidden is worth


@dataclass
class Shown:
    """A figure on the page. ``paper``: what the paper shows there; ``found``: what was found here; ``png``, ``svg``:
    its bytes; ``values``: of its lines, as JSON (:mod:`attnlab.figures.values`); ``claims``: ids whose place in the
    paper it shows; ``how``: how to read it; ``failed``: why it could not be drawn.
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


def chip(verdict: Finding, text: str = "") -> str:
    return f'<span class="chip {verdict.css}">{escape(text or verdict)}</span>'


def plate(shown: Shown, verdicts: Sequence[Verdict]) -> str:
    """HTML of a figure; ``verdicts``: all, of which it links to its own."""
    head = f'<figure id="{escape(shown.key)}"><h3>{escape(shown.title)}</h3>'
    if shown.failed:
        return f"{head}<figcaption><p><b>Not drawn:</b> {escape(shown.failed)}</p></figcaption></figure>"
    mine = [v for v in verdicts if v.id in shown.claims]
    chips = " ".join(f'<a href="#claim-{escape(v.id)}">{chip(v.verdict, f"{v.id} {v.word}")}</a>' for v in mine)
    parts = "".join(f"<p><b>{name}:</b> {escape(text)}</p>" for name, text in (
        ("The paper says", shown.paper), ("Here", shown.found), ("How to read it", shown.how)) if text)
    values = f' data-values="{escape(shown.values)}"' if shown.values else ""
    files = ["svg", "png", *(["csv"] if shown.values else [])]
    links = " ".join(f'<a href="figures/{escape(shown.key)}.{kind}">{kind.upper()}</a>' for kind in files)
    return (f'{head}<div class=plot{values}><img alt="{escape(shown.title)}. {escape(shown.found)}" src="'
            f'{_picture(shown)}"></div><figcaption>{parts}{f"<p>{chips}</p>" if chips else ""}'
            f"<p class=files>{links}</p></figcaption></figure>")


def _picture(shown: Shown) -> str:
    """The address of its smaller picture; of its SVG, if that has lines to hide."""
    png = f"data:image/png;base64,{base64.b64encode(shown.png).decode()}"
    svg = address(shown.svg) if shown.svg else ""
    return svg if svg and len(svg) <= len(png) * (MORE if MARK in shown.svg else 1) else png
