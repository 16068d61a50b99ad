"""Pictures as small as a page needs them: an SVG as an address of about half the size of matplotlib's file in base64, a
PNG of few colours."""

from __future__ import annotations

import base64
import io
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


def palette(png: bytes) -> bytes:
    """The same picture in at most 256 colours, none off by more than can be seen, its ground (the colour of the first
    pixel) by nothing: about a third of the size."""
    from PIL import Image
    sink = io.BytesIO()
    picture = Image.open(io.BytesIO(png)).convert("RGB")
    small = picture.quantize(256, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
    colours, ground = small.getpalette() or [], 3 * int(small.getpixel((0, 0)))  # type: ignore[arg-type]
    colours[ground:ground + 3] = picture.getpixel((0, 0))  # type: ignore[assignment]
    small.putpalette(colours)
    small.save(sink, format="PNG", optimize=True)
    return sink.getvalue()


def _tenths(number: re.Match[str]) -> str:
    return f"{float(number[0]):.1f}".removesuffix(".0")


def address(svg: bytes) -> str:
    """A ``data:`` address, escaped for an attribute in double quotes."""
    text = slim(svg.decode())
    if "'" in text:  # a quote within quotes: rare, and not worth telling apart
        return f"data:image/svg+xml;base64,{base64.b64encode(text.encode()).decode()}"
    shown = quote(text.replace('"', "'"), safe=PLAIN.replace('"', ""))
    return "data:image/svg+xml," + shown.replace("&", "&amp;")
