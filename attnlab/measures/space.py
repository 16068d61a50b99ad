"""Where the robot has been."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from attnlab.measures.base import PHASES, CannotMeasure, Measure
from attnlab.registry import register
from attnlab.settings import setting

if TYPE_CHECKING:
    import numpy as np


def visit_maps(runs, phase: str) -> dict[int, np.ndarray]:
    """Visits of the robot's centre by seed, arrays of shape (cells along x, cells along y) over the whole floor."""
    import numpy as np

    from attnlab.tables.schema import CELL_M
    rows = runs.rows("coverage", phase=phase)
    if not len(rows):
        raise CannotMeasure(f"no {phase} episodes left a coverage map")
    found = {}
    for seed, group in rows.groupby("seed"):
        layout = runs.conditions.layout(runs.runs[int(seed)])
        if layout is None:
            raise CannotMeasure("the world of these runs cannot be built here, so its floor is not known")
        visits = np.zeros([int(np.ceil(size / CELL_M - 1e-9)) for size in (layout.width_m, layout.depth_m)])
        visits[group["x_cell"], group["y_cell"]] = group["visits"]
        found[int(seed)] = visits
    return found


@dataclass
class _Phase:
    phase: str = setting("train", "which episodes", choices=PHASES)


@register("measure", "coverage")
class Coverage(Measure):
    """Share of the floor (%) that the robot's centre visited in a phase, or with ``footprint`` its round body."""
    unit = "%"

    @dataclass
    class Params:
        phase: str = setting("train", "which episodes", choices=PHASES)
        footprint: bool = setting(False, "count what the body touched, not the cells of its centre")

    def of(self, runs):
        from attnlab.simulators.robot import RADIUS_M
        from attnlab.stats import footprint_cells
        from attnlab.tables.schema import CELL_M
        maps = visit_maps(runs, self.params.phase)
        if self.params.footprint:
            return {seed: 100 * float(footprint_cells(v, RADIUS_M, CELL_M).mean()) for seed, v in maps.items()}
        return {seed: 100 * float((v > 0).mean()) for seed, v in maps.items()}


@register("measure", "visit_entropy")
class VisitEntropy(Measure):
    """Shannon entropy of the visit map in bits: larger is more even (log2 of 1600 cells is 10.6)."""
    unit = "bit"
    Params = _Phase

    def of(self, runs):
        from attnlab.stats import entropy_bits
        return {seed: entropy_bits(visits) for seed, visits in visit_maps(runs, self.params.phase).items()}


@register("measure", "visit_gini")
class VisitGini(Measure):
    """Gini coefficient of the visits over all cells of the floor: smaller is more even."""
    Params = _Phase

    def of(self, runs):
        from attnlab.stats import gini
        return {seed: gini(visits) for seed, visits in visit_maps(runs, self.params.phase).items()}


@register("measure", "curvature")
class Curvature(Measure):
    """Mean change of direction along the path of the last recorded episode (rad/m): smaller is smoother."""
    unit = "rad/m"

    def of(self, runs):
        from attnlab.stats import curvature
        return {seed: curvature(rows["x_m"].to_numpy(float), rows["y_m"].to_numpy(float))
                for seed, rows in self.last_cycles(runs).items()}
