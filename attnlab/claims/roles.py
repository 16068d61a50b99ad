"""Who plays which role in a study: strata to judge, runs that failed, studies of other things."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import takewhile
from typing import Any

from attnlab.claims.files import Claims
from attnlab.results.conditions import Conditions, Runs
from attnlab.tables.flat import dig, text
from attnlab.tables.naming import is_value, value_of

Combinations = dict[str, dict[str, str]]  # name -> settings by dotted name, as texts


def strata(claims: Claims, conditions: Conditions) -> Combinations:
    """Combinations to judge, by name: values of the settings that vary and tell no roles apart.

    Variants that differ in settings of the roles alone are one combination, called by what their names begin with.
    """
    of_roles = {name for role in claims.roles.values() for name in role.where}
    others = [name for name in conditions.settings if name not in of_roles]
    groups: dict[tuple[str, ...], list[dict[str, str]]] = {}
    for stratum in conditions.strata:
        values = dict(zip(conditions.settings, stratum, strict=True))
        groups.setdefault(tuple(values[name] for name in others if name != "variant"), []).append(values)
    merged = "variant" in others and any(len({of["variant"] for of in group}) > 1 for group in groups.values()) \
        and _told_without_variant(conditions)
    kept = [name for name in others if not (merged and name == "variant")]
    found: Combinations = {}
    for group in groups.values():
        for values in group:
            begins = _beginning([of["variant"] for of in group]) if merged else ""
            name = begins or ", ".join(f"{name}={values[name]}" for name in kept) if merged else \
                conditions.stratum_name(tuple(values.values())) if len(kept) == len(values) else \
                ", ".join(f"{name}={values[name]}" for name in kept)
            found.setdefault(name, {name: values[name] for name in kept})
    return found


def _told_without_variant(conditions: Conditions) -> bool:
    """Are no two conditions the same but for the variant's name?"""
    place = 1 + conditions.settings.index("variant")
    rest = [key[:place] + key[place + 1:] for key in conditions.keyed]
    return len(set(rest)) == len(rest)


def _beginning(names: Sequence[str]) -> str:
    """The words with which all names begin."""
    words = zip(*(name.split() for name in names), strict=False)
    return " ".join(word[0] for word in takewhile(lambda word: len(set(word)) == 1, words))


def failed(conditions: Conditions, where: Mapping[str, Any], stratum: Mapping[str, str]) -> set[int]:
    """Seeds of a role whose run was started and failed, and that no complete run stands for."""
    study = conditions.study
    by_name = study.file.by_name()
    lost, there = set(), set(conditions.matching(where, stratum)[0].runs)
    for run in study.failed:
        condition = by_name[study.condition(run).name]
        if all(is_value(name, text(value_of(condition.settings, condition.config, name)), value)
               for name, value in {**where, **stratum}.items()):
            lost.add(study.seed(run))
    return lost - there


def withheld(claims: Claims, roles: Mapping[str, Runs]) -> str:
    """Why no verdict is given: runs of another world, or of other behaviours, than the claims are about; "" if they are
    about these."""
    for runs in roles.values():
        if not runs.runs:
            continue
        config = runs.config(min(runs.runs))
        for name, value in claims.about.items():
            has = _named(dig(config, name))
            if has is not None and has != _named(value):
                return f"these claims are about {name}={text(_named(value))}, these runs have {name}={text(has)}"
    return ""


def _named(value: Any) -> Any:
    """A part by its name, a set of parts by their names in order."""
    if isinstance(value, Mapping):
        return value["name"] if "name" in value else sorted(map(str, value))
    return sorted(map(str, value)) if isinstance(value, list) else value
