"""The permutation test of the certificate: it must see a difference, and no more of them than there are."""

from __future__ import annotations

from collections import Counter
from random import Random

from attnlab.certify.episodes import exchangeable


def runs(shift: float, count: int, seed: int) -> list[dict[str, Counter]]:
    """Runs that draw 200 percepts each, around a mean of their own."""
    draw = Random(seed)
    found = []
    for _ in range(count):
        own = draw.gauss(shift, 0.3)
        found.append({"percepts": Counter(round(draw.gauss(own, 1.0)) for _ in range(200))})
    return found


def test_another_distribution_is_seen():
    assert exchangeable(runs(0.0, 6, 1), runs(2.0, 6, 2)) < 0.0125


def test_the_same_distribution_is_rarely_refused():
    refused = sum(exchangeable(runs(0.0, 4, 2 * i), runs(0.0, 4, 2 * i + 1)) < 0.1 for i in range(40))
    assert refused <= 10  # 4 expected; more than 10 once in a thousand


def test_equal_runs_are_exchangeable():
    same = runs(0.0, 5, 3)
    assert exchangeable(same, same) > 0.5


def test_one_seed_tells_nothing():
    assert exchangeable(runs(0.0, 1, 1), runs(5.0, 1, 2)) == 1.0
