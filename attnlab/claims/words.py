"""Verdicts in words: what was found, and why it was judged so."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from attnlab.claims.files import Claims
from attnlab.claims.findings import Finding
from attnlab.claims.parts import PAIRED, Part
from attnlab.stats import Ends

if TYPE_CHECKING:
    from attnlab.claims.judge import PartVerdict

NOT_AFTER_HOLM = "too little to contradict a claim of several comparisons"


def shown(claims: Claims, part: Part, d: Ends, levels: Mapping[str, float]) -> str:
    """Levels, difference and interval: "CR 0.28, NCR 0.3, difference -0.02 [-0.03, -0.01]"."""
    unit = "" if part.unit == "1" else f" {part.unit}"
    ours = claims.roles[part.role].label
    between = f"[{number(float(d.low))}, {number(float(d.high))}]"
    if part.test == "order":
        theirs = claims.roles[part.against].label
        return f"{ours} above {theirs} in {float(d.value):+.0f} % more seeds than below {between}"
    if part.test == "median":
        return f"{ours} median {number(float(d.value))}{unit} {between}"
    if part.test in PAIRED:
        theirs = claims.roles[part.against].label
        return f"{ours} {levels[part.role]:.4g}, {theirs} {levels[part.against]:.4g}{unit}, difference " \
               f"{float(d.value):+.3g} {between}"
    return f"{ours} {float(d.value):.4g}{unit} {between}"


def number(value: float) -> str:
    """Three digits; what never happened is "never"."""
    return "never" if value == float("inf") else "any" if value == float("-inf") else f"{value:.3g}"


def why(part: Part, finding: Finding) -> str:
    """Why the interval was graded so."""
    if part.test == "not_lower":
        margin = f"lower by more than {part.margin:g}"
        return {Finding.REPRODUCED: f"not {margin}", Finding.CONTRADICTED: margin}.get(finding, f"may be {margin}")
    paper = "" if part.number is None else f"the paper's {part.number:g}" if part.known is None else \
        f"the paper's {part.number:g} ± {part.known:.3g}"
    if part.direction == "about":
        return {Finding.REPRODUCED: f"all within {paper}", Finding.CONTRADICTED: f"away from {paper}"}.get(
            finding, f"not all within {paper}")
    r = part.reference
    side = part.direction.replace("_", " ") + ("" if part.direction.startswith("at") else " than") + f" {r:g}" \
        if part.test in ("level", "median") else part.direction
    told = {Finding.REPRODUCED: f"clearly {side}, all within {paper}",
            Finding.COMPATIBLE: f"clearly {side}, compatible with {paper}",
            Finding.CONTRADICTED: f"clearly not {side}", Finding.NOT: f"not clearly {side}"}
    if finding is Finding.DIRECTION:
        missed = "" if not paper else f", not within {paper}" if part.known is not None else \
            f" ({paper}, whose precision is not known)"
        return f"clearly {side}{missed}"
    return told[finding]


def permuted(part: Part, value: float, chance: float) -> str:
    return f"{value:.3g} {part.unit} more difference between levels than within; by chance up to {chance:.3g}"


def hanging(parts: Sequence[PartVerdict]) -> str:
    """Which comparisons come out otherwise in another form; "" if none does."""
    found = [f"{part.part.measure_name} {name}: {finding}" for part in parts for name, finding in part.forms.items()
             if finding.holds != part.verdict.holds or (finding is Finding.CONTRADICTED)
             != (part.verdict is Finding.CONTRADICTED)]
    return f"hangs on the form ({'; '.join(found)})" if found else ""
