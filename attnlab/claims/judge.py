"""Verdicts: what a study says about each claim, paired by seed, with intervals over seeds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from attnlab.claims import rules as decide
from attnlab.claims import words
from attnlab.claims.files import Claims, Permuted
from attnlab.claims.findings import RANK, WORST_FIRST, Finding
from attnlab.claims.parts import PAIRED, Claim, Part
from attnlab.claims.roles import failed, withheld
from attnlab.measures.base import CannotMeasure, Measure
from attnlab.results.conditions import Conditions, Runs
from attnlab.stats import Interval, bca_interval, effect_size, holm, mean, sign_flip_p

NAN = float("nan")
NOTHING = Interval(NAN, NAN, NAN)
Cache = dict[tuple[str, str], Mapping[int, float] | CannotMeasure]  # (role, repr of the measure's node) -> its values


@dataclass
class PartVerdict:
    """The outcome of one comparison, all numbers in the part's unit.

    ``value``: mean (or median) with the interval that decides; ``bca``: the bootstrap interval beside it. ``p``: of the
    test behind the interval; ``p_flip``: by exact sign flips. ``sample``: seed -> what was compared. ``forms``: what
    other ways of measuring find. ``worst``: the finding if failed seeds count as the least favourable one seen.
    """
    part: Part
    verdict: Finding
    reason: str
    value: Interval = NOTHING
    bca: tuple[float, float] = (NAN, NAN)
    effect: float = NAN
    p: float = NAN
    p_flip: float = NAN
    sample: dict[int, float] = field(default_factory=dict)
    levels: dict[str, float] = field(default_factory=dict)
    forms: dict[str, Finding] = field(default_factory=dict)
    worst: Finding | None = None

    @property
    def seeds(self) -> int:
        return len(self.sample)


@dataclass
class Verdict:
    """The outcome of a claim. ``p`` is that of the comparison that decided, ``p_holm`` corrected for the number of
    claims. ``worst``: the verdict at worst, where runs failed; None where none did. ``own``: a hypothesis of one's own,
    not a paper's claim."""
    id: str
    claim: Claim
    verdict: Finding
    reason: str
    parts: list[PartVerdict]
    p_holm: float = NAN
    worst: Finding | None = None
    own: bool = False

    @property
    def word(self) -> str:
        """What the verdict is called: a hypothesis of one's own is supported, not reproduced."""
        return self.verdict.own if self.own else str(self.verdict)

    @property
    def lead(self) -> PartVerdict:
        """The part that decided: the first counting one with the claim's own verdict."""
        counting = [part for part in self.parts if part.part.counts]
        return next((part for part in counting if part.verdict == self.verdict), counting[0])

    @property
    def p(self) -> float:
        return NAN if self.verdict is Finding.UNTESTABLE else self.lead.p

    @property
    def holds(self) -> bool:
        """Is the claimed direction there beyond the uncertainty?"""
        return self.verdict.holds


def judge(claims: Claims, conditions: Conditions, stratum: Mapping[str, str] | None = None,
          measured: Cache | None = None) -> list[Verdict]:
    """Verdicts on all claims from the runs of one combination of the other settings (``stratum``: name -> text).
    ``measured``: takes what was measured, for who wants to compare more."""
    roles = {name: conditions.matching(role.where, stratum or {})[0] for name, role in claims.roles.items()}
    out = {name: failed(conditions, role.where, stratum or {}) for name, role in claims.roles.items()}
    return judge_roles(claims, roles, out, {} if measured is None else measured)


def judge_roles(claims: Claims, roles: Mapping[str, Runs], out: Mapping[str, set[int]], measured: Cache
                ) -> list[Verdict]:
    """The same from the runs of every role, wherever they are from, and the seeds that failed (``out``)."""
    why = withheld(claims, roles)
    bench = _Bench(claims, roles, out, measured)
    verdicts = []
    for key, claim in claims.claims.items():
        if why:
            verdicts.append(Verdict(key, claim, Finding.UNTESTABLE, why,
                                    [PartVerdict(part, Finding.UNTESTABLE, why) for part in claim.parts]))
            continue
        parts = [bench.compare(part, measure, forms) for part, measure, forms in
                 zip(claim.parts, claims.measures[key], claims.forms[key], strict=True)]
        verdicts.append(_together(key, claim, parts, claims))
    for verdict, p in zip(verdicts, holm([v.p for v in verdicts]) if verdicts else (), strict=True):
        verdict.p_holm, verdict.own = float(p), claims.own
    return verdicts


@dataclass
class _Bench:
    """Runs by role, seeds that failed by role, and what was measured of them."""
    claims: Claims
    roles: Mapping[str, Runs]
    failed: Mapping[str, set[int]]
    measured: Cache = field(default_factory=dict)

    def compare(self, part: Part, measure: Measure, forms: Mapping[str, Measure]) -> PartVerdict:
        """Measure, compare, grade; then the same by every other form."""
        found = self._one(part, measure, repr(part.node))
        for name, other in forms.items():
            found.forms[name] = self._one(part, other, repr({**part.node, **part.forms[name]})).verdict
        return found

    def _one(self, part: Part, measure: Measure, key: str) -> PartVerdict:
        rules = self.claims.rules
        values: dict[str, dict[int, float]] = {}
        for role in part.roles:
            taken = self._take(role, measure, key)
            if isinstance(taken, str):
                return PartVerdict(part, Finding.UNTESTABLE, taken)
            values[role] = {seed: value for seed, value in taken.items() if value == value}
        levels = {role: mean(list(of.values())) for role, of in values.items()}
        sample = compared(part, values)
        if len(sample) < rules.least_seeds:
            what = "paired seeds" if part.test in PAIRED else "seeds with a value"
            alone = Interval(mean(list(sample.values())), NAN, NAN)
            return PartVerdict(part, Finding.UNTESTABLE, f"{len(sample)} {what}, {rules.least_seeds} are needed",
                               alone, sample=sample, levels=levels)
        if part.test == "permutation" and isinstance(measure, Permuted):
            return self._permuted(part, measure, sample, levels)
        x = np.array([sample[seed] for seed in sorted(sample)])
        d = decide.interval(part, x, rules)
        finding = WORST_FIRST[int(decide.grade(part, d)[0])]
        at = decide.turn(part)
        finite = bool(np.isfinite(x).all())
        found = PartVerdict(
            part, finding, f"{words.shown(self.claims, part, d, levels)}: {words.why(part, finding)}",
            Interval(float(d.value), float(d.low), float(d.high)),
            bca_interval(x, rules.confidence, rules.resamples, rules.seed) if part.test != "median" else (NAN, NAN),
            effect_size(x, at) if finite else NAN, float(d.p), sign_flip_p(x, at, seed=rules.seed) if finite else NAN,
            sample, levels)
        found.worst = self._at_worst(part, x)
        return found

    def _at_worst(self, part: Part, x: np.ndarray) -> Finding | None:
        """The finding if every seed that failed came out as the least favourable of those that did not: on either side
        where a number is to be met."""
        lost = len(set().union(*(self.failed[role] for role in part.roles)))
        if not lost:
            return None
        extremes = {"higher": [x.min()], "at_least": [x.min()], "lower": [x.max()], "at_most": [x.max()]}.get(
            part.direction, [x.min()] if part.test == "not_lower" else [x.min(), x.max()])
        graded = [decide.grade(part, decide.interval(part, np.append(x, [worst] * lost), self.claims.rules))[0]
                  for worst in extremes]
        return WORST_FIRST[int(min(graded))]

    def _take(self, role: str, measure: Measure, key: str) -> Mapping[int, float] | str:
        """What was measured of a role, or why nothing was."""
        label = self.claims.roles[role].label
        if not self.roles[role].runs:
            return f"no complete run of {label}"
        if (role, key) not in self.measured:
            try:
                self.measured[role, key] = measure.of(self.roles[role])
            except CannotMeasure as cannot:
                self.measured[role, key] = cannot
        taken = self.measured[role, key]
        return f"{label}: {taken}" if isinstance(taken, CannotMeasure) else taken

    def _permuted(self, part: Part, measure: Permuted, sample: dict[int, float], levels: dict[str, float]
                  ) -> PartVerdict:
        null = measure.null(self.roles[part.role], 2000, self.claims.rules.seed)
        null = null[~np.isnan(null)]
        value = mean(list(sample.values()))
        if not null.size:
            return PartVerdict(part, Finding.UNTESTABLE, "the tables share no visited cell")
        p = float((np.sum(null >= value - 1e-9) + 1) / (null.size + 1))
        spread = float(null.std())
        effect = (value - float(null.mean())) / spread if spread > 0 else NAN
        finding = Finding.DIRECTION if p < 1 - self.claims.rules.confidence else Finding.NOT
        chance = float(np.quantile(null, self.claims.rules.confidence))
        return PartVerdict(part, finding, words.permuted(part, value, chance), Interval(value, NAN, NAN), effect=effect,
                           p=p, sample=sample, levels=levels)


def compared(part: Part, values: Mapping[str, Mapping[int, float]]) -> dict[int, float]:
    """Seed -> what is compared: a difference, a sign in %, or a level."""
    ours = values[part.role]
    if part.test not in PAIRED:
        return {seed: ours[seed] for seed in sorted(ours)}
    theirs = values[part.against]
    both = sorted(set(ours) & set(theirs))
    if part.test == "order":
        return {seed: 100.0 * float((ours[seed] > theirs[seed]) - (ours[seed] < theirs[seed])) for seed in both}
    return {seed: ours[seed] - theirs[seed] for seed in both}


def _together(key: str, claim: Claim, parts: list[PartVerdict], claims: Claims) -> Verdict:
    """All counting parts must hold: the claim fares as its worst part, contradicted being worst."""
    counting = [part for part in parts if part.part.counts]

    def fare(findings: Sequence[Finding]) -> tuple[Finding, list[Finding]]:
        codes, each = decide.together([part.part for part in counting],
                                      [np.array([RANK[finding]]) for finding in findings],
                                      [np.array([part.p]) for part in counting],
                                      min(part.seeds for part in counting), claims.rules)
        return WORST_FIRST[int(codes[0])], [WORST_FIRST[int(code[0])] for code in each]
    verdict, each = fare([part.verdict for part in counting])
    for part, finding in zip(counting, each, strict=True):
        if finding is not part.verdict:
            part.verdict, part.reason = finding, f"{part.reason} ({words.NOT_AFTER_HOLM})"
    worst = fare([part.worst or part.verdict for part in counting])[0] if any(p.worst for p in counting) else None
    told = [part for part in counting if verdict.holds or part.verdict == verdict]
    reason = "; ".join(dict.fromkeys(filter(None, [*(part.reason for part in told), words.hanging(counting)])))
    return Verdict(key, claim, verdict, reason, parts, worst=worst)
