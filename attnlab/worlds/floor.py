"""A bare floor: where the path of a robot lies that somebody else has driven."""

from __future__ import annotations

from dataclasses import dataclass

from attnlab.registry import register
from attnlab.settings import setting
from attnlab.worlds.base import Layout, World

LONGEST_M = 400.0  # along x or y: maps of the floor have cells of 0.1 m


@register("world", "floor")
class Floor(World):
    """No walls, no boxes. ``simulator=log`` puts the path of its log on such a floor and sets its size. Draws nothing
    at random."""

    @dataclass
    class Params:
        width_m: float = setting(4.0, "floor along x", unit="m", above=0, high=LONGEST_M)
        depth_m: float = setting(4.0, "floor along y", unit="m", above=0, high=LONGEST_M)

    params: Params

    def build(self, seed: int) -> Layout:
        w, d = self.params.width_m, self.params.depth_m
        return Layout(w, d, (), (0.0, w, 0.0, d), 0.0)
