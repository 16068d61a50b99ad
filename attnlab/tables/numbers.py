"""What a run's tables come to in a few numbers, kept in its run.json so that a summary of many runs reads no table."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from attnlab.arithmetic import total


def needs_in(columns: Iterable[str]) -> list[str]:
    """Names of the needs that the table ``episodes`` tells of: hunger, thirst, and those that plugins bring."""
    columns = list(columns)
    return [name for column in columns if column.endswith("_mean") and (name := column[:-5]) not in ("energy", "safety")
            and f"{name}_max" in columns and f"{name}_min" not in columns]


def numbers_of(tables: Mapping[str, Mapping[str, Sequence[Any]]]) -> dict[str, Any]:
    """Means over the episodes of a run: survival ``early`` and ``late`` (halves of training) and in ``validation``;
    over all of validation, or of training where there is none: ``crashed`` (share), each need, ``energy``, ``safety``,
    and ``activations`` by behaviour. None where there is nothing to take a mean of."""
    episodes, acts = tables["episodes"], tables["behaviours"]
    phases = list(episodes["phase"])
    shown = "validation" if "validation" in phases else "train"
    trained = [n for n, phase in zip(episodes["episode"], phases, strict=True) if phase == "train"]
    half = (max(trained, default=0) + 1) / 2

    def mean(column: str, of: Sequence[bool]) -> float | None:
        return mean_of(v for v, chosen in zip(episodes[column], of, strict=True) if chosen)
    early = [phase == "train" and n < half for n, phase in zip(episodes["episode"], phases, strict=True)]
    late = [phase == "train" and n >= half for n, phase in zip(episodes["episode"], phases, strict=True)]
    those = [phase == shown for phase in phases]
    names = dict.fromkeys(acts["behaviour"])
    return {
        "early": mean("survival", early), "late": mean("survival", late),
        "validation": mean("survival", [phase == "validation" for phase in phases]),
        "crashed": mean_of(float(death == "crash") for death, chosen in zip(episodes["death"], those, strict=True)
                           if chosen),
        "needs": {need: mean(f"{need}_mean", those) for need in needs_in(episodes)},
        "energy": mean("energy_mean", those), "safety": mean("safety_mean", those),
        "activations": {name: mean_of(v for v, phase, of in zip(acts["activations"], acts["phase"], acts["behaviour"],
                                                                strict=True) if of == name and phase == shown)
                        for name in names}}


def mean_of(values: Iterable[Any]) -> float | None:
    """The mean of what is there, summed from left to right; None of nothing."""
    found = [float(value) for value in values if value is not None]
    return total(found) / len(found) if found else None


def kept(about: Mapping[str, Any]) -> dict[str, Any] | None:
    """The numbers of a run.json; None if it has none, or if they are none of ours."""
    found = about.get("numbers")
    if not isinstance(found, dict):
        return None
    plain = [found.get(name, ()) for name in ("early", "late", "validation", "crashed", "energy", "safety")]
    for name in ("needs", "activations"):
        if not isinstance(found.get(name), dict):
            return None
        plain += found[name].values()
    return found if all(value is None or isinstance(value, (int, float)) for value in plain) else None
