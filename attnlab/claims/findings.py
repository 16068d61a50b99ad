"""What may be found of a claim: each finding's word, letter, colours and meaning, once."""

from __future__ import annotations

from enum import StrEnum


class Finding(StrEnum):
    """A verdict. Its value is its word; ``letter`` stands in narrow tables, ``css`` is its class on the page, ``style``
    its colour in the terminal, ``meaning`` what it says. A hypothesis of one's own is not reproduced but ``supported``:
    it goes by ``own`` words."""
    letter: str
    css: str
    style: str
    meaning: str
    own: str

    REPRODUCED = ("reproduced", "yes", "v-reproduced", "green",
                  "the same as the paper's number: the whole interval lies within the tolerance",
                  "supported, number and all")
    COMPATIBLE = ("direction, number compatible", "num.", "v-compatible", "bright_green",
                  "the claimed direction is clear, and the paper's number is among what it may be",
                  "supported, number compatible")
    DIRECTION = ("direction only", "dir.", "v-direction", "cyan",
                 "the claimed direction is clear; the paper's number is missed, not known, or there is none",
                 "supported")
    NOT = ("not reproduced", "no", "v-not", "", "the interval over seeds allows either side", "not supported")
    CONTRADICTED = ("contradicted", "opp.", "v-contradicted", "red",
                    "the opposite is clear, also after Holm's correction for the comparisons of the claim",
                    "contradicted")
    UNTESTABLE = ("untestable", "?", "v-untestable", "dim", "the runs cannot say", "untestable")

    def __new__(cls, word: str, letter: str, css: str, style: str, meaning: str, own: str) -> Finding:
        finding = str.__new__(cls, word)
        finding._value_ = word
        finding.letter, finding.css, finding.style, finding.meaning = letter, css, style, meaning
        finding.own = own
        return finding

    @property
    def holds(self) -> bool:
        """Is the claimed direction there beyond the uncertainty?"""
        return self in (Finding.REPRODUCED, Finding.COMPATIBLE, Finding.DIRECTION)


WORST_FIRST = (Finding.CONTRADICTED, Finding.UNTESTABLE, Finding.NOT, Finding.DIRECTION, Finding.COMPATIBLE,
               Finding.REPRODUCED)
RANK = {finding: rank for rank, finding in enumerate(WORST_FIRST)}
