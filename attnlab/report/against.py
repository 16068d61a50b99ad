"""Two studies held against each other: the same conditions, what their settings differ in, and every measure with the
interval of its difference."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NamedTuple

from attnlab.errors import ConfigError
from attnlab.measures.needs import units_of
from attnlab.results.by_run import by_run
from attnlab.results.conditions import Conditions
from attnlab.results.load import Study
from attnlab.stats import Interval, mean_interval, paired
from attnlab.stats.intervals import difference_interval
from attnlab.tables.flat import flatten, text

PERCENT = {"early": "survival, first half of training", "late": "survival, second half", "validation":
           "survival, validation", "crashed": "crashed"}
SHARED_TO_PAIR = 2  # seeds that make a paired interval
Values = Mapping[int, float]


class Compared(NamedTuple):
    """A measure of a condition: its values by seed in both studies, and the first less the second. ``paired``: by seed,
    over ``seeds`` of them; else the two are independent samples (Welch)."""
    condition: str
    measure: str
    unit: str
    one: Values
    other: Values
    difference: Interval
    paired: bool
    seeds: tuple[int, ...]

    @property
    def clear(self) -> bool:
        """Does the interval leave out 0?"""
        return self.difference.low > 0 or self.difference.high < 0


class Facing(NamedTuple):
    """Two studies side by side. ``differs``: condition -> setting -> its value (as text) in either; ``alone``: the
    conditions that only the first, or only the second has."""
    one: Study
    other: Study
    differs: dict[str, dict[str, tuple[str, str]]]
    compared: list[Compared]
    alone: tuple[list[str], list[str]]

    @property
    def everywhere(self) -> dict[str, tuple[str, str]]:
        """Settings that differ in all conditions in the same way."""
        first, *rest = self.differs.values()
        return {name: pair for name, pair in first.items() if all(of.get(name) == pair for of in rest)}


def face(one: Study, other: Study) -> Facing:
    """Raises ConfigError if they are the same study, or have no condition in common that was run in both."""
    if one.path.resolve() == other.path.resolve():
        raise ConfigError("--against", f"{other.path} is the study itself", "Name another one")
    values = [_by_condition(study) for study in (one, other)]
    for study, of in zip((one, other), values, strict=True):
        if not of:
            raise ConfigError(str(study.path), "has no complete run to compare")
    mine, theirs = values
    alone = [name for name in mine if name not in theirs], [name for name in theirs if name not in mine]
    both = [name for name in mine if name in theirs]
    if not both:
        raise ConfigError("--against", f"{one.name} and {other.name} have no condition in common",
                          f"{one.name}: {', '.join(alone[0][:6])}; {other.name}: {', '.join(alone[1][:6])}")
    differs, compared = {}, []
    for name in both:
        first, second = ({key: text(value) for key, value in flatten(study.file.by_name()[name].config).items()}
                         for study in (one, other))
        differs[name] = {key: (first.get(key, "-"), second.get(key, "-")) for key in sorted({*first, *second})
                         if first.get(key) != second.get(key)}
        compared += [_compare(name, *measure, of, theirs[name][measure], len(_parts(differs[name])))
                     for measure, of in mine[name].items() if measure in theirs[name]]
    return Facing(one, other, differs, compared, alone)


def _parts(differs: Iterable[str]) -> list[str]:
    """Of a part that is another one (simulator.name) all settings count as one."""
    names = list(differs)
    return [name for name in names if name.endswith(".name") or f"{name.rpartition('.')[0]}.name" not in names]


def _by_condition(study: Study) -> dict[str, dict[tuple[str, str], dict[int, float]]]:
    """Condition -> (measure, unit) -> seed -> value."""
    numbers, named = by_run(study), study.named()
    units = units_of(Conditions(study)) if numbers else {}
    found: dict[str, dict[tuple[str, str], dict[int, float]]] = {}
    for run, of in numbers.items():
        rows = [(name, "%", None if of[key] is None else 100 * of[key]) for key, name in PERCENT.items()]
        rows += [("safety", "0-1", of["safety"]), ("energy", "UoE", of["energy"])]
        rows += [(need, units.get(need, "UoE"), value) for need, value in of["needs"].items()]
        rows += [(f"activations of {name}", "an episode", value) for name, value in of["activations"].items()]
        mine = found.setdefault(named[run], {})
        for measure, unit, value in rows:
            if value is not None and value == value:
                mine.setdefault((measure, unit), {})[study.seed(run)] = value
    return found


def _compare(condition: str, measure: str, unit: str, one: Values, other: Values, differ: int) -> Compared:
    """By seed, where seeds are shared and at most one thing was set otherwise: then the luck of a seed is the same in
    both. Else the two are samples that have nothing to do with each other."""
    seeds = tuple(sorted(set(one) & set(other)))
    if differ <= 1 and len(seeds) >= SHARED_TO_PAIR:
        by_seed = mean_interval(paired(dict(one), dict(other)))
        return Compared(condition, measure, unit, one, other, by_seed, True, seeds)
    apart = difference_interval(list(one.values()), list(other.values()))
    return Compared(condition, measure, unit, one, other, apart, False, ())
