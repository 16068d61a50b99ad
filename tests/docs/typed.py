"""What the pages tell to type, and what they show as code."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md")),
         ROOT / "docs" / "results" / "README.md"]
STARTS = r"(?:python3?|pytest|pip|nox|mypy|ruff|mkdocs|ros2|pre-commit) "
BLOCK = re.compile(r"^```(\w*)\n(.*?)^```", re.DOTALL | re.MULTILINE)


@dataclass(frozen=True)
class Typed:
    """A command as a page has it."""
    page: str
    line: str


def commands() -> list[Typed]:
    """Every command of every page, once: fenced for a terminal, indented, or in the text; chains in pieces."""
    found: dict[str, Typed] = {}
    for page in PAGES:
        text = page.read_text()
        blocks = [block for kind, block in BLOCK.findall(text) if kind in ("console", "sh", "bash")]
        prose = BLOCK.sub("", text)
        indented = re.findall(r"^    (\S.*)$", prose.replace("\\\n", " "), re.MULTILINE)
        inline = [" ".join(span.split()) for span in re.findall(r"(?<!`)`([^`]+)`", prose)]
        for line in (*(line for block in blocks for line in block.splitlines()), *indented, *inline):
            for piece in (re.sub(r"^\S*/bin/", "", part.strip()) for part in line.split(" && ")):
                if re.match(STARTS, piece + " "):
                    found.setdefault(piece, Typed(str(page.relative_to(ROOT)), piece))
    return list(found.values())


def blocks(*kinds: str) -> list[tuple[str, int, str]]:
    """(page, number in the page, text) of every block of these kinds."""
    return [(str(page.relative_to(ROOT)), number, text) for page in PAGES
            for number, (kind, text) in enumerate(BLOCK.findall(page.read_text())) if kind in kinds]
