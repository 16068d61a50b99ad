"""The page: one file, no network."""

from __future__ import annotations

import html
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from attnlab.arena.drive import Decide, Drive, Task, looks_of
from attnlab.arena.summary import PRICES, Standing, as_data, words

HERE = Path(__file__).parent
STRIP_CYCLES = 300
WIDTH, ROW = 900, 14


def page(places: Mapping[str, Sequence[Standing]], strips: Mapping[str, str], price: float, told: Mapping[str, Any],
         notes: Sequence[str]) -> str:
    """The whole page. ``strips``: drawings of looks by place; ``told``: command, code, settings; ``notes``: sentences
    on what is compared."""
    data = {"places": {name: as_data(found) for name, found in places.items()}, "prices": PRICES, "price": price}
    text = (HERE / "page.html").read_text()
    said = "".join(f"<li>{html.escape(words(name, found, price))}</li>" for name, found in places.items())
    honest = "".join(f"<li>{html.escape(note)}</li>" for note in notes)
    drawn = "".join(f"<h3>{html.escape(name)}</h3>{strip}" for name, strip in strips.items())
    made = html.escape(json.dumps(told, indent=1, sort_keys=True, default=str))
    embedded = json.dumps(data).replace("<", "\\u003c")
    for mark, content in (("@WORDS@", said), ("@NOTES@", honest), ("@STRIPS@", drawn), ("@MADE@", made),
                          ("@DATA@", embedded), ("@SCRIPT@", (HERE / "page.js").read_text())):
        text = text.replace(mark, content)
    return text


def strip(drive: Drive, stretch: tuple[int, int], task: Task, deciders: Mapping[str, Decide]) -> str:
    """What each way looked at in the same cycles: a row a way, a tick a look, grey where something was near."""
    low, high = stretch[0], min(stretch[1], stretch[0] + STRIP_CYCLES)
    left, scale = 150, (WIDTH - 160) / (high - low)
    parts = []
    start = None
    for i in range(low, high + 1):
        near = i < high and drive.near_m[i] < task.onset_m
        if near and start is None:
            start = i
        elif not near and start is not None:
            parts.append(f'<rect x="{left + (start - low) * scale:.1f}" y="0" width="{(i - start) * scale:.1f}" '
                         f'height="{ROW * len(deciders)}" class="near"/>')
            start = None
    for row, (name, decide) in enumerate(deciders.items()):
        y = ROW * row
        ticks = "".join(f"M{left + (cycle - low) * scale:.1f} {y + 3}v{ROW - 5}"
                        for cycle, _ in looks_of(drive, (low, high), task, decide))
        parts.append(f'<text x="{left - 6}" y="{y + ROW - 3}" text-anchor="end">{html.escape(name)}</text>'
                     f'<path d="{ticks}" class="look"/>')
    label = f"Looks of {len(deciders)} ways in {high - low} cycles; grey: nearer than {task.onset_m:g} m"
    return (f'<figure><svg viewBox="0 0 {WIDTH} {ROW * len(deciders)}" role="img" aria-label="{html.escape(label)}">'
            f'{"".join(parts)}</svg><figcaption>{html.escape(label)} ({drive.name}, cycles {low} to {high - 1}).'
            '</figcaption></figure>')


def plain(places: Mapping[str, Sequence[Standing]], price: float) -> str:
    """The same in Markdown: one screen of words, then a table a place."""
    lines = ["# The arena of attention", "", *(f"- {words(name, found, price)}" for name, found in places.items())]
    for name, found in places.items():
        lines += ["", f"## {name}", "", "| way | looks in 100 cycles | harm, % | saved against a fixed "
                  "clock of equal looks | | on the front |", "| --- | --- | --- | --- | --- | --- |"]
        for s in found:
            saved = "" if s.saved is None else f"{100 * s.saved[0]:+.1f} ± {100 * s.saved[1]:.1f}"
            lines.append(f"| {s.way} | {100 * s.looks[0]:.1f} ± {100 * s.looks[1]:.1f} | {100 * s.harm[0]:.1f} ± "
                         f"{100 * s.harm[1]:.1f} | {saved} | {s.verdict} | {'yes' if s.front else ''} |")
    return "\n".join(lines) + "\n"
