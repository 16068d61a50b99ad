"""Which needs the robots of a study have: hunger and thirst, and those that a behaviour of somebody's own brings."""

from __future__ import annotations

from typing import TYPE_CHECKING

from attnlab.measures.once import once_a_study

if TYPE_CHECKING:
    import numpy as np
    import pandas as pd

    from attnlab.results.conditions import Conditions

OF_THE_PAPER = ("hunger", "thirst")
UNIT = "UoE"


@once_a_study
def needs_of(conditions: Conditions) -> list[str]:
    """Needs that have values in ``episodes``, hunger and thirst first; these two if there is none."""
    episodes = conditions.frame("episodes")
    columns = [name for name in episodes.columns if len(episodes) and episodes[name].notna().any()]
    found = [name[:-4] for name in columns if name.endswith("_max") and f"{name[:-4]}_mean" in columns
             and f"{name[:-4]}_min" not in columns]  # energy and safety have a smallest value, a need starts at it
    first = [name for name in OF_THE_PAPER if name in found]
    return first + [name for name in found if name not in OF_THE_PAPER] or list(OF_THE_PAPER)


@once_a_study
def unit_of(conditions: Conditions, need: str) -> str:
    """UoE, unless the Parquet column ``<need>_max`` of ``episodes`` declares another (``unit`` in its metadata)."""
    import pyarrow.parquet as pq
    for run in conditions.configs:
        schema = pq.read_schema(conditions.study.path / run / "episodes.parquet")
        if f"{need}_max" in schema.names:
            declared = (schema.field(f"{need}_max").metadata or {}).get(b"unit", b"")
            return declared.decode() or UNIT
    return UNIT


@once_a_study
def units_of(conditions: Conditions) -> dict[str, str]:
    """Need -> its unit, of all needs of the study."""
    return {need: unit_of(conditions, need) for need in needs_of(conditions)}


def falls(cycles: pd.DataFrame, need: str) -> np.ndarray:
    """Cycles in which a need falls: meals, drinks."""
    import numpy as np
    return np.flatnonzero(np.diff(cycles[need].to_numpy(float)) < -1e-9) + 1
