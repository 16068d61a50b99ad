"""A world laid out from the seed, always solvable."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from random import Random

from attnlab.errors import ConfigError
from attnlab.registry import register
from attnlab.settings import setting
from attnlab.streams import stream
from attnlab.worlds.base import Layout, World, check_start, outer_walls
from attnlab.worlds.geometry import Solid, clearance, distance
from attnlab.worlds.layout import SourceParams, StartParams, start_region

CELL_M = 0.1  # grid of the search for a way; finer than the passage it asks for
PASSAGE_M = 0.4  # centre to solid: the footprint of 0.25 m and room to steer
ARRIVAL_M = 0.6  # centre to source: inside the default reach of a meal


@register("world", "random")
class RandomLayout(World):
    """Cubes at random places (stream ``world``, from the seed alone), drawn again until every free start region cell
    is connected to every source by a passage wide enough for the robot."""

    @dataclass
    class Params:
        width_m: float = setting(4.0, "floor along x", unit="m", above=1, high=100)
        depth_m: float = setting(4.0, "floor along y", unit="m", above=1, high=100)
        obstacles: int = setting(2, "black cubes", low=0, high=500)
        food: int = setting(1, "green cubes", low=1, high=100)
        water: int = setting(1, "blue cubes", low=1, high=100)
        size_m: float = setting(0.5, "edge of a cube", unit="m", above=0, high=2)
        start: StartParams = setting(StartParams(), "where the robot may start")
        sources: SourceParams = setting(SourceParams(), "how much food and water there is")
        tries: int = setting(200, "layouts tried before giving up", low=1, high=100_000)

    params: Params

    def build(self, seed: int) -> Layout:
        """The layout of this seed; ConfigError if none of ``tries`` is solvable."""
        p = self.params
        draw = stream(seed, "world")
        kinds = ["food"] * p.food + ["water"] * p.water + ["obstacle"] * p.obstacles
        region = start_region(p.start, p.width_m, p.depth_m)
        for _ in range(p.tries):
            boxes = self._scatter(kinds, draw)
            if boxes is None:
                continue
            layout = Layout(p.width_m, p.depth_m, (*outer_walls(p.width_m, p.depth_m), *boxes), **region)
            if solvable(layout):
                return check_start(layout)
        raise ConfigError("obstacles", f"no solvable layout of {len(kinds)} cubes in {p.width_m} x {p.depth_m} m after "
                          f"{p.tries} tries (seed {seed})", "Ask for fewer, or a larger floor")

    def _scatter(self, kinds: list[str], draw: Random) -> list[Solid] | None:
        """Cubes that do not overlap, or None if one found no place in 50 tries."""
        p = self.params
        boxes: list[Solid] = []
        for kind in kinds:
            for _ in range(50):
                x = draw.uniform(p.size_m / 2, p.width_m - p.size_m / 2)
                y = draw.uniform(p.size_m / 2, p.depth_m - p.size_m / 2)
                if not any(abs(x - b.x_m) < p.size_m and abs(y - b.y_m) < p.size_m for b in boxes):
                    boxes.append(Solid(kind, x, y, p.size_m, p.size_m))
                    break
            else:
                return None
        return boxes


def solvable(layout: Layout) -> bool:
    """Can the robot get from any free start to within reach of every source? (Flood fill over a 0.1 m grid.)"""
    nx, ny = int(layout.width_m / CELL_M), int(layout.depth_m / CELL_M)

    def centre(cell: tuple[int, int]) -> tuple[float, float]:
        return (cell[0] + 0.5) * CELL_M, (cell[1] + 0.5) * CELL_M

    free = {(i, j) for i in range(nx) for j in range(ny)
            if clearance(*centre((i, j)), layout.solids) >= PASSAGE_M}
    x_min, x_max, y_min, y_max = layout.start
    starts = {cell for cell in free if x_min <= centre(cell)[0] <= x_max and y_min <= centre(cell)[1] <= y_max
              and clearance(*centre(cell), layout.solids) >= layout.start_clearance_m}
    if not starts:
        return False
    seen: set[tuple[int, int]] = set()
    queue = deque([min(starts)])
    while queue:
        cell = queue.popleft()
        if cell in seen:
            continue
        seen.add(cell)
        i, j = cell
        queue.extend(n for n in ((i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)) if n in free and n not in seen)
    if not starts <= seen:
        return False
    return all(any(distance(*centre(cell), solid) <= ARRIVAL_M for cell in seen)
               for solid in layout.solids if solid.kind in ("food", "water"))
