"""Read a study back: ``load("outputs/cr_vs_ncr").episodes`` is a pandas frame over all complete runs."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from attnlab.errors import ConfigError, nearest
from attnlab.tables.files import read_json
from attnlab.tables.schema import SCHEMA_VERSION, TABLES

if TYPE_CHECKING:
    import pandas as pd
    import pyarrow as pa


def load(study: str | Path) -> Study:
    """The study in this folder (or of this name in outputs/). Raises ConfigError if there is none."""
    path = Path(study)
    if not path.is_dir() and (Path("outputs") / path).is_dir():
        path = Path("outputs") / path
    if not path.is_dir():
        known = sorted(p.name for p in Path("outputs").glob("*") if p.is_dir())
        raise ConfigError(str(study), "there is no such study", nearest(path.name, known) if known else
                          "Run one first: python -m attnlab +experiment=smoke")
    return Study(path)


def state_of(folder: Path) -> tuple[str, str, dict]:
    """(status, why, run.json) of a run folder. ``damaged``: it says complete, but a table is missing or broken."""
    about = read_json(folder / "run.json")
    if about is None:
        missing = "no run.json" if not (folder / "run.json").exists() else "run.json is not readable"
        return "incomplete", f"{missing}; the run was interrupted or is not one", {}
    status = str(about.get("status"))
    if status == "complete":
        if about.get("schema") != SCHEMA_VERSION:
            return "damaged", (f"tables of schema {about.get('schema')}, this version reads schema {SCHEMA_VERSION}; "
                               "run it again with fresh=true"), about
        for table in TABLES:
            problem = _check_parquet(folder / f"{table}.parquet")
            if problem:
                return "damaged", problem, about
    error = (about.get("error") or "").strip().splitlines()
    return status, error[-1] if error else "", about


def _check_parquet(path: Path) -> str:
    """Empty if the file has a Parquet head and tail, else what is wrong. Cheap: reads 8 bytes."""
    try:
        with open(path, "rb") as file:
            head = file.read(4)
            file.seek(-4, 2)
            tail = file.read(4)
    except OSError:
        return f"{path.name} is missing or cut off"
    return "" if head == tail == b"PAR1" else f"{path.name} is cut off or no Parquet file"


class Study:
    """The results of a study. Frames hold the rows of all complete runs; ``runs`` has a row for every run folder."""

    def __init__(self, path: Path):
        self.path = path
        self._states = {folder.name: state_of(folder) for folder in sorted(path.iterdir())
                        if folder.is_dir() and _looks_like_run(folder)}
        self._broken: dict[str, str] = {}
        self._configs: dict[str, dict | None] = {}
        self._plain: dict[str, pd.DataFrame] = {}

    def __repr__(self) -> str:
        return (f"Study('{self.path}'): {len(self.complete)} complete runs of {len(self._states)}; frames: "
                f"{', '.join(TABLES)}, runs")

    @cached_property
    def runs(self) -> pd.DataFrame:
        """One row a run: run, status, why, seed, curiosity, key, wall_s, cycles, error and the swept settings."""
        import pandas as pd
        rows = []
        for name, (status, why, about) in self._states.items():
            if name in self._broken:
                status, why = "damaged", self._broken[name]
            rows.append({"run": name, "status": status, "why": why, "seed": about.get("seed"),
                         "curiosity": about.get("curiosity"), "key": about.get("key"), "wall_s": about.get("wall_s"),
                         "cpu_s": about.get("cpu_s"), "cycles": about.get("cycles"), "error": about.get("error"),
                         "overrides": about.get("overrides"), **about.get("swept", {})})
        columns = ["run", "status", "why", "seed", "curiosity", "key", "wall_s", "cpu_s", "cycles", "error",
                   "overrides"]
        return pd.DataFrame(rows, columns=columns if not rows else None)

    @cached_property
    def swept(self) -> list[str]:
        """Names of the settings that differ on purpose between runs (but for seed and curiosity)."""
        names = {name for _, _, about in self._states.values() for name in about.get("swept", {})}
        return sorted(names)

    @property
    def complete(self) -> list[str]:
        """Names of the complete runs."""
        return [name for name, (status, _, _) in self._states.items()
                if status == "complete" and name not in self._broken]

    def about(self, run: str) -> dict:
        """run.json of a run; empty if it has none."""
        return self._states[run][2]

    def config(self, run: str) -> dict | None:
        """The resolved config of a run; None if it is missing or unreadable."""
        if run not in self._configs:
            import yaml
            try:
                text = (self.path / run / "config.yaml").read_text()
                content = yaml.load(text, getattr(yaml, "CSafeLoader", yaml.SafeLoader))
            except (OSError, ValueError, yaml.YAMLError):
                content = None
            self._configs[run] = content if isinstance(content, dict) else None
        return self._configs[run]

    def plain(self, table: str) -> pd.DataFrame:
        """A table without the columns of swept settings, and of ``cycles`` only each run's last recorded episode: what
        the report reads, small however much was swept or recorded."""
        if table not in self._plain:
            swept = set(self.swept)

            def cut(found: pa.Table) -> pa.Table:
                found = found.drop_columns([name for name in found.column_names if name in swept])
                found = _last_episode(found) if table == "cycles" else found
                for place, name in enumerate(found.column_names):
                    if name in ("run", "phase"):
                        found = found.set_column(place, name, found.column(name).dictionary_encode())
                return found
            self._plain[table] = self._table(table, cut)
        return self._plain[table]

    def _table(self, table: str, cut: Callable[[pa.Table], pa.Table] | None = None) -> pd.DataFrame:
        """Rows of all complete runs, of each what ``cut`` leaves. Arrow tables are joined before pandas sees them."""
        import pandas as pd
        import pyarrow as pa
        import pyarrow.parquet as pq
        tables = []
        for name in self.complete:
            try:
                found = pq.read_table(self.path / name / f"{table}.parquet", partitioning=None)
            except Exception as cause:  # noqa: BLE001  whatever the reader makes of a damaged file, the others go on
                self._broken[name] = f"{table}.parquet: {cause}"
                self.__dict__.pop("runs", None)
                continue
            found = found if cut is None else cut(found)
            if cut is None and "episode" in found.column_names and table != "cycles":
                for setting in self.swept:
                    if setting not in found.column_names:
                        value = pa.array([self._setting(name, setting)] * len(found))
                        found = found.append_column(setting, value)
            tables.append(found)
        tables = [found for found in tables if len(found)] or tables[:1]
        return _join(tables) if tables else pd.DataFrame()

    def _setting(self, run: str, setting: str):
        """A setting of a run that was not swept when it ran, from its config."""
        node = self.config(run)
        for part in setting.split("."):
            node = node.get(part) if isinstance(node, dict) else None
        return node.get("name") if isinstance(node, dict) else node

    @cached_property
    def episodes(self) -> pd.DataFrame:
        return self._table("episodes")

    @cached_property
    def behaviours(self) -> pd.DataFrame:
        return self._table("behaviours")

    @cached_property
    def policy(self) -> pd.DataFrame:
        return self._table("policy")

    @cached_property
    def cycles(self) -> pd.DataFrame:
        return self._table("cycles")

    @cached_property
    def coverage(self) -> pd.DataFrame:
        return self._table("coverage")


def _last_episode(cycles: pa.Table) -> pa.Table:
    """The rows at the end that belong to the last row's phase and episode."""
    import numpy as np
    if not len(cycles):
        return cycles
    episode, phase = (cycles.column(name).to_numpy() for name in ("episode", "phase"))
    others = np.flatnonzero((episode != episode[-1]) | (phase != phase[-1]))
    return cycles.slice(others[-1] + 1 if others.size else 0)


def _join(tables: list[pa.Table]) -> pd.DataFrame:
    """One frame of all rows; a column that a run lacks is empty there, and one of mixed types becomes text."""
    import pyarrow as pa
    try:
        return pa.concat_tables(tables, promote_options="permissive").to_pandas()
    except (pa.ArrowInvalid, pa.ArrowTypeError):
        import pandas as pd
        return pd.concat([found.to_pandas() for found in tables], ignore_index=True)


def _looks_like_run(folder: Path) -> bool:
    return any((folder / name).exists() for name in ("run.json", "config.yaml", *(f"{t}.parquet" for t in TABLES)))
