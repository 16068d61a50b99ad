"""Checks of those who watch a run: probes and callbacks."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from attnlab.probes.base import Probe
from attnlab.robot.folder import run_to_folder
from attnlab.tables.schema import TABLES
from attnlab.tables.scratch import scratch
from attnlab.testing.build import config, make, node, run

INFO: dict[str, Any] = {"run": "watched", "key": "k", "overrides": [], "swept": {}}


def _chosen(group: str, name: str, settings: dict[str, Any]) -> dict[str, Any]:
    return {group: {name: node(group, name, **settings)}}


def columns_as_declared(name: str, **settings: Any) -> None:
    """Its columns are there, one value a row, and nothing else changes: other columns are as without it."""
    probe: Probe = make("probe", name, **settings)
    plain, probed = run(), run(**_chosen("probe", name, settings))
    for table in TABLES:
        added = set(probed[table]) - set(plain[table])
        assert added == (set(probe.columns) if table == probe.table else set()), f"{name}: {table} gained {added}"
        for column, values in plain[table].items():
            assert repr(probed[table][column]) == repr(values), f"{name}: {table}.{column} is another with it"
        for column in added:
            assert len(probed[table][column]) == len(probed[table]["run"]), f"{name}: {column} has gaps"


def meanings_said(name: str, **settings: Any) -> None:
    """Every column has a meaning, and a number has a unit."""
    probe: Probe = make("probe", name, **settings)
    for column, (kind, unit, meaning) in probe.columns.items():
        assert meaning.strip(), f"{name}: {column} says not what it means"
        assert unit or kind in ("string", "bool"), f"{name}: {column} is a number without a unit ('1' if it is plain)"


PROBE = (columns_as_declared, meanings_said)


def touches_nothing(name: str, **settings: Any) -> None:
    """The tables of a run are the same bytes with it and without it, and it raises nothing."""
    with scratch() as place:
        bytes_of: list[Any] = []
        for chosen in ({}, _chosen("callback", name, settings)):
            folder = Path(place) / str(len(bytes_of))
            assert run_to_folder(config(**chosen), folder, INFO)
            bytes_of.append([(folder / f"{table}.parquet").read_bytes() for table in TABLES])
        assert bytes_of[0] == bytes_of[1], f"{name}: a table is another with it"
        assert '"callbacks"' not in (folder / "run.json").read_text(), f"{name}: it raised"


CALLBACK = (touches_nothing,)
