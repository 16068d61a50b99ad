"""Checks of needs and of a fusion."""

from __future__ import annotations

from random import Random
from typing import Any

from attnlab.needs.base import Need
from attnlab.testing.build import make, reading


def strides_like_steps(name: str, **settings: Any) -> None:
    """Many cycles at once change the body as one by one do, and ``until_death`` foretells the cycle of death."""
    more = [Need("fatigue", 300.0, 0.5, 0.5, 900.0)]
    for how in ({}, {"energy_death": True, "energy_min": 4000.0}):
        stride = make("needs", name, how=how, **settings).body(more)
        step = make("needs", name, how=how, **settings).body(more)
        draw, cause = Random(4), None
        while cause is None and stride.energy > -1e4:
            active, cycles = draw.randint(1, 3), draw.randint(1, 12)
            if draw.random() < 0.05:
                for body in (stride, step):
                    body.consume(body.needs[0].name, 100.0)
            cycles = stride.until_death(active, cycles)
            cause = stride.live(active, cycles)
            stepped = [step.live(active if i == 0 else 0, 1) for i in range(cycles)]
            assert stepped[:-1] == [None] * (cycles - 1), f"{name}: died earlier step by step than until_death says"
            assert stepped[-1] == cause
            pairs = zip([*stride.values, stride.energy], [*step.values, step.energy], strict=True)
            assert all(abs(a - b) < 1e-6 for a, b in pairs), f"{name}: {stride.values} at once, {step.values} in steps"


def starts_anew(name: str, **settings: Any) -> None:
    """``start`` gives the body of a new episode."""
    body = make("needs", name, **settings).body([])
    first = list(body.values), body.energy
    body.live(3, 50)
    assert (list(body.values), body.energy) != first, f"{name}: 50 cycles changed nothing"
    body.start()
    assert (list(body.values), body.energy) == first


NEEDS = (strides_like_steps, starts_anew)


def within_limits(name: str, **settings: Any) -> None:
    """The fused command is within the robot's limits, whatever is held, and the held ones stay as they are."""
    r, fusion, draw = reading(), make("fusion", name, **settings), Random(9)
    for n in (0, 1, 2, 3, 5):
        for _ in range(50):
            held = [(draw.uniform(-1, 2), draw.uniform(-5, 5)) for _ in range(n)]
            before = list(held)
            v, w = fusion.fuse(held)
            assert 0.0 <= v <= r.v_max_m_s and -r.w_max_rad_s <= w <= r.w_max_rad_s, f"{name}: {held} became {(v, w)}"
            assert held == before and fusion.fuse(held) == (v, w), f"{name}: fuse is not pure"


FUSION = (within_limits,)
