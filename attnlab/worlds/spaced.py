"""The paper's arena with its sources further apart or nearer, and more or fewer obstacles."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

from attnlab.errors import ConfigError
from attnlab.registry import register
from attnlab.settings import setting
from attnlab.worlds.base import Layout, World, check_start, outer_walls
from attnlab.worlds.geometry import Solid
from attnlab.worlds.layout import SourceParams, StartParams, start_region
from attnlab.worlds.random import solvable

EDGE_M, CUBE_M = 4.0, 0.5
FOOD_M = (0.25, 1.0)  # against the west wall, as in the paper's Fig 3
WALL_M = EDGE_M - CUBE_M / 2  # centre of a cube that stands against the north or the east wall
OBSTACLES_M = ((1.2, 2.8), (2.8, 1.2), (2.8, 2.8), (1.2, 1.2))  # the first two are the paper's


@register("world", "spaced")
class Spaced(World):
    """The paper's arena of 16 m2 with two things that can be set; by default it is the paper's world.

    Food stands where the paper has it. Water stands ``source_distance_m`` from it (centre to centre, to a centimetre):
    at the west wall up to 2.75 m, at the north wall up to 3.5 m, at the east wall beyond. Of the cubes at
    (1.2, 2.8), (2.8, 1.2), (2.8, 2.8) and (1.2, 1.2) m the first ``obstacles`` are there; between each two, and to
    every wall, there is room to pass. Draws nothing at random; the seed changes nothing.
    """

    @dataclass
    class Params:
        source_distance_m: float = setting(4.03, "from food to water", unit="m", low=0.7, high=4.45)
        obstacles: int = setting(2, "black cubes", low=0, high=len(OBSTACLES_M))
        start: StartParams = setting(StartParams(), "where the robot may start")
        sources: SourceParams = setting(SourceParams(), "how much food and water there is")

    params: Params

    def build(self, seed: int) -> Layout:
        """The layout; ConfigError if somewhere a robot would be shut out."""
        p = self.params
        boxes = [Solid("obstacle", x, y, CUBE_M, CUBE_M) for x, y in OBSTACLES_M[:p.obstacles]]
        boxes += [Solid(kind, x, y, CUBE_M, CUBE_M) for kind, (x, y) in
                  (("food", FOOD_M), ("water", water_m(p.source_distance_m)))]
        layout = Layout(EDGE_M, EDGE_M, (*outer_walls(EDGE_M, EDGE_M), *boxes), **start_region(p.start, EDGE_M, EDGE_M))
        if not solvable(layout):
            raise ConfigError("obstacles", f"with {p.obstacles} of them and water {p.source_distance_m} m from food, "
                              "some start is shut off from a source", "Ask for fewer, or another distance")
        return check_start(layout)


def water_m(distance_m: float) -> tuple[float, float]:
    """Centre of the water (m) at this distance from the food, along the walls west, north and east; to a centimetre."""
    x, y = FOOD_M
    if distance_m <= WALL_M - y:
        return x, round(y + distance_m, 2)
    if distance_m < WALL_M - x:
        return round(x + sqrt(distance_m ** 2 - (WALL_M - y) ** 2), 2), WALL_M
    return WALL_M, round(y + sqrt(distance_m ** 2 - (WALL_M - x) ** 2), 2)
