"""Ways against exact solutions, on chains of percepts: also those whose paper has no toy that could be had."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from random import Random

from attnlab.testing.driving import clock, drive, greedy
from attnlab.testing.processes import BINS, PERIODS, RING, WALK, earn, optimal, powers

DANGER = (0, 1, 2)  # percepts of AVOID that the watchful learners take for danger, by their defaults
PRICE = 0.4  # of a look, for bandwidth


def off(found: Sequence[Sequence[float]], exact: Sequence[Sequence[float]]) -> dict[str, float]:
    """``error``: the largest difference, as a share of the largest exact value."""
    scale = max(abs(value) for row in exact for value in row)
    return {"error": max(abs(a - b) for one, other in zip(found, exact, strict=True)
                         for a, b in zip(one, other, strict=True)) / scale}


def during(discount: float) -> dict[int, float]:
    """By period: the sum over its cycles of discount^k."""
    return {p: sum(discount ** k for k in range(p)) for p in PERIODS}


def tempo_rl(seed: int, looks: int) -> dict[str, float]:
    """A period, then looking in every cycle, on the ring: its values are one look ahead of that."""
    made, flat = drive(clock("tempo_rl"), RING, earn, looks, seed), [0.0] * BINS
    for _ in range(500):
        flat = [earn(1, (x + 1) % BINS) + 0.9 * flat[(x + 1) % BINS] for x in range(BINS)]
    whole = during(0.9)
    exact = [[whole[p] * earn(p, (x + p) % BINS) + 0.9 ** p * flat[(x + p) % BINS] for p in PERIODS]
             for x in range(BINS)]
    return off([made.q[BINS + x] for x in range(BINS)], exact)


def amrl(seed: int, looks: int) -> dict[str, float]:
    """On the ring, for rewards that hang on the arrival alone, as its imagined looks have it."""
    def reward(_: int, after: int) -> float:
        return after / (BINS - 1)
    made = drive(clock("amrl", look_cost=0.2), RING, reward, looks, seed)
    return off([made.q[BINS + x] for x in range(BINS)], optimal(RING, reward, lambda _: 0.9, 0.2))


def tacos(seed: int, looks: int) -> dict[str, float]:
    """The rate of reward throughout a period, discounted by the cycle, on the ring."""
    whole = during(0.98)
    exact = optimal(RING, lambda p, x: whole[p] * earn(p, x), lambda p: 0.98 ** p, 0.2)
    made = drive(clock("tacos", look_cost=0.2), RING, earn, looks, seed)
    return off([made.q[BINS + x] for x in range(BINS)], exact)


def timing(seed: int, looks: int) -> dict[str, float]:
    """The plan of its own model, on the walk."""
    made = drive(clock("timing", sweeps=200), WALK, earn, looks, seed)
    return off(made.plan, optimal(WALK, earn, lambda _: 0.9))


def harms() -> list[list[float]]:
    """Chance of danger k cycles after a look at each percept of the walk, exactly; 0 where danger is known."""
    return [[0.0 if x in DANGER else sum(power[x][d] for d in DANGER) for power in powers(WALK)] for x in range(BINS)]


def self_triggered(seed: int, looks: int) -> dict[str, float]:
    """The harm that it foresees on the walk."""
    return off(drive(clock("self_triggered"), WALK, earn, looks, seed).trace, harms())


def bandwidth(seed: int, looks: int) -> dict[str, float]:
    """The cost a cycle of each period on the walk, at a price of a look."""
    made, exact = drive(clock("bandwidth"), WALK, earn, looks, seed), harms()
    made.market.price = PRICE
    wanted = [[-(PRICE + (p - 1 if x in DANGER else sum(exact[x][1:p]))) / p for p in PERIODS] for x in range(BINS)]
    return off([made.values(x) for x in range(BINS)], wanted)


def regulations(seed: int, looks: int) -> dict[str, float]:
    """No values to be compared: the mean reward of a look once it has learned, on the walk."""
    made = drive(clock("regulations"), WALK, earn, looks, seed)
    return {"return": mean_reward(lambda state: greedy(made, state), seed, looks // 4)}


def chance(seed: int, looks: int) -> dict[str, float]:
    """A clock that draws its periods, on the walk."""
    draw = Random(seed)
    return {"return": mean_reward(lambda _: draw.randrange(len(PERIODS)), seed, looks // 4)}


def best(seed: int, looks: int) -> dict[str, float]:
    """Value iteration's clock, on the walk."""
    rows = optimal(WALK, earn, lambda _: 0.9)
    return {"return": mean_reward(lambda state: rows[state % BINS].index(max(rows[state % BINS])), seed, looks // 4)}


def mean_reward(choose: Callable[[int], int], seed: int, looks: int) -> float:
    """The mean reward of a look of a clock that learns nothing (more), on the walk."""
    draw, percept, state, earned = Random(1000 + seed), 0, 0, 0.0
    reached = powers(WALK)
    for _ in range(looks):
        action = choose(state)
        percept = draw.choices(range(BINS), reached[PERIODS[action]][percept])[0]
        earned += earn(PERIODS[action], percept)
        state = action * BINS + percept
    return earned / looks
