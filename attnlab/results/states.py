"""What became of a run: told from its folder, cheaply."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from attnlab.tables.files import mark_of, read_json
from attnlab.tables.schema import OLDEST_SCHEMA, SCHEMA_VERSION, TABLES
from attnlab.tables.yamls import read_yaml

State = tuple[str, str, dict[str, Any]]  # (status, why, run.json)


def state_of(folder: Path, whole: bool = False) -> State:
    """(status, why, run.json) of a run folder. ``damaged``: it says complete, but a table is missing or broken.
    ``whole``: read every table, and compare it with what was written."""
    about = read_json(folder / "run.json")
    if about is None:
        missing = "no run.json" if not (folder / "run.json").exists() else "run.json is not readable"
        return "incomplete", f"{missing}; the run was interrupted or is not one", {}
    status = str(about.get("status"))
    if status == "complete":
        if about.get("schema") not in range(OLDEST_SCHEMA, SCHEMA_VERSION + 1):
            return "damaged", (f"tables of schema {about.get('schema')}, this version reads {OLDEST_SCHEMA} to "
                               f"{SCHEMA_VERSION}; run it again with fresh=true"), about
        robot = about.get("agent")
        if whole and isinstance(robot, dict) and "sha256" in robot:
            problem = check_mark(folder / "agent.json", robot)
            if problem:
                return "damaged", problem, about
        for table in TABLES:
            file, marks = folder / f"{table}.parquet", about.get("tables")
            mark = marks.get(table) if isinstance(marks, dict) else None
            problem = _check_parquet(file) or (check_mark(file, mark) if whole and isinstance(mark, dict) else "")
            if problem:
                return "damaged", problem, about
    error = str(about.get("error") or "").strip().splitlines()
    return status, error[-1] if error else "", about


def _check_parquet(path: Path) -> str:
    """Empty if the file has a Parquet head and tail, else what is wrong. Cheap: reads 8 bytes."""
    try:
        with path.open("rb") as file:
            head = file.read(4)
            file.seek(-4, 2)
            tail = file.read(4)
    except OSError:
        return f"{path.name} is missing or cut off"
    return "" if head == tail == b"PAR1" else f"{path.name} is cut off or no Parquet file"


def check_mark(path: Path, mark: dict[str, Any]) -> str:
    """Empty if a table is as run.json says it was written, else what is wrong."""
    try:
        found = mark_of(path.read_bytes())
    except OSError:
        return f"{path.name} cannot be read"
    return "" if found["sha256"] == mark.get("sha256") else f"{path.name} is not what the run wrote"


def looks_like_run(folder: Path) -> bool:
    """Does this folder hold anything that a run writes?"""
    return any((folder / name).exists() for name in ("run.json", "config.yaml", *(f"{t}.parquet" for t in TABLES)))


def states_in(study: Path) -> dict[str, State]:
    """The state of every run folder of a study, by name."""
    return {folder.name: state_of(folder) for folder in sorted(study.iterdir())
            if folder.is_dir() and looks_like_run(folder)}


def read_config(folder: Path) -> dict[str, Any] | None:
    """The resolved config of a run; None if it is missing or unreadable."""
    from yaml import YAMLError
    try:
        content = read_yaml((folder / "config.yaml").read_text())
    except (OSError, ValueError, YAMLError, RecursionError):
        return None
    return content if isinstance(content, dict) else None
