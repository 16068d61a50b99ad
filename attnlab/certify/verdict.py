"""What counts as agreement, written down before the comparison is made.

Closed loops are chaotic: one ray that passes an edge by a hundredth of a millimetre makes another run of it. How far
apart two runs of *one* simulator get is told by other seeds, so distributions of percepts, periods and deaths are
judged by a permutation test over runs, one a world: could the simulators' names be exchanged between the runs? It
fails where that is refused at 0.05 over the four worlds (0.0125 each). Six seeds or more give it any power.
"""

from __future__ import annotations

from typing import Any, NamedTuple


class Tolerance(NamedTuple):
    """A measure that must not exceed ``limit`` in any world."""
    measure: str
    limit: float
    unit: str
    meaning: str


TOLERANCES = (
    Tolerance("sonar_m_max", 0.001, "m", "largest sonar error of rays that graze no edge"),
    Tolerance("rays_grazing_share", 0.02, "", "rays left out of it because they pass an edge within 1 mm"),
    Tolerance("bearing_px_median", 0.5, "px", "median error of a blob's centroid column"),
    Tolerance("height_px_median", 0.5, "px", "median error of a blob's tallest column"),
    Tolerance("blob_miss_share", 0.02, "", "blobs seen by one simulator only"),
    Tolerance("contact_disagreement_share", 0.001, "", "poses at which only one simulator has contact"),
    Tolerance("drive_gap_max_m", 0.001, "m", "largest gap of the paths under the same commands"),
    Tolerance("loops_differ", 1 - 0.05 / 4, "", "1 - p of the permutation test that closed loops differ by simulator"),
    Tolerance("transfer_planar_pybullet_points", 3.0, "points", "change of survival: trained on planar, validated on "
              "pybullet"),
    Tolerance("transfer_pybullet_planar_points", 3.0, "points", "change of survival: trained on pybullet, validated on "
              "planar"),
)


def judge(worlds: dict[str, dict[str, Any]]) -> list[dict[str, Any]]:
    """A row a tolerance: its worst value over the worlds that measured it, where that was, and whether it passes.

    A measure that no world has is left out (closed loops may be switched off); the transfer measures pass or fail on
    their absolute value.
    """
    rows = []
    for tolerance in TOLERANCES:
        values = {world: abs(measures[tolerance.measure]) for world, measures in worlds.items()
                  if tolerance.measure in measures}
        if values:
            where = max(values, key=lambda name: values[name])
            rows.append({**tolerance._asdict(), "worst": values[where], "world": where,
                         "passes": values[where] <= tolerance.limit})
    return rows
