"""Where the robot has been."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from attnlab.errors import ConfigError
from attnlab.measures.base import CannotMeasure, Measure, Phase
from attnlab.measures.frames import of_seeds, phase_rows, split
from attnlab.measures.once import once_a_study
from attnlab.registry import register
from attnlab.settings import setting

if TYPE_CHECKING:
    import numpy as np
    import pandas as pd

    from attnlab.results.conditions import Conditions, Runs


def visit_maps(runs: Runs, phase: str) -> dict[int, np.ndarray]:
    """Visits of the robot's centre by seed, arrays of shape (cells along x, cells along y) over the whole floor."""
    there = of_seeds(runs, _visited(runs.conditions, phase))
    if not there:
        raise CannotMeasure(f"no {phase} episodes left a coverage map")
    found: dict[int, np.ndarray] = {}
    for seed in there:
        visits = _map(runs.conditions, phase, runs.runs[seed])
        if visits is None:
            raise CannotMeasure("the world of these runs cannot be built here, so its floor is not known")
        found[seed] = visits
    return found


@once_a_study
def _visited(conditions: Conditions, phase: str) -> dict[str, pd.DataFrame]:
    """Run -> cells that its robot visited."""
    return split(phase_rows(conditions, "coverage", phase))


@once_a_study
def _map(conditions: Conditions, phase: str, run: str) -> np.ndarray | None:
    """Visits of a run; None if its world cannot be built here."""
    import numpy as np

    from attnlab.tables.schema import CELL_M
    layout = conditions.layout(run)
    if layout is None:
        return None
    cells = _visited(conditions, phase)[run]
    visits = np.zeros([int(np.ceil(size / CELL_M - 1e-9)) for size in (layout.width_m, layout.depth_m)])
    visits[cells["x_cell"].to_numpy(), cells["y_cell"].to_numpy()] = cells["visits"].to_numpy()
    return visits


@dataclass
class _Phase:
    phase: Phase = setting("train", "which episodes")


@register("measure", "coverage")
class Coverage(Measure):
    """Share (%) of the floor that the robot's centre visited in a phase, or with ``footprint`` its round body; of the
    whole ``floor``, or of the cells that the centre of a robot can reach."""
    unit = "%"
    bounds = (0.0, 100.0)

    @dataclass
    class Params:
        phase: Phase = setting("train", "which episodes")
        footprint: bool = setting(False, "count what the body touched, not the cells of its centre")
        of: Literal["floor", "reachable"] = setting("floor", "share of what")

        def __post_init__(self) -> None:
            if self.footprint and self.of == "reachable":
                raise ConfigError("footprint", "a body touches more than its centre can reach", "Use of: floor")

    def of(self, runs: Runs) -> dict[int, float]:
        from attnlab.simulators.robot import RADIUS_M
        from attnlab.stats import footprint_cells
        from attnlab.tables.schema import CELL_M
        maps = visit_maps(runs, self.params.phase)
        if self.params.footprint:
            return {seed: 100 * float(footprint_cells(v, RADIUS_M, CELL_M).mean()) for seed, v in maps.items()}
        if self.params.of == "floor":
            return {seed: 100 * float((v > 0).mean()) for seed, v in maps.items()}
        found = {}
        for seed, visits in maps.items():
            free = _reachable(runs.conditions, runs.runs[seed], self.params.phase)
            found[seed] = 100 * float((visits[free] > 0).mean())
        return found


@once_a_study
def _reachable(conditions: Conditions, run: str, phase: str) -> np.ndarray:
    """Cells of a run's floor in which a robot's centre can be without touching anything, and gets to from the largest
    such room; a cell visited counts too (its middle may be too near where its edge is not)."""
    import numpy as np
    from scipy.ndimage import label

    from attnlab.simulators.robot import RADIUS_M
    from attnlab.tables.schema import CELL_M
    from attnlab.worlds.geometry import clearances
    layout = conditions.layout(run)
    assert layout is not None  # visit_maps has built it
    visits = _map(conditions, phase, run)
    shape = [int(np.ceil(size / CELL_M - 1e-9)) for size in (layout.width_m, layout.depth_m)]
    x, y = np.meshgrid(*[(np.arange(n) + 0.5) * CELL_M for n in shape], indexing="ij")
    free = clearances(np.stack([x.ravel(), y.ravel()], axis=1), layout.solids).reshape(shape) > RADIUS_M + 1e-9
    rooms, count = label(free)
    largest = rooms == 1 + int(np.argmax([(rooms == i + 1).sum() for i in range(count)])) if count else free
    assert visits is not None
    return largest | (visits > 0)


@register("measure", "visit_entropy")
class VisitEntropy(Measure):
    """Shannon entropy of the visit map in bits: larger is more even (log2 of 1600 cells is 10.6)."""
    unit = "bit"
    Params = _Phase

    def of(self, runs: Runs) -> dict[int, float]:
        from attnlab.stats import entropy_bits
        return {seed: entropy_bits(visits) for seed, visits in visit_maps(runs, self.params.phase).items()}


@register("measure", "visit_gini")
class VisitGini(Measure):
    """Gini coefficient of the visits over all cells of the floor: smaller is more even."""
    Params = _Phase

    def of(self, runs: Runs) -> dict[int, float]:
        from attnlab.stats import gini
        return {seed: gini(visits) for seed, visits in visit_maps(runs, self.params.phase).items()}


@register("measure", "curvature")
class Curvature(Measure):
    """Turning a metre of path (rad/m), mean over episodes: smaller is smoother. An episode without a path has none."""
    unit = "rad/m"

    @dataclass
    class Params:
        phase: Phase = setting("validation", "which episodes")

    def of(self, runs: Runs) -> dict[int, float]:
        rows = self.episodes(runs, self.params.phase)
        bends = rows["turn_rad"] / rows["path_m"].where(rows["path_m"] > 0)
        return self.means(rows.assign(bends=bends), "bends")
