"""Arrow tables on their way to pandas."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pandas as pd
    import pyarrow as pa


def marked(frame: pd.DataFrame, rows: list[int], first: dict[str, list[Any]], last: dict[str, list[Any]]
           ) -> pd.DataFrame:
    """The frame with columns before and after its own that have one value a run; ``rows``: how many each run has. Texts
    are stored once."""
    import numpy as np
    import pandas as pd
    of_run = np.repeat(np.arange(len(rows)), rows)

    def spread(values: list[Any]) -> pd.Series[Any]:
        texts = all(value is None or isinstance(value, str) for value in values)
        found = pd.Series(pd.Categorical(values, list(dict.fromkeys(v for v in values if v is not None))) if texts
                          else values)
        return found.take(of_run).reset_index(drop=True)
    return pd.concat([pd.DataFrame({name: spread(values) for name, values in first.items()}), frame,
                      pd.DataFrame({name: spread(values) for name, values in last.items()}, index=frame.index)], axis=1)


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


CORE = {"episodes": ("run", "phase", "episode", "cycles", "survival", "death"),
        "behaviours": ("run", "phase", "episode", "behaviour", "activations", "reward"),
        "policy": ("run", "behaviour", "period", "percept", "action", "q"),
        "cycles": ("run", "phase", "episode", "cycle"), "coverage": ("run", "phase", "visits")}


def check_table(found: pa.Table, table: str, run: str) -> None:
    """Raise ValueError unless this is the run's table, with what every version of it has and numbers that can be."""
    import pyarrow.compute as pc
    lacking = [name for name in CORE[table] if name not in found.column_names]
    if lacking:
        raise ValueError(f"has no column {', '.join(lacking)}")
    if not len(found):
        return
    owners = pc.unique(found.column("run")).to_pylist()
    if owners != [run]:
        raise ValueError(f"is the table of {', '.join(map(str, owners[:3]))}")
    if table == "episodes":
        survival = found.column("survival")
        fine = pc.and_(pc.greater_equal(survival, 0.0), pc.less_equal(survival, 1.0))
        if survival.null_count or not pc.all(fine).as_py():
            raise ValueError("says that something survived that cannot be (survival is a share, 0 to 1)")
