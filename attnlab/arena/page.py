"""The page: one file, no network."""

from __future__ import annotations

import html
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from attnlab.arena.summary import PRICES, as_data
from attnlab.arena.words import Places, words

HERE = Path(__file__).parent


def page(places: Places, strips: Mapping[str, str], price: float, told: Mapping[str, Any], notes: Sequence[str],
         read: Sequence[str] = ()) -> str:
    """The whole page. ``strips``: drawings of looks by place; ``told``: command, code, settings; ``notes``: sentences
    on what is compared; ``read``: logs that were only read."""
    data = {"places": {name: as_data(found) for name, found in places.items()}, "prices": PRICES, "price": price}
    text = (HERE / "page.html").read_text()
    said = "".join(f"<li>{html.escape(words(name, found, price))}</li>" for name, found in places.items())
    drawn = "".join(f"<h3>{html.escape(name)}</h3>{strip}" for name, strip in strips.items())
    made = html.escape(json.dumps(told, indent=1, sort_keys=True, default=str))
    embedded = json.dumps(data).replace("<", "\\u003c")
    for mark, content in (("@WORDS@", said), ("@NOTES@", listed(notes)), ("@STRIPS@", drawn), ("@MADE@", made),
                          ("@READ@", f"<h2>Logs that were only read</h2>{listed(read)}" if read else ""),
                          ("@DATA@", embedded), ("@SCRIPT@", (HERE / "page.js").read_text())):
        text = text.replace(mark, content)
    return text


def listed(items: Sequence[str]) -> str:
    """As a list."""
    return f"<ul>{''.join(f'<li>{html.escape(item)}</li>' for item in items)}</ul>"
