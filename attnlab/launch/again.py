"""A run that is there, made once more and held against what is stored."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from attnlab.results.one import no_run
from attnlab.results.states import read_config, state_of
from attnlab.robot.folder import run_to_folder
from attnlab.tables.code import code, versions
from attnlab.tables.files import read_json
from attnlab.tables.schema import TABLES
from attnlab.tables.scratch import scratch


def made_again(folder: Path) -> list[str]:
    """Make a complete run again, elsewhere; the differences, none if all tables are the same bytes. Raises
    ConfigError."""
    status, why, about = state_of(folder)
    config = read_config(folder)
    if status != "complete" or config is None:
        raise no_run(folder, why or status)
    info = {"run": about.get("run", folder.name), "key": about.get("key"), "overrides": about.get("overrides") or [],
            "swept": about.get("swept") or {}}
    with scratch() as home:
        new = Path(home) / "run"
        if not run_to_folder({**config, "callback": {}}, new, info):
            error = str((read_json(new / "run.json") or {}).get("error")).strip().splitlines()
            return [f"the run fails now: {error[-1]}"]
        files = [f"{table}.parquet" for table in TABLES]
        found = [line for file in files for line in differences(folder / file, new / file)]
    return found + list(_code(about)) if found else []


def differences(stored: Path, new: Path) -> Iterator[str]:
    """The first thing in which two tables differ; nothing if they are the same bytes."""
    if stored.read_bytes() == new.read_bytes():
        return
    import pyarrow.parquet as pq
    name = stored.stem
    try:
        one, other = (pq.read_table(file, partitioning=None) for file in (stored, new))
    except Exception as cause:  # noqa: BLE001  whatever the reader makes of a damaged file
        yield f"{name}: cannot be read as it is stored ({str(cause).splitlines()[0]})"
        return
    if one.column_names != other.column_names:
        here, there = set(one.column_names), set(other.column_names)
        yield f"{name}: stored without {sorted(there - here)}, and with {sorted(here - there)}" if here != there else \
            f"{name}: its columns are in another order"
    elif len(one) != len(other):
        yield f"{name}: {len(one)} rows are stored, {len(other)} are made now"
    else:
        for row in range(len(one)):
            for column in one.column_names:
                was, now = one[column][row].as_py(), other[column][row].as_py()
                if was != now and not (was != was and now != now):
                    yield f"{name}: row {row}, {column}: {was!r} is stored, {now!r} is made now"
                    return
        yield f"{name}: the same values in other bytes"


def _code(about: dict[str, Any]) -> Iterator[str]:
    """In what code and packages differ, and whether that may be."""
    if about.get("exempt_from_same_bytes"):
        yield f"it need not be the same: {about['exempt_from_same_bytes']}"
    stored, now = about.get("versions") or {}, versions()
    yield from (f"made with {name} {stored.get(name)}, now {now.get(name)}" for name in sorted({*stored, *now})
                if stored.get(name) != now.get(name))
    if (about.get("code") or {}).get("hash") not in (None, code()["hash"]):
        yield "made by other code of this package"
