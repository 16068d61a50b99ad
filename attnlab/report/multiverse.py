"""What the paper's ambiguities do to its claims: a study with many readings, judged reading by reading and together."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from attnlab.claims.files import Claims
from attnlab.claims.findings import Finding
from attnlab.claims.judge import Cache, Verdict
from attnlab.claims.parts import Claim
from attnlab.claims.roles import Combinations
from attnlab.report.contrasts import Contrast, contrasts, differences
from attnlab.report.statements import Statement, all_statements
from attnlab.results.conditions import Conditions
from attnlab.stats.specification import (
    Joint,
    clear_from,
    joint_test,
    levels_test,
    standardised,
    variance_shares,
)
from attnlab.tables.flat import text

Floats = npt.NDArray[np.float64]
LEAST_READINGS = 8  # fewer combinations are shown as a plain matrix


class Moved(NamedTuple):
    """Share of the readings with this level in which a claim holds, less the share with the default level."""
    claim: str
    factor: str
    level: str
    default: str
    difference: float


@dataclass
class Curves:
    """Signed standardised effects over the readings. ``differences`` (readings, contrasts, seeds), above 0 as claimed;
    ``effects`` with t intervals ``low``, ``high`` (readings, contrasts), nan without value; ``shares``: of each
    contrast the variance of its effects by factor; ``statements``: what each says."""
    contrasts: list[Contrast]
    differences: Floats
    effects: Floats
    low: Floats
    high: Floats
    joint: Joint
    shares: list[dict[str, float]]
    statements: list[Statement]

    @property
    def shared(self) -> int:
        """How many seeds all readings have that have any."""
        there: npt.NDArray[np.bool_] = np.any(~np.isnan(self.differences), axis=1)
        return int(np.all(there[np.any(there, axis=1)], axis=0).sum())

    def mover(self, contrast: int) -> tuple[str, float]:
        """The factor with the largest share of a contrast's variance over readings."""
        return next(iter(self.movers(contrast)), ("nothing", 0.0))

    def movers(self, contrast: int) -> list[tuple[str, float]]:
        """Factors with their share of the variance, largest first."""
        named = [(name, share) for name, share in self.shares[contrast].items() if name != "other"]
        return sorted(named, key=lambda item: -item[1])


@dataclass
class Multiverse:
    """``claims``: by id; ``findings``: of each what was found in every reading. ``levels``: factor -> level by reading.
    ``curves``: None where no signed comparison can be made, or the readings have too few seeds."""
    claims: dict[str, Claim]
    names: list[str]
    findings: list[list[Finding]]
    levels: dict[str, list[str]]
    defaults: dict[str, str]
    moved: list[Moved]
    curves: Curves | None
    own: bool = False  # hypotheses of one's own, not a paper's claims

    @cached_property
    def holds(self) -> Floats:
        """(claims, readings): 1, 0, or nan where untestable."""
        return np.array([[np.nan if one is Finding.UNTESTABLE else float(one.holds) for one in of]
                         for of in self.findings])

    @cached_property
    def reproduced(self) -> npt.NDArray[np.bool_]:
        """(claims, readings)"""
        return np.array([[one is Finding.REPRODUCED for one in of] for of in self.findings])

    def share(self, row: int) -> tuple[float, int]:
        """(share of the testable readings in which claim ``row`` holds, how many can test it)."""
        seen = self.holds[row][~np.isnan(self.holds[row])]
        return (float(seen.mean()) if seen.size else float("nan")), int(seen.size)


def analyse(claims: Claims, conditions: Conditions, combinations: Combinations,
            judged: Mapping[str, Sequence[Verdict]], measured: Mapping[str, Cache]) -> Multiverse:
    """Shares of claims, signed effects and their joint test. Settings that always change together are one factor.
    ``measured``: of each combination what its verdicts took."""
    verdicts = list(judged.values())
    first = verdicts[0]
    levels, defaults = factors_of(list(combinations.values()))
    wanted = contrasts(claims)
    findings = [[of[i].verdict for of in verdicts] for i in range(len(first))]
    found = Multiverse({v.id: v.claim for v in first}, list(judged), findings, levels, defaults, [],
                       curves_of(wanted, differences(claims, conditions, combinations, measured, wanted), levels),
                       claims.own)
    found.moved = [one for i, verdict in enumerate(first) for factor, of in levels.items()
                   for one in _moved(verdict.id, factor, np.array(of), defaults[factor], found.holds[i])]
    return found


def curves_of(wanted: Sequence[Contrast], signed: Floats, levels: Mapping[str, Sequence[str]]) -> Curves | None:
    """The curves of these contrasts, ``signed`` (readings, contrasts, seeds); one without any effect is left out."""
    effects = standardised(signed)
    there = [c for c in range(len(wanted)) if not np.isnan(effects[:, c]).all()]
    if not there:
        return None
    signed, effects = signed[:, there], effects[:, there]
    reach = clear_from(signed)
    joint, tests = joint_test(signed), levels_test(signed, levels)
    shares = [variance_shares(column, levels) for column in effects.T]
    return Curves([wanted[c] for c in there], signed, effects, effects - reach, effects + reach, joint, shares,
                  all_statements(effects, joint, tests, levels, shares))


def factors_of(readings: Sequence[Mapping[str, str]]) -> tuple[dict[str, list[str]], dict[str, str]]:
    import dataclasses

    from attnlab.reading import Reading
    plain = {f"reading.{name}": text(value) for name, value in dataclasses.asdict(Reading()).items()}
    merged: dict[tuple[int, ...], list[str]] = {}
    for name in readings[0]:
        if name == "variant":
            continue  # the name of a combination, not a setting of it
        column = [settings[name] for settings in readings]
        codes = tuple(list(dict.fromkeys(column)).index(value) for value in column)
        if len(set(codes)) > 1:
            merged.setdefault(codes, []).append(name)
    levels, defaults = {}, {}
    for names in merged.values():
        label = " + ".join(name.removeprefix("reading.") for name in names)
        column = [" + ".join(settings[name] for name in names) for settings in readings]
        usual = " + ".join(plain.get(name, "") for name in names)
        levels[label] = column
        defaults[label] = usual if usual in column else column[0]
    return levels, defaults


def _moved(claim: str, factor: str, of: npt.NDArray[np.str_], default: str, holds: Floats) -> list[Moved]:
    """Differences of shares between each level and the default: descriptions of a fixed design, without intervals."""
    known = ~np.isnan(holds)
    base = holds[known & (of == default)]
    found = []
    for level in dict.fromkeys(of.tolist()):
        here = holds[known & (of == level)]
        if level != default and len(base) and len(here):
            found.append(Moved(claim, factor, level, default, float(here.mean() - base.mean())))
    return found
