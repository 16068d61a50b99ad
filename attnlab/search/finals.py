"""The finalists, judged by the claims themselves on seeds that took no part, and the answer in words."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from attnlab.claims.files import Claims
from attnlab.claims.findings import Finding
from attnlab.claims.judge import Verdict, judge
from attnlab.claims.roles import strata
from attnlab.search.bench import Played
from attnlab.search.rungs import UNSOUND, Step
from attnlab.search.score import CLEAR, why_unsound
from attnlab.search.space import Row, code
from attnlab.tables.csvs import csv_bytes

REFERENCES: dict[str, dict[str, Any]] = {"inferred": {"reading": "inferred"}, "table4": {"reading": "table4"}}


class Finalist(NamedTuple):
    """``why``: it is not sound on the fresh seeds; empty if it is. ``seeds``: fewest that a role has."""
    name: str
    why: str
    seeds: int
    verdicts: list[Verdict]

    @property
    def holds(self) -> list[str]:
        """Claims that hold in it together."""
        return [verdict.id for verdict in self.verdicts if verdict.holds]


def judged(played: Played, claims: Claims, episodes: int) -> list[Finalist]:
    """Verdicts on each reading that was played, in its order."""
    combinations = strata(claims, played.conditions)
    found = {}
    for name, settings in combinations.items():
        roles = played.runs.get(name)
        if roles:
            found[name] = Finalist(name, why_unsound(roles["control"], episodes), min(map(len_of, roles.values())),
                                   judge(claims, played.conditions, settings))
    return [found[name] for name in played.runs if name in found]


def len_of(runs: Any) -> int:
    """How many seeds a role has."""
    return len(runs.runs)


def finalists_csv(found: Sequence[Finalist], rows: Mapping[str, Row], told: Mapping[str, Mapping[str, str]],
                  points: Sequence[str]) -> str:
    """Reading by claim: verdicts; then how it reads each point."""
    ids = [verdict.id for verdict in found[0].verdicts]
    lines: list[list[Any]] = [["reading", "code", "not_sound", "seeds", "hold", "reproduced", "contradicted", *ids,
                               *points]]
    for of in found:
        verdicts = [verdict.verdict for verdict in of.verdicts]
        counts = [len(of.holds), *(verdicts.count(f) for f in (Finding.REPRODUCED, Finding.CONTRADICTED))]
        levels = told.get(of.name, {})
        lines.append([of.name, code(rows[of.name]) if of.name in rows else "", of.why, of.seeds, *counts, *verdicts,
                      *(levels.get(point, "") for point in points)])
    return _csv(lines)


def rungs_csv(steps: Sequence[Step]) -> str:
    """A row for every reading of every rung; no score: not sound."""
    return _csv([["rung", "seeds", "episodes", "reading", "score"],
                 *([place, step.rung.seeds, step.rung.episodes, code(row), "" if score == UNSOUND else f"{score:.4g}"]
                   for place, step in enumerate(steps, 1) for row, score in step.scores.items())])


def claims_csv(steps: Sequence[Step], scores: Sequence[Mapping[Row, Mapping[str, float]]], ids: Sequence[str]) -> str:
    """Of each rung the share of its sound readings in which the sign of a claim is clear (%)."""
    lines: list[list[Any]] = [["rung", "sound", *ids]]
    for place, (step, of) in enumerate(zip(steps, scores, strict=True), 1):
        sound = step.best
        lines.append([place, len(sound), *(
            f"{100 * sum(of[row].get(key, 0.0) >= CLEAR for row in sound) / len(sound):.3g}" for key in ids)])
    return _csv(lines)


def _csv(rows: Sequence[Sequence[Any]]) -> str:
    return csv_bytes(rows[0], rows[1:]).decode()
