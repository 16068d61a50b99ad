"""Arrow tables on their way to pandas."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pandas as pd
    import pyarrow as pa


def repeated(value: Any, rows: int) -> pa.Array:
    """A column of one value, stored once."""
    import pyarrow as pa
    if isinstance(value, str):
        return pa.DictionaryArray.from_arrays(pa.array([0] * rows, pa.int32()), [value])
    return pa.array([value] * rows)


def last_episode(cycles: pa.Table) -> pa.Table:
    """The rows at the end that belong to the last row's phase and episode."""
    import numpy as np
    if not len(cycles):
        return cycles
    episode, phase = (cycles.column(name).to_numpy() for name in ("episode", "phase"))
    others = np.flatnonzero((episode != episode[-1]) | (phase != phase[-1]))
    return cycles.slice(others[-1] + 1 if others.size else 0)


def join(tables: list[pa.Table]) -> pd.DataFrame:
    """One frame of all rows; a column that a run lacks is empty there, and one of mixed types becomes text."""
    import pyarrow as pa
    frame: pd.DataFrame
    try:
        frame = pa.concat_tables(tables, promote_options="permissive").to_pandas()
    except (pa.ArrowInvalid, pa.ArrowTypeError):
        import pandas as pd
        frame = pd.concat([found.to_pandas() for found in tables], ignore_index=True)
    return frame
