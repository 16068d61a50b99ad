"""Studies that have no file of their own, as older versions wrote them: what their run folders say of them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from attnlab.results.states import State, read_config, states_in
from attnlab.tables.study import Condition, StudyFile, condition_config, condition_key

if TYPE_CHECKING:
    import pyarrow as pa


def recovered(path: Path, states: Mapping[str, State] | None = None) -> StudyFile:
    """A study's file as it would have been written. Of what was asked for, only that is known which left a folder."""
    study, seen = StudyFile(), set()
    states = states_in(path) if states is None else states
    for name in sorted(states, key=lambda name: (not _is_home(name, states[name]), name)):
        _, _, about = states[name]
        key, seed = about.get("key"), about.get("seed")
        if not isinstance(key, str) or not isinstance(seed, int) or key in seen:
            continue
        config = read_config(path / name)
        if config is None:
            study.notes.append(f"run {name} is left out: its config.yaml is missing or unreadable")
            continue
        seen.add(key)
        labels = config.get("labels")
        study.labels.update({str(k): str(v) for k, v in labels.items()} if isinstance(labels, Mapping) else {})
        swept = about.get("swept")
        condition = Condition(condition_key(config), condition_config(config),
                              dict(swept) if isinstance(swept, Mapping) else {})
        study.add(condition, [(name, key, seed)])
        if isinstance(about.get("claims"), Mapping):
            study.claims = study.claims or dict(about["claims"])
    notes = study.notes
    study.rename()
    study.notes = notes + study.notes
    return study


def _is_home(name: str, state: State) -> bool:
    """Is this the folder that the run was made in, and no copy of it?"""
    about = state[2]
    return name == about["run"] if "run" in about else name.rpartition("-")[2] == about.get("key")


def upgraded(found: pa.Table, table: str, about: Mapping[str, Any]) -> pa.Table:
    """A table as today's schema has it. In schema 1 rewards held their penalty, and safety was what is now
    ``safety_held``: nobody knows the true one any more."""
    if about.get("schema") != 1:
        return found
    import pyarrow as pa
    import pyarrow.compute as pc
    if table == "behaviours":
        for name in ("reward", "reward_extrinsic"):
            place = found.column_names.index(name)
            found = found.set_column(place, name, pc.subtract(found.column(name), found.column("penalty")))
    for place, name in enumerate(found.column_names):
        if table in ("episodes", "cycles") and name.startswith("safety"):
            found = found.append_column(name.replace("safety", "safety_held"), found.column(name))
            found = found.set_column(place, name, pa.nulls(len(found), pa.float64()))
    return found
