"""What a reading is worth before it is judged: the signs of effects, claim by claim, in lives as short as may be."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from attnlab.arithmetic import total
from attnlab.claims.files import Claims
from attnlab.claims.judge import compared
from attnlab.claims.parts import Part
from attnlab.config import RunSettings
from attnlab.measures.base import CannotMeasure, Measure
from attnlab.registry import make
from attnlab.results.conditions import Runs
from attnlab.stats import mean
from attnlab.stats.soundness import EARLY_EPISODES, unsound

WHOLE = RunSettings().train_episodes  # the training that claims speak of
WINDOWS = ("episodes", "early", "late")  # settings of measures that are [first, end) of the episodes
LENGTHS = ("block", "end", "least_visits")  # and that are counts which grow with the training
CLEAR = 0.5  # score of a claim whose sign most seeds show: three in four or more


@dataclasses.dataclass(frozen=True)
class Sign:
    """A comparison of a claim, and its measure."""
    part: Part
    measure: Measure


Signs = dict[str, list[Sign]]  # claim -> its comparisons that count


def signs(claims: Claims, roles: Sequence[str], episodes: int) -> Signs:
    """The comparisons that count and that these roles can play, for a training of so many ``episodes``: windows, blocks
    and times in episodes shrink alike. A claim of which nothing is left is left out."""
    share = episodes / WHOLE
    found = {key: [_shortened(part, measure, share) for part, measure in
                   zip(claim.parts, claims.measures[key], strict=True) if part.counts and set(part.roles) <= set(roles)]
             for key, claim in claims.claims.items()}
    return {key: of for key, of in found.items() if of}


def _shortened(part: Part, measure: Measure, share: float) -> Sign:
    if share == 1:
        return Sign(part, measure)
    node: dict[str, Any] = part.node
    for name, value in ((name, getattr(measure.params, name, None)) for name in (*WINDOWS, *LENGTHS)):
        if value is not None:
            node[name] = [round(share * end) for end in value] if name in WINDOWS else max(1, round(share * value))
    if part.unit == "episodes" and part.test != "order":
        times = {name: share * value for name in ("reference", "number", "tolerance")
                 if (value := getattr(part, name)) is not None}
        part = dataclasses.replace(part, **times)
    return Sign(dataclasses.replace(part, measure=node), make("measure", node, None))


def scores(of: Signs, roles: Mapping[str, Runs]) -> dict[str, float]:
    """Claim -> from 0 (no more seeds are as claimed than not, or none can say) to 1 (all are); of its comparisons the
    least."""
    taken: dict[tuple[str, str], Mapping[int, float]] = {}
    return {key: min(_score(sign, roles, taken) for sign in each) for key, each in of.items()}


def worth(of: Mapping[str, float]) -> float:
    """Of a reading: its claims' scores together."""
    return round(total(of.values()), 9)


def _score(sign: Sign, roles: Mapping[str, Runs], taken: dict[tuple[str, str], Mapping[int, float]]) -> float:
    part, key, values = sign.part, repr(sign.part.node), dict[str, Mapping[int, float]]()
    for role in part.roles:
        if (role, key) not in taken:
            try:
                taken[role, key] = sign.measure.of(roles[role]) if roles[role].runs else {}
            except CannotMeasure:
                taken[role, key] = {}
        values[role] = {seed: value for seed, value in taken[role, key].items() if value == value}
    x = np.array(list(compared(part, values).values()))
    return max(0.0, 2 * float(as_claimed(part, x).mean()) - 1) if x.size else 0.0


def as_claimed(part: Part, x: np.ndarray) -> np.ndarray:
    """Which seeds are as a comparison claims, shape (seeds,)."""
    if part.test == "not_lower":
        return x >= -(part.margin or 0.0)
    if part.test == "permutation":  # levels differ more than seeds do
        return x > 0
    if part.direction == "about":
        return abs(x - (part.number or 0.0)) <= (part.known or 0.0)
    r = part.reference
    found: np.ndarray = {"higher": x > r, "lower": x < r, "at_least": x >= r, "at_most": x <= r}[part.direction]
    return found


def why_unsound(control: Runs, episodes: int) -> str:
    """Why a reading cannot be meant, from runs of the plain non-curious robot; empty if it may be."""
    if not control.runs:
        return "its runs failed"
    first = [0, min(EARLY_EPISODES, episodes)]
    early = make("measure", {"name": "survival", "phase": "train", "episodes": first}, None).of(control)
    ate, drank = (make("measure", {"name": "episode", "column": column, "phase": "train"}, None).of(control)
                  for column in ("meals", "drinks"))
    return unsound(*(mean(list(of.values())) for of in (early, ate, drank)))
