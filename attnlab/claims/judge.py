"""Verdicts: what a study says about each claim, paired by seed, with intervals over seeds."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from attnlab.claims.files import Claim, Claims, Part, Permuted, Rules
from attnlab.claims.findings import WORST_FIRST, Finding
from attnlab.measures.base import CannotMeasure, Measure
from attnlab.results.conditions import Conditions, Runs
from attnlab.stats.seeds import Interval, bootstrap_interval, effect_size, holm, mean, paired, sign_flip_p

REPRODUCED, DIRECTION, NOT, CONTRADICTED, UNTESTABLE = VERDICTS = tuple(Finding)
NOTHING = Interval(float("nan"), float("nan"), float("nan"))
Cache = dict[tuple[str, str], Mapping[int, float] | CannotMeasure]  # (role, measure) -> what was measured


@dataclass
class PartVerdict:
    """The outcome of one comparison. ``value``: mean with interval of the difference or level, in the part's unit."""
    part: Part
    verdict: Finding
    reason: str
    value: Interval = NOTHING
    effect: float = float("nan")
    p: float = float("nan")
    seeds: int = 0
    levels: dict[str, float] = field(default_factory=dict)


@dataclass
class Verdict:
    """The outcome of a claim. ``p`` is the largest of its counting parts (all must hold), ``p_holm`` corrected for the
    number of claims."""
    id: str
    claim: Claim
    verdict: Finding
    reason: str
    parts: list[PartVerdict]
    p: float
    p_holm: float = float("nan")

    @property
    def lead(self) -> PartVerdict:
        """The part that decided: the first counting one with the claim's own verdict."""
        counting = [part for part in self.parts if part.part.counts]
        return next((part for part in counting if part.verdict == self.verdict), counting[0])

    @property
    def holds(self) -> bool:
        """Is the claimed direction there beyond the uncertainty?"""
        return self.verdict.holds


def judge(claims: Claims, conditions: Conditions, stratum: Mapping[str, str] | None = None) -> list[Verdict]:
    """Verdicts on all claims from the runs of one combination of the other settings (``stratum``: name -> text)."""
    roles = {name: conditions.matching(role.where, stratum or {})[0] for name, role in claims.roles.items()}
    cache: Cache = {}
    verdicts = []
    for key, claim in claims.claims.items():
        parts = [_part(claims, part, measure, roles, cache) for part, measure in
                 zip(claim.parts, claims.measures[key], strict=True)]
        verdicts.append(_together(key, claim, parts))
    for verdict, p in zip(verdicts, holm([v.p for v in verdicts]), strict=True):
        verdict.p_holm = p
    return verdicts


def _part(claims: Claims, part: Part, measure: Measure, roles: Mapping[str, Runs], cache: Cache) -> PartVerdict:
    """Measure, compare, decide."""
    wanted = ("treatment", "control") if part.test in ("paired", "not_lower") else (part.role,)
    values: dict[str, dict[int, float]] = {}
    for role in wanted:
        label = claims.roles[role].label
        if not roles[role].runs:
            return PartVerdict(part, UNTESTABLE, f"no complete run of {label}")
        kept = (role, repr(part.measure))
        if kept not in cache:
            try:
                cache[kept] = measure.of(roles[role])
            except CannotMeasure as cannot:
                cache[kept] = cannot
        measured = cache[kept]
        if isinstance(measured, CannotMeasure):
            return PartVerdict(part, UNTESTABLE, f"{label}: {measured}")
        values[role] = dict(measured)
    levels = {role: mean(list(of_seed.values())) for role, of_seed in values.items()}
    if len(wanted) == 2:
        sample = paired(values["treatment"], values["control"])
    else:
        sample = paired(values[part.role], dict.fromkeys(values[part.role], 0.0))
    rules = claims.rules
    if len(sample) < rules.least_seeds:
        what = "paired seeds" if len(wanted) == 2 else "seeds with a value"
        return PartVerdict(part, UNTESTABLE, f"{len(sample)} {what}, {rules.least_seeds} are needed",
                           Interval(mean(sample), float("nan"), float("nan")), seeds=len(sample), levels=levels)
    interval = bootstrap_interval(sample, confidence=rules.confidence, resamples=rules.resamples, seed=rules.seed)
    if part.test == "permutation" and isinstance(measure, Permuted):
        return _permutation(part, measure, roles[part.role], interval, len(sample), levels, rules)
    against = -(part.margin or 0.0) if part.test == "not_lower" else part.reference
    p = float("nan") if part.direction == "about" and part.test != "not_lower" else \
        sign_flip_p(sample, against, seed=rules.seed)
    verdict, why = _decide(part, interval)
    return PartVerdict(part, verdict, f"{_shown(claims, part, interval, levels)}: {why}", interval,
                       effect_size(sample, against), p, len(sample), levels)


def _decide(part: Part, d: Interval) -> tuple[Finding, str]:
    """The verdict of an interval and why, by the rules of docs/claims.md."""
    if part.test == "not_lower":
        margin = part.margin or 0.0
        if d.low >= -margin:
            return REPRODUCED, f"not lower by more than {margin:g}"
        if d.high < -margin:
            return CONTRADICTED, f"lower by more than {margin:g}"
        return NOT, f"may be lower by more than {margin:g}"
    number, tolerance = part.number, part.tolerance or 0.0
    near = number is None or abs(d.value - number) <= tolerance
    paper = "" if number is None else f"the paper's {number:g} ± {tolerance:g}"
    if part.direction == "about" and number is not None:
        if near:
            return REPRODUCED, f"within {paper}"
        apart = d.low > number + tolerance or d.high < number - tolerance
        return (CONTRADICTED, f"away from {paper}") if apart else (NOT, f"not clearly within {paper}")
    r = part.reference
    holds, opposite = {"higher": (d.low > r, d.high < r), "lower": (d.high < r, d.low > r),
                       "at_least": (d.low >= r, d.high < r), "at_most": (d.high <= r, d.low > r)}[part.direction]
    side = f"{part.direction.replace('_', ' ')}{'' if part.direction.startswith('at') else ' than'} {r:g}" \
        if part.test == "level" else part.direction
    if holds and near:
        return REPRODUCED, f"clearly {side}" + (f", within {paper}" if paper else "")
    if holds:
        return DIRECTION, f"clearly {side}, but not within {paper}"
    if opposite:
        return CONTRADICTED, f"clearly not {side}"
    return NOT, f"not clearly {side}"


def _permutation(part: Part, measure: Permuted, runs: Runs, interval: Interval, seeds: int, levels: dict[str, float],
                 rules: Rules) -> PartVerdict:
    import numpy as np
    null = measure.null(runs, 2000, rules.seed)
    null = null[~np.isnan(null)]
    if not null.size or math.isnan(interval.value):
        return PartVerdict(part, UNTESTABLE, "the tables share no visited cell", seeds=seeds)
    p = float((np.sum(null >= interval.value - 1e-9) + 1) / (null.size + 1))
    spread = float(null.std())
    effect = (interval.value - float(null.mean())) / spread if spread > 0 else float("nan")
    verdict = REPRODUCED if p < 1 - rules.confidence else NOT
    why = f"{interval.value:.3g} {part.unit} more difference between levels than within; by chance up to " \
          f"{np.quantile(null, rules.confidence):.3g}"
    return PartVerdict(part, verdict, why, interval, effect, p, seeds, levels)


def _shown(claims: Claims, part: Part, d: Interval, levels: Mapping[str, float]) -> str:
    unit = "" if part.unit == "1" else f" {part.unit}"
    label = {role: claims.roles[role].label for role in levels}
    if len(levels) == 2:
        what = f"{label['treatment']} {levels['treatment']:.4g}, {label['control']} {levels['control']:.4g}{unit}, " \
               f"difference {d.value:+.3g}"
    else:
        what = f"{label[part.role]} {d.value:.4g}{unit}"
    return f"{what} [{d.low:.3g}, {d.high:.3g}]"


def _together(key: str, claim: Claim, parts: list[PartVerdict]) -> Verdict:
    """All counting parts must hold: the claim fares as its worst part, contradicted being worst."""
    counting = [part for part in parts if part.part.counts]
    verdict = min((part.verdict for part in counting), key=WORST_FIRST.index)
    known = [part.p for part in counting if not math.isnan(part.p)]
    p = max(known) if known and verdict != UNTESTABLE else float("nan")
    reasons = [part.reason for part in counting if verdict.holds or part.verdict == verdict]
    return Verdict(key, claim, verdict, "; ".join(dict.fromkeys(reasons)), parts, p)
