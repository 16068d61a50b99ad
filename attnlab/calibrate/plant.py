"""Planted studies at the level of seeds: noise as in real tables, an effect that is known.

What a seed contributes to a comparison is drawn from the residuals of a real study, whole seeds at a time, so that the
comparisons of a claim hang together as they do there, smoothed by a normal kernel (Silverman and Young 1987) of
``KERNEL`` standard deviations, with the spread left as it is. Where nothing sets two robots apart they may change
places: with no effect, a seed's differences have a random sign. A comparison that no real table could be made for has
standard normal noise; what is said of the seeds it needs would be made up, and is left out.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from attnlab.claims import rules as decide
from attnlab.claims.parts import PAIRED, Part, Rules

Floats = npt.NDArray[np.float64]
Effect = Literal["none", "paper"]
KERNEL = 0.3
MEDIUM = 0.5  # standardised effect (Cohen 1988) where the paper gives a direction and no number


@dataclass
class Noise:
    """Residuals of the comparisons of a claim, shape (seeds, parts), of unit spread; ``sd`` (parts,), nan where no
    table says it."""
    rows: Floats
    sd: Floats

    @property
    def known(self) -> bool:
        return bool(np.isfinite(self.sd).all())


def noise(parts: Sequence[Part], samples: Sequence[Mapping[int, float]]) -> Noise:
    """From what each seed contributed to each comparison (seed -> value): around its mean, or its median where that is
    compared. What may be never has no spread; it, orders and permutations are planted without one."""
    from scipy.stats import norm
    able = [i for i, sample in enumerate(samples) if len(sample) > 2 and parts[i].test not in ("order", "permutation")
            and np.isfinite(list(sample.values())).all()]
    shared = sorted(set.intersection(*(set(samples[i]) for i in able))) if able else []
    rows, sd = np.full((max(len(shared), 1), len(parts)), np.nan), np.full(len(parts), np.nan)
    for i in able if len(shared) > 2 else ():
        x = np.array([samples[i][seed] for seed in shared])
        sd[i] = x.std(ddof=1)
        rows[:, i] = (x - x.mean()) / (sd[i] or 1.0)
        if parts[i].test == "median":  # that of what is drawn, kernel and all
            rows[:, i] -= np.median(rows[:, i, None] + KERNEL * norm.ppf((np.arange(999) + 0.5) / 999))
    for i, part in enumerate(parts):
        if part.test in ("order", "permutation") or (samples[i] and np.isinf(list(samples[i].values())).any()):
            sd[i] = 1.0
    return Noise(rows, sd)


def studies(parts: Sequence[Part], of: Noise, effect: Effect, seeds: int, planted: int, rng: np.random.Generator
            ) -> list[Floats]:
    """For each comparison what ``seeds`` contribute in each of ``planted`` studies, shape (planted, seeds)."""
    shape = planted, seeds
    chosen = rng.integers(0, len(of.rows), shape)
    places = rng.choice([-1.0, 1.0], shape) if effect == "none" else np.ones(shape)
    found = []
    for i, part in enumerate(parts):
        drawn, sd = of.rows[chosen, i], of.sd[i]
        if part.test == "order":
            wins = np.where(rng.random(shape) < (0.5 if effect == "none" else 0.75), 100.0, -100.0)
            found.append(wins if part.direction in ("higher", "at_least") else -wins)
        elif part.test == "median" and np.isnan(drawn).any():
            found.append(_times(part, effect, shape, rng))
        else:
            smooth = rng.standard_normal(shape)
            z = smooth if np.isnan(drawn).any() else (drawn + KERNEL * smooth) / np.hypot(1, KERNEL)
            scale = float(sd) if np.isfinite(sd) else part.known or part.margin or 1.0
            found.append(_centre(part, effect, scale) + scale * z * (places if part.test in PAIRED else 1.0))
    return found


def _centre(part: Part, effect: Effect, sd: float) -> float:
    """Where the mean is put: where nothing is shown, or where the paper has it."""
    turn = decide.turn(part)
    if part.test == "not_lower":
        return turn if effect == "none" else 0.0
    if part.direction == "about":  # just not the same, or the same
        return turn + (part.known or 0.0) * (effect == "none")
    if effect == "none":
        return turn
    if part.number is not None:
        return part.number
    return turn + MEDIUM * sd * (1 if part.direction in ("higher", "at_least") else -1)


def _times(part: Part, effect: Effect, shape: tuple[int, int], rng: np.random.Generator) -> Floats:
    """Times of which some are never: with no effect the median is where the rule turns, with the paper's it is on its
    side in nine seeds of ten, or within a block of its number."""
    early, late = (part.number or 0.0, np.inf) if part.direction == "about" else \
        (part.reference, np.inf) if part.direction in ("at_most", "lower") else (part.reference - 50, part.reference)
    if effect == "none":
        return np.where(rng.random(shape) < 0.5, early, late).astype(float)
    if part.direction == "about":
        return (part.number or 0.0) + (part.known or 0.0) * rng.integers(-1, 2, shape).astype(float)
    good, bad = (early, late) if part.direction in ("at_most", "lower") else (late, early)
    return np.where(rng.random(shape) < 0.9, good, bad).astype(float)


def findings(parts: Sequence[Part], samples: Sequence[Floats], rules: Rules, effect: Effect, rng: np.random.Generator
             ) -> npt.NDArray[np.int64]:
    """Ranks of the verdicts on the claim, shape (planted,). A permutation test is exact: with no effect its p is
    uniform; with one it is taken to be clear."""
    codes, p = [], []
    for part, x in zip(parts, samples, strict=True):
        if part.test == "permutation":
            drawn = rng.random(len(x)) * (effect == "none")
            codes.append(np.where(drawn < 1 - rules.confidence, decide.DIRECTION, decide.NOT))
            p.append(drawn)
            continue
        d = decide.interval(part, x, rules)
        codes.append(decide.grade(part, d))
        p.append(d.p)
    return decide.together(parts, codes, p, samples[0].shape[1], rules)[0]
