"""What sets conditions apart, and the one name that each has."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from attnlab.config import COSMETIC
from attnlab.tables.flat import dig, flatten, text

IGNORED = {*COSMETIC, "seed", "experiment"}  # set no conditions apart


@dataclass
class Naming:
    """``axes``: names of the settings that set conditions apart. For each condition: its ``names`` and its ``values``
    on the axes. ``notes``: a line for every setting that differs although nobody swept it."""
    axes: list[str]
    names: list[str]
    values: list[dict[str, Any]]
    notes: list[str]


def name_all(conditions: Sequence[tuple[Mapping[str, Any], Mapping[str, Any]]], labels: Mapping[str, str]) -> Naming:
    """Names of conditions given as (settings that were swept, config). Axes come in the order in which they were
    swept, ``curiosity`` first."""
    declared = dict.fromkeys(name for settings, _ in conditions for name in settings)
    declared.pop("curiosity", None)
    axes = ["curiosity", *declared]
    values = [{name: value_of(settings, config, name) for name in axes} for settings, config in conditions]
    more, notes = undeclared(values, [config for _, config in conditions])
    for row, (settings, config) in zip(values, conditions, strict=True):
        row.update({name: value_of(settings, config, name) for name in more})
    axes += more
    telling = telling_axes(axes, values, any("curiosity" in settings for settings, _ in conditions))
    last = [name.rpartition(".")[2] for name in telling]
    short = {name: end if last.count(end) == 1 else name for name, end in zip(telling, last, strict=True)}
    names = [" ".join(said(name, short[name], row[name], labels) for name in telling)
             or said("curiosity", "curiosity", row["curiosity"], labels) for row in values]
    return Naming(axes, names, values, notes)


def telling_axes(axes: Sequence[str], values: Sequence[Mapping[str, Any]], curiosity_swept: bool) -> list[str]:
    """The axes that a name needs: those that vary, but for what a variant's name implies, and for curiosity where it
    follows from what was swept."""
    columns = {name: [text(row[name]) for row in values] for name in axes}
    telling = [name for name in axes if len(set(columns[name])) > 1]
    if "variant" in telling:
        telling = [name for name in telling
                   if name == "variant" or len(set(zip(columns["variant"], columns[name], strict=True)))
                   > len(set(columns["variant"]))]
    rest = [name for name in telling if name != "curiosity"]
    enough = len({tuple(columns[name][i] for name in rest) for i in range(len(values))}) == len(values)
    return rest if rest and enough and not curiosity_swept else telling


def said(name: str, short: str, value: Any, labels: Mapping[str, str]) -> str:
    """A value in a condition's name: its label, the part's or variant's name, or setting=value."""
    shown = text(value)
    if shown in labels:
        return str(labels[shown])
    return shown if "." not in name or name.endswith(".name") else f"{short}={shown}"


def value_of(settings: Mapping[str, Any], config: Mapping[str, Any], name: str) -> Any:
    """A setting as it was swept, or else as it is in the config; the part's name for a group."""
    if name in settings:
        return settings[name]
    value = dig(config, name)
    if name == "behaviours" and isinstance(value, Mapping):
        return "[" + ",".join(value) + "]"
    return value.get("name") if isinstance(value, Mapping) else value


def is_value(name: str, has: str, wanted: Any) -> bool:
    """Does a condition that ``has`` this (the text of :func:`value_of`) have what a claims file asks for? Behaviours
    stand there as a list, and in any order."""
    if name == "behaviours":
        listed = wanted if isinstance(wanted, list) else str(wanted).strip("[]").split(",")
        return sorted(has.strip("[]").split(",")) == sorted(str(one).strip() for one in listed)
    return has == text(wanted)


def undeclared(values: Sequence[Mapping[str, Any]], configs: Sequence[Mapping[str, Any]]
               ) -> tuple[list[str], list[str]]:
    """(settings that differ between conditions of the same swept settings, a note on each)."""
    groups: dict[tuple[str, ...], list[int]] = {}
    for i, row in enumerate(values):
        groups.setdefault(tuple(map(text, row.values())), []).append(i)
    groups = {key: members for key, members in groups.items() if len(members) > 1}
    flat = {i: flatten(configs[i]) for members in groups.values() for i in members}
    found: dict[str, dict[str, int]] = {}
    for members in groups.values():
        for name in sorted({name for i in members for name in flat[i]}):
            counts: dict[str, int] = {}
            for i in members:
                value = text(flat[i].get(name))
                counts[value] = counts.get(value, 0) + 1
            if len(counts) > 1 and name.partition(".")[0] not in IGNORED:
                total = found.setdefault(name, {})
                for value, count in counts.items():
                    total[value] = total.get(value, 0) + count
    kept = sorted(name for name in found if not follows(name, found, flat))
    return kept, [f"conditions of different studies are mixed here: {name} is {' and '.join(sorted(found[name]))}"
                  for name in kept]


def follows(name: str, found: Mapping[str, Any], flat: Mapping[int, Mapping[str, Any]]) -> bool:
    """Is this setting a matter of which part was chosen? Then the part's name says it: world.name for world.boxes."""
    part = f"{name.partition('.')[0]}.name"
    if part == name or part not in found:
        return False
    values: dict[str, set[str]] = {}
    for settings in flat.values():
        values.setdefault(text(settings.get(part)), set()).add(text(settings.get(name)))
    return all(len(of) == 1 for of in values.values())
