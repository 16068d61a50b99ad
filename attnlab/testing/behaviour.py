"""Checks of a behaviour."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from random import Random
from typing import Any, TypeVar

from attnlab.behaviours.base import Behaviour, Command, RobotSenses, Senses
from attnlab.needs.base import Body, Need
from attnlab.simulators.base import Simulator
from attnlab.testing.build import layout, make

Seen = TypeVar("Seen")


class Scenes:
    """A behaviour in the paper's world, at poses and in states of the body drawn from a seed."""

    def __init__(self, name: str, settings: dict[str, Any]):
        self.behaviour: Behaviour = make("behaviours", name, **settings)
        self.simulator: Simulator = make("simulator", (self.behaviour.simulators or ("planar",))[0])
        self.body: Body = make("needs", "survival").body(self.behaviour.needs())
        self.now = RobotSenses(self.simulator, self.body)
        self.layout = layout()

    def __iter__(self) -> Iterator[Senses]:
        draw = Random(11)
        self.behaviour.start()
        self.now.start()
        for cycle in range(0, 600, 3):
            x, y, heading = self.layout.random_start(draw)
            self.simulator.place(x, y, heading)
            self.simulator.cycle = self.now.cycle = cycle
            self.body.values[:] = [draw.uniform(0.0, need.death_at or 1500.0) for need in self.body.needs]
            yield self.now

    def close(self) -> None:
        self.simulator.close()


def scenes(name: str, settings: dict[str, Any], visit: Callable[[Behaviour, Senses], Seen]) -> list[Seen]:
    """What ``visit(behaviour, now)`` returns in each scene."""
    world = Scenes(name, settings)
    try:
        return [visit(world.behaviour, now) for now in world]
    finally:
        world.close()


def percepts_in_range(name: str, **settings: Any) -> None:
    """sigma is within [sigma_low, sigma_high]."""
    def visit(behaviour: Behaviour, now: Senses) -> None:
        sigma = behaviour.percept(now)
        low, high = behaviour.sigma_low, behaviour.sigma_high
        assert low < high, f"{name}: sigma_low {low} is not below sigma_high {high}"
        assert low <= sigma <= high, f"{name}: percept {sigma} is outside [{low}, {high}]"
    scenes(name, settings, visit)


def pure_reads(name: str, **settings: Any) -> None:
    """percept, released and reward answer the same when asked twice, and leave the body alone."""
    def visit(behaviour: Behaviour, now: Senses) -> None:
        before = list(now.body.values), now.body.energy, list(now.body.meals)
        sigma = behaviour.percept(now)
        asked = [(behaviour.percept(now), behaviour.released(now, sigma), behaviour.reward(sigma, 0.3))
                 for _ in range(2)]
        assert asked[0] == asked[1], f"{name}: asked twice, it answered {asked[0]}, then {asked[1]}"
        assert before == (now.body.values, now.body.energy, now.body.meals), f"{name}: a read changed the body"
    scenes(name, settings, visit)


def rewards_in_range(name: str, **settings: Any) -> None:
    """The extrinsic reward is within [0, 1]."""
    behaviour: Behaviour = make("behaviours", name, **settings)
    low, high = behaviour.sigma_low, behaviour.sigma_high
    for i in range(11):
        for period in (0.0, 0.27, 0.64, 1.0):
            reward = behaviour.reward(low + (high - low) * i / 10, period)
            assert 0.0 <= reward <= 1.0, f"{name}: reward {reward} is outside [0, 1]"


def commands_finite(name: str, **settings: Any) -> None:
    """A command is None or (v, w), two finite numbers."""
    def visit(behaviour: Behaviour, now: Senses) -> None:
        sigma = behaviour.percept(now)
        if behaviour.released(now, sigma):
            said = behaviour.command(now, sigma)
            assert said is None or (len(said) == 2 and all(map(math.isfinite, said))), f"{name}: {said}"
    scenes(name, settings, visit)


def forgets(name: str, **settings: Any) -> None:
    """``start`` forgets the last episode: two episodes of a behaviour that draws nothing are the same."""
    def act(behaviour: Behaviour, now: Senses) -> tuple[float, bool, Command | None]:
        sigma = behaviour.percept(now)
        released = behaviour.released(now, sigma)
        return sigma, released, behaviour.command(now, sigma) if released else None
    world = Scenes(name, settings)
    try:
        state = world.behaviour.draw.getstate()
        first = [act(world.behaviour, now) for now in world]
        if world.behaviour.draw.getstate() != state:
            world.behaviour.draw.setstate(state)
        world.body.start()
        second = [act(world.behaviour, now) for now in world]
        assert first == second, f"{name}: the second episode differs; forget what was held in start()"
    finally:
        world.close()


def charged(name: str, **settings: Any) -> None:
    """It answers for a crash, for energy, or for needs that exist."""
    behaviour: Behaviour = make("behaviours", name, **settings)
    own = behaviour.needs()
    assert all(isinstance(need, Need) for need in own)
    known = {"crash", "energy", *(need.name for need in make("needs", "survival").body(own).needs)}
    assert set(behaviour.charges) <= known, f"{name}: nobody dies of {set(behaviour.charges) - known}"


CHECKS = (percepts_in_range, pure_reads, rewards_in_range, commands_finite, forgets, charged)
