"""The specification curve on the page: drawn as it is, and drawn anew in any order where scripts run."""

from __future__ import annotations

import json
from collections.abc import Sequence
from html import escape
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np

from attnlab.report.curve import in_order, ranked
from attnlab.report.multiverse import Curves, Multiverse
from attnlab.report.sentences import curve_said
from attnlab.stats.specification import LIMIT

SIDES = ("claimed", "opposite", "unclear")


def script() -> str:
    return (Path(__file__).parent / "explorer.js").read_text()


def short(name: str) -> str:
    """Of settings that always change together the first, and how many more."""
    first, *more = name.split(" + ")
    return f"{first} +{len(more)}" if more else first


def explorer(found: Multiverse, curves: Curves) -> str:
    """HTML: the curve of the contrast most clearly told from chance over its dashboard; with a script's help, all."""
    lead = ranked(curves)[0]
    order = in_order(curves, lead).tolist()
    rows = [f'<tr class=top><th scope="row" class=scale><span>+{LIMIT:g}</span><span>d&nbsp;0</span>'
            f"<span>−{LIMIT:g}</span></th><td>{curve_svg(curves, lead, order)}</td></tr>"]
    for f, (factor, of) in enumerate(found.levels.items()):
        for place, level in enumerate(dict.fromkeys(of)):
            name, css = (f"<b>{_breaking(short(factor))}</b> ", " class=first") if not place else ("", "")
            whole = escape(f"{factor} = {level}")
            row = [x for x, r in enumerate(order) if of[r] == level]
            rows.append(f'<tr{css}><th scope="row" title="{whole}">{name}{_breaking(short(level))}</th>'
                        f"<td>{_svg(len(order), 0, 1, _blocks(row, f, place))}</td></tr>")
    orders = [("-", "effect"), *((str(i), short(name)) for i, name in enumerate(found.levels))]
    picks = "".join(f"<label>{label} <select name={name}>{''.join(_option(*of) for of in options)}</select></label> "
                    for label, name, options in (
                        ("Comparison", "which", [(str(m), f"{curves.contrasts[m].claim} {curves.contrasts[m].title}")
                                                 for m in ranked(curves)]), ("Order by", "by", orders)))
    return (f'<div id=spec><p class=pick hidden>{picks}</p><p id=spec-said class=said>'
            f'{escape(curve_said(curves, lead))}</p><table class=spec><tbody>{"".join(rows)}</tbody></table>'
            '<p id=spec-seen class="small seen" aria-live="off"></p></div>'
            f'<script type="application/json" id="spec-data">{_data(found, curves)}</script>')


def _breaking(name: str) -> str:
    """Escaped; on a narrow screen a name breaks after its underscores."""
    return escape(name).replace("_", "_<wbr>")


def _option(value: str, text: str) -> str:
    return f'<option value="{escape(value)}">{escape(text)}</option>'


def _svg(width: int, top: float, height: float, inside: str) -> str:
    return f'<svg viewBox="0 {top:g} {max(1, width)} {height:g}" preserveAspectRatio="none" aria-hidden="true">' \
           f"{inside}</svg>"


def curve_svg(curves: Curves, m: int, order: Sequence[int], bars: bool = True) -> str:
    """Effects in this order, each with its interval: up is as claimed."""
    sides: list[tuple[list[str], list[str]]] = [([], []) for _ in SIDES]
    for x, r in enumerate(order):
        d, low, high = (float(np.clip(of[r, m], -LIMIT, LIMIT)) for of in (curves.effects, curves.low, curves.high))
        side = 0 if curves.low[r, m] > 0 else 1 if curves.high[r, m] < 0 else 2
        sides[side][0].append(f"M{x + 0.5:g} {-low:.2f}V{-high:.2f}")
        sides[side][1].append(f"M{x + 0.5:g} {-d:.{2 if bars else 1}f}h0")
    drawn = "".join(f'<path class="bars {name}" d="{"".join(of[0])}"/>' for name, of in
                    zip(SIDES, sides, strict=True) if bars)
    drawn += "".join(f'<path class="dots {name}" d="{"".join(of[1])}"/>' for name, of in
                     zip(SIDES, sides, strict=True) if bars or of[1])
    return _svg(len(order), -LIMIT * 1.05, LIMIT * 2.1, f'<path class=zero d="M0 0H{len(order)}"/>{drawn}')


def _blocks(places: Sequence[int], factor: int, level: int) -> str:
    """Readings with a level as blocks, neighbours as one."""
    runs = [[x for _, x in of] for _, of in groupby(enumerate(places), lambda item: item[1] - item[0])]
    d = "".join(f"M{run[0]} 0h{len(run)}v1h-{len(run)}z" for run in runs)
    return f'<path data-f={factor} data-l={level} d="{d}"/>'


def _data(found: Multiverse, curves: Curves) -> str:
    """What the script draws from, as JSON that cannot end its element."""
    def numbers(of: np.ndarray) -> list[float | None]:
        return [None if np.isnan(x) else round(float(np.clip(x, -99, 99)), 2) for x in of]
    factors = []
    for name, of in found.levels.items():
        levels = list(dict.fromkeys(of))
        factors.append({"name": short(name), "levels": [short(level) for level in levels],
                        "of": [levels.index(level) for level in of]})
    reach = curves.high - curves.effects
    content: dict[str, Any] = {"limit": LIMIT, "names": found.names, "factors": factors, "curves": [
        {"said": curve_said(curves, m), "d": numbers(curves.effects[:, m]), "reach": numbers(reach[:, m])}
        for m in range(len(curves.contrasts))]}
    return json.dumps(content, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
