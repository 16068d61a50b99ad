"""Read a study back: ``load("outputs/cr_vs_ncr").episodes`` is a pandas frame over all complete runs."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

from attnlab.errors import ConfigError, nearest
from attnlab.results.arrow import check_table, join, last_episode, marked
from attnlab.results.old import recovered, upgraded
from attnlab.results.states import looks_like_run, states_in
from attnlab.tables.files import mark_of
from attnlab.tables.schema import TABLES
from attnlab.tables.study import FILE, Condition, read_study

if TYPE_CHECKING:
    import pandas as pd
    import pyarrow as pa

RUNS = ["study", "run", "condition", "status", "why", "seed", "curiosity", "key", "wall_s", "cpu_s", "cycles", "error",
        "overrides"]


@overload
def load(study: Study | str | Path, /) -> Study: ...
@overload
def load(study: Study | str | Path, /, *more: Study | str | Path) -> Study | Studies: ...
def load(*studies: Study | str | Path) -> Study | Studies:
    """The study in this folder (or of this name in outputs/), or several as one: their frames one below the other.
    Raises ConfigError if there is none."""
    if not studies:
        raise ConfigError("load", "names no study", 'load("outputs/cr_vs_ncr")')
    found = [study if isinstance(study, Study) else Study(folder_of(study)) for study in studies]
    return found[0] if len(found) == 1 else Studies(found)


def folder_of(study: str | Path) -> Path:
    """A study's folder, by its path or its name in outputs/. Raises ConfigError."""
    path = Path(study)
    if not path.is_dir() and (Path("outputs") / path).is_dir():
        path = Path("outputs") / path
    if not path.is_dir():
        known = sorted(p.name for p in Path("outputs").glob("*") if p.is_dir())
        raise ConfigError(str(study), "there is no such study", nearest(path.name, known) if known else
                          "Run one first: python -m attnlab +experiment=smoke")
    if not (path / FILE).exists() and not any(looks_like_run(p) for p in path.iterdir() if p.is_dir()):
        inside = sorted(p.name for p in path.iterdir() if p.is_dir() and is_study(p))
        if inside:
            raise ConfigError(str(study), "is no study but holds some", f"Name one: {', '.join(inside[:12])}")
        if looks_like_run(path):
            raise ConfigError(str(study), "is one run of a study", f"Name the study: {path.parent}")
    return path


def is_study(path: Path) -> bool:
    """Has this folder runs, or a file that asks for some?"""
    return (path / FILE).exists() or any(looks_like_run(p) for p in path.iterdir() if p.is_dir())


class Study:
    """The results of a study. Frames hold the rows of all complete runs; ``runs`` has a row for every run folder."""

    def __init__(self, path: Path):
        self.path = path
        self._states = states_in(path)
        self.file = read_study(path) or recovered(path, self._states)
        self._conditions = self.file.by_name()
        self._asked = {run.name: run for run in self.file.runs}
        self._broken: dict[str, str] = {}
        self._plain: dict[str, pd.DataFrame] = {}
        self._settle()

    def _settle(self) -> None:
        """What was asked for and never started is missing; what was not asked for is no part of the study."""
        by_key = {run.key: run.name for run in self.file.runs}
        for name, (_, _, about) in list(self._states.items()):
            if name in self._asked or "status" not in about:
                continue
            home = by_key.get(str(about.get("key")))
            why = f"a copy of {home}" if home else "not asked for in study.json"
            self._states[name] = ("not asked for", why, about)
        for name in self._asked:
            self._states.setdefault(name, ("missing", "was asked for and never started", {}))

    def __repr__(self) -> str:
        return (f"Study('{self.path}'): {len(self.complete)} complete runs of {len(self._asked)}; frames: "
                f"{', '.join(TABLES)}, runs")

    @property
    def name(self) -> str:
        """What the study is called: its folder."""
        return self.path.resolve().name

    @cached_property
    def runs(self) -> pd.DataFrame:
        """One row a run that was asked for, missing and failed ones included, and for every other run folder: study,
        run, condition, status, why, seed, curiosity, key, wall_s, cpu_s, cycles, error, overrides and the swept
        settings."""
        import pandas as pd
        rows = []
        for name, (state, reason, about) in self._states.items():
            status, why = ("damaged", self._broken[name]) if name in self._broken else (state, reason)
            asked = self._asked.get(name)
            condition = self._conditions.get(asked.condition) if asked else None
            settings = condition.settings if condition else {}
            rows.append({"study": self.name, "run": name, "condition": condition.name if condition else None,
                         "status": status, "why": why, "seed": asked.seed if asked else about.get("seed"),
                         "curiosity": settings.get("curiosity", about.get("curiosity")),
                         "key": asked.key if asked else about.get("key"),
                         **{key: about.get(key) for key in ("wall_s", "cpu_s", "cycles", "error", "overrides")},
                         **{key: value for key, value in settings.items() if key != "curiosity"}})
        return pd.DataFrame(rows, columns=None if rows else RUNS)

    @cached_property
    def swept(self) -> list[str]:
        """Names of the settings that set conditions apart (but for seed and curiosity)."""
        return [name for name in self.file.axes if name != "curiosity"]

    @property
    def complete(self) -> list[str]:
        """Names of the complete runs."""
        return [name for name, (status, _, _) in self._states.items()
                if status == "complete" and name in self._asked and name not in self._broken]

    @property
    def failed(self) -> list[str]:
        """Names of the runs that were asked for, were started, and came to nothing: failed or damaged."""
        return [name for name, (status, _, _) in self._states.items()
                if name in self._asked and (status in ("failed", "damaged") or name in self._broken)]

    def named(self) -> dict[str, str]:
        """What the condition of each complete run is called: run -> name, in the order in which they were asked for."""
        order = {condition.name: i for i, condition in enumerate(self.file.conditions)}
        complete = set(self.complete)
        asked = sorted((run for run in self.file.runs if run.name in complete),
                       key=lambda run: (order[run.condition], run.seed))
        return {run.name: run.condition for run in asked}

    def condition(self, run: str) -> Condition:
        """The condition of a run that was asked for."""
        return self._conditions[self._asked[run].condition]

    def seed(self, run: str) -> int:
        """The seed of a run that was asked for."""
        return self._asked[run].seed

    def about(self, run: str) -> dict[str, Any]:
        """run.json of a run; empty if it has none."""
        return self._states[run][2]

    def config(self, run: str) -> dict[str, Any]:
        """The resolved config of a run that was asked for, but for its cosmetic settings."""
        return {**self.condition(run).config, "seed": self.seed(run)}

    def plain(self, table: str) -> pd.DataFrame:
        """A table without the columns of swept settings, and of ``cycles`` only each run's last recorded episode: what
        the report reads, small however much was swept or recorded."""
        if table not in self._plain:
            swept = set(self.swept)

            def cut(found: pa.Table) -> pa.Table:
                found = found.drop_columns([name for name in found.column_names if name in swept])
                found = last_episode(found) if table == "cycles" else found
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
        tables: dict[str, pa.Table] = {}
        for name in self.complete:
            try:
                found = pq.ParquetFile(pa.BufferReader(self._bytes(name, table))).read(use_threads=False)
                check_table(found, table, name)
                found = upgraded(found, table, self.about(name))
            except Exception as cause:  # noqa: BLE001  whatever the reader makes of a damaged file, the others go on
                self._broken[name] = f"{table}.parquet: {cause}"
                self.__dict__.pop("runs", None)
                continue
            tables[name] = found if cut is None else cut(found)
        if not tables:
            return pd.DataFrame()
        kept = {name: found for name, found in tables.items() if len(found)} or dict([*tables.items()][:1])
        frame = join(list(kept.values()))
        return self._marked(frame, {name: len(found) for name, found in kept.items()}, table) if cut is None else frame

    def _bytes(self, run: str, table: str) -> bytes:
        """A table's file. Raises ValueError if it is not what the run wrote."""
        data = (self.path / run / f"{table}.parquet").read_bytes()
        marks = self.about(run).get("tables")
        mark = marks.get(table) if isinstance(marks, dict) else None
        if isinstance(mark, dict) and mark_of(data)["sha256"] != mark.get("sha256"):
            raise ValueError("is not what the run wrote")
        return data

    def _marked(self, frame: pd.DataFrame, rows: dict[str, int], table: str) -> pd.DataFrame:
        """A table with the study, the condition, and the settings that set it apart; ``rows`` of each run in it."""
        swept = self.swept if "episode" in frame and table != "cycles" else []
        conditions = [self.condition(run) for run in rows]
        first = {"study": [self.name] * len(rows), "condition": [condition.name for condition in conditions]}
        last = {name: [condition.settings.get(name) for condition in conditions] for name in swept if name not in frame}
        return marked(frame, list(rows.values()), first, last)

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


class Studies:
    """Several studies as one: every frame holds the rows of all of them, told apart by its column ``study``."""

    def __init__(self, studies: list[Study]):
        self.studies = studies

    def __repr__(self) -> str:
        return f"Studies({self.studies})"

    def __getattr__(self, name: str) -> pd.DataFrame:
        if name not in (*TABLES, "runs"):
            raise AttributeError(f"several studies have {', '.join(TABLES)} and runs, no {name}; ask one of .studies")
        import pandas as pd
        frames: list[pd.DataFrame] = [getattr(study, name) for study in self.studies]
        return pd.concat(frames, ignore_index=True)
