"""Formulas of the curiosity models, one small pure function each, in plain Python numbers. Information is in nats."""

from __future__ import annotations

from collections.abc import Sequence
from math import exp, log, pi

from attnlab.arithmetic import total


def digamma(x: float) -> float:
    """psi(x), x > 0: recurrence up to 6, then the asymptotic series (error below 1e-12)."""
    shift = 0.0
    while x < 6.0:
        shift -= 1.0 / x
        x += 1.0
    y = 1.0 / (x * x)
    series = y * (1 / 12 - y * (1 / 120 - y * (1 / 252 - y * (1 / 240 - y * (1 / 132 - y * (691 / 32760 - y / 12))))))
    return shift + log(x) - 0.5 / x - series


def lgamma(x: float) -> float:
    """ln Gamma(x), x > 0: recurrence up to 8, then Stirling's series (error below 1e-13 or 1e-14 of it). Not the
    library's: CPython and compiled code have different ones."""
    product = 1.0
    while x < 8.0:
        product *= x
        x += 1.0
    y = 1.0 / (x * x)
    series = 1 / 12 - y * (1 / 360 - y * (1 / 1260 - y * (1 / 1680 - y * (1 / 1188 - y * (691 / 360360 - y / 156)))))
    return (x - 0.5) * log(x) - x + 0.5 * log(2.0 * pi) + series / x - log(product)


def entropy(weights: Sequence[float]) -> float:
    """H of the distribution proportional to ``weights`` (nats)."""
    whole, found = total(weights), 0.0
    for w in weights:
        if w > 0:
            found += w / whole * log(w / whole)
    return -found


def dirichlet_surprise(a: Sequence[float], i: int, direction: str) -> float:
    """Baldi & Itti 2010 (Neural Networks 23:649): how far one observation of ``i`` moves a Dirichlet belief, nats.

    With A = sum a: KL(prior||post) = ln(a_i/A) - psi(a_i) + psi(A); KL(post||prior) = psi(a_i+1) - psi(A+1) -
    ln(a_i/A). ``direction``: prior_post or post_prior.
    """
    whole = total(a)
    ratio = log(a[i] / whole)
    if direction == "prior_post":
        return ratio - digamma(a[i]) + digamma(whole)
    return digamma(a[i] + 1.0) - digamma(whole + 1.0) - ratio


def gamma_divergence(shape_p: float, rate_p: float, shape_q: float, rate_q: float) -> float:
    """KL(p||q) of two Gamma distributions, nats: (a_p - a_q) psi(a_p) - ln G(a_p) + ln G(a_q) + a_q ln(b_p/b_q)
    + a_p (b_q - b_p)/b_p; the surprise of Itti & Baldi 2009 (Vision Research 49:1295) for Poisson data."""
    return ((shape_p - shape_q) * digamma(shape_p) - lgamma(shape_p) + lgamma(shape_q)
            + shape_q * log(rate_p / rate_q) + shape_p * (rate_q - rate_p) / rate_p)


def squash(value: float, scale: float) -> float:
    """An amount without an upper bound as a liking in [0, 1): 1 - exp(-value/scale), 0 for negative ones."""
    return 1.0 - exp(-value / scale) if value > 0.0 else 0.0


def wundt(novelty: float, reward_at: float, punish_at: float, steepness: float, punishment: float) -> float:
    """Shaped like Wundt's curve: a reward sigmoid of novelty less a later punishment sigmoid of relative size."""
    return (1.0 / (1.0 + exp(-steepness * (novelty - reward_at)))
            - punishment / (1.0 + exp(-steepness * (novelty - punish_at))))
