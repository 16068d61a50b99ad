"""An SVG as an address that a page can hold: about half the size of matplotlib's file in base64."""

from __future__ import annotations

import base64
import re
from urllib.parse import quote

NOTHING_SEEN = re.compile(r"<\?xml.*?\?>|<!DOCTYPE.*?>|<!--.*?-->|<metadata>.*?</metadata>", re.DOTALL)
PATHS = re.compile(r'(?<=\sd=")[^"]*')
PLACES = re.compile(r'(?<=\s[xy]=")-?\d+\.\d+')
NUMBERS = re.compile(r"-?\d+\.\d+")
PLAIN = "".join(map(chr, range(33, 127))).replace("#", "").replace("%", "") + " "  # as they are in an address


def slim(svg: str) -> str:
    """The same picture to a tenth of a point, without what is not seen."""
    text = PATHS.sub(lambda path: " ".join(NUMBERS.sub(_tenths, path[0]).split()), NOTHING_SEEN.sub("", svg))
    text = PLACES.sub(lambda number: f"{float(number[0]):.2f}", text)
    return re.sub(r">\s+<", "><", text).strip()


def _tenths(number: re.Match[str]) -> str:
    return f"{float(number[0]):.1f}".removesuffix(".0")


def address(svg: bytes) -> str:
    """A ``data:`` address, escaped for an attribute in double quotes."""
    text = slim(svg.decode())
    if "'" in text:  # a quote within quotes: rare, and not worth telling apart
        return f"data:image/svg+xml;base64,{base64.b64encode(text.encode()).decode()}"
    shown = quote(text.replace('"', "'"), safe=PLAIN.replace('"', ""))
    return "data:image/svg+xml," + shown.replace("&", "&amp;")
