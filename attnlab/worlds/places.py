"""The paper's arena with its cubes at other places, as readings of where they stood."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from attnlab.registry import register
from attnlab.settings import setting
from attnlab.worlds.base import Layout, World
from attnlab.worlds.layout import BoxParams, WrittenLayout
from attnlab.worlds.random import RandomLayout

OBSTACLES = {"paper": ((1.2, 2.8), (2.8, 1.2)), "apart": ((0.25, 3.75), (3.75, 0.25))}  # centres (m)
SOURCES = {"food": ((0.25, 1.0), (2.4, 3.75)), "water": ((3.75, 3.0), (1.6, 0.25))}


@register("world", "places")
class Places(World):
    """16 m2 with two obstacles and one or two sources of each kind, cubes of 0.5 m.

    ``paper`` is Fig 3 (world=paper); ``apart`` has the obstacles in the two corners that are free, out of the way;
    ``random`` has all cubes at random places, as world=random has them (stream ``world``, from the seed alone). The
    second food and water stand at the walls that have none, point-symmetric like the first; a robot can pass between
    any two cubes.
    """

    @dataclass
    class Params:
        layout: Literal["paper", "apart", "random"] = setting("paper", "where the cubes stand")
        of_each: int = setting(1, "sources of each kind", low=1, high=2)

    params: Params

    def build(self, seed: int) -> Layout:
        """The checked layout of this seed."""
        p = self.params
        if p.layout == "random":
            return RandomLayout(RandomLayout.Params(food=p.of_each, water=p.of_each)).build(seed)
        boxes = [BoxParams("obstacle", x, y) for x, y in OBSTACLES[p.layout]]
        boxes += [BoxParams(kind, x, y) for kind, places in SOURCES.items() for x, y in places[:p.of_each]]
        return WrittenLayout(WrittenLayout.Params(boxes=boxes)).build(seed)
