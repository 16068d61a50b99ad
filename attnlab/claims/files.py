"""Claims files: read, checked, typed. docs/claims.md tells how to write one."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

from attnlab import registry
from attnlab.claims import claims_path
from attnlab.claims.parts import Claim, Part, Role, Rules
from attnlab.claims.sense import can_fail_and_hold
from attnlab.config import check_path
from attnlab.errors import ConfigError, nearest
from attnlab.groups import GROUPS
from attnlab.loading import config_homes, load_all
from attnlab.measures.base import Measure
from attnlab.results.conditions import Runs
from attnlab.settings import build, setting
from attnlab.tables.yamls import read_yaml

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

@runtime_checkable
class Permuted(Protocol):
    """A measure that can be judged by a permutation test."""

    def null(self, runs: Runs, draws: int, seed: int) -> npt.NDArray[np.float64]:
        """What it would be if nothing of interest mattered, shape (draws,)."""


@dataclass
class _File:
    title: str = setting("", "of the paper or the study")
    source: str = setting("", "where it was published")
    own: bool | None = setting(None, "are they hypotheses of one's own (supported, not reproduced)? Left out: if there "
                                     "is no source, or it begins with attnlab")
    about: dict[str, Any] = setting({}, "settings that every run must have, e.g. {world: paper}; else no verdicts")
    roles: dict[str, Any] = setting({}, "groups of runs by the settings they share: treatment, control, ...")
    rules: Rules = setting(Rules(), "how verdicts are reached")
    claims: dict[str, Any] = setting({}, "by id")


@dataclass
class Claims:
    """A checked claims file. ``measures[id][i]`` is the measure of part i of claim id, ``forms[id][i]`` its other forms
    by name."""
    path: Path
    sha256: str
    title: str
    source: str
    own: bool
    about: dict[str, Any]
    roles: dict[str, Role]
    rules: Rules
    claims: dict[str, Claim]
    measures: dict[str, list[Measure]]
    forms: dict[str, list[dict[str, Measure]]]

    @property
    def labels(self) -> dict[str, str]:
        """Names of curiosities: the label of the first role that has each."""
        found: dict[str, str] = {}
        for role in self.roles.values():
            if "curiosity" in role.where:
                found.setdefault(str(role.where["curiosity"]), role.label)
        return found


def load_claims(name: str) -> Claims:
    """The claims file of this name or path. Raises ConfigError naming file, claim and field."""
    from yaml import MarkedYAMLError, YAMLError
    path = claims_path(name)
    data = path.read_bytes()
    try:
        content = read_yaml(data.decode())
    except MarkedYAMLError as cause:  # where and what, and nothing of what the file says: it may be any file
        mark = cause.problem_mark or cause.context_mark
        raise ConfigError(f"{path.name}:{mark.line + 1}" if mark else path.name, "is no readable YAML",
                          "Look at the line above it too") from None
    except (YAMLError, ValueError) as cause:
        why = "" if isinstance(cause, (YAMLError, UnicodeDecodeError)) else f": {cause}"
        raise ConfigError(path.name, f"is no readable YAML{why}") from None
    where = path.name
    file = build(_File, content, where)
    if not file.claims:
        raise ConfigError(f"{where}.claims", "there are none")
    load_all()
    for told_by in file.about:
        _check_setting(str(told_by), f"{where}.about")
    found = Claims(path, hashlib.sha256(data).hexdigest(), file.title or path.stem, file.source,
                   not file.source or file.source.startswith("attnlab") if file.own is None else file.own, file.about,
                   _roles(file.roles, where), file.rules, {}, {}, {})
    for key, node in file.claims.items():
        place = f"{where}.{key}"
        found.claims[str(key)] = claim = build(Claim, node, place)
        places = [f"{place}.parts[{i}]" for i in range(len(claim.parts))]
        for part, at in zip(claim.parts, places, strict=True):
            for role in part.roles:
                if role not in found.roles:
                    raise ConfigError(at, f"compares the role '{role}', which roles does not name",
                                      nearest(role, found.roles))
        found.measures[str(key)] = [_measure(part, part.node, at)
                                    for part, at in zip(claim.parts, places, strict=True)]
        found.forms[str(key)] = [{form: _measure(part, {**part.node, **changed}, f"{at}.forms.{form}")
                                  for form, changed in part.forms.items()}
                                 for part, at in zip(claim.parts, places, strict=True)]
    played = {role for claim in found.claims.values() for part in claim.parts for role in part.roles}
    for role in found.roles:
        if role not in played:
            raise ConfigError(f"{where}.roles.{role}", "is played by nobody: no comparison names it",
                              nearest(role, played))
    return found


def _roles(node: Mapping[str, Any], where: str) -> dict[str, Role]:
    if not node:
        raise ConfigError(f"{where}.roles", "names none", "Write roles: {treatment: {where: {curiosity: litman}}}")
    roles = {str(name): build(Role, value, f"{where}.roles.{name}") for name, value in node.items()}
    for name, role in roles.items():
        if not role.where:
            raise ConfigError(f"{where}.roles.{name}.where", "is missing", "Write where: {curiosity: litman}")
        for told_by, value in role.where.items():
            _check_setting(str(told_by), f"{where}.roles.{name}.where")
            _check_option(str(told_by), value, f"{where}.roles.{name}.where")
        role.label = role.label or name
    return roles


def _check_setting(name: str, where: str) -> None:
    """Can runs be told apart by this: a setting, a variant, or a group of files such as generation?"""
    if name == "variant" or (config_homes(name) and name not in GROUPS):
        return
    try:
        check_path(name)
    except ConfigError as error:
        raise ConfigError(f"{where}.{name}", error.problem, error.hint) from None


def _check_option(name: str, value: Any, where: str) -> None:
    """A part that nobody registered and no file describes is played by no run."""
    if name in GROUPS and isinstance(value, str):
        known = {option for spec in registry.parts.values() if spec.group == name for option in spec.options} | \
            {file.stem for home in config_homes(name) for file in home.glob("*.yaml")}
        if known and value not in known:
            raise ConfigError(f"{where}.{name}", f"no {name} is called '{value}'", nearest(value, known))


def _measure(part: Part, node: Mapping[str, Any], where: str) -> Measure:
    measure: Measure = registry.make("measure", node, None, f"{where}.measure")
    if measure.unit != part.unit:
        raise ConfigError(f"{where}.unit", f"is '{part.unit}', but the measure '{node['name']}' is in "
                          f"'{measure.unit}'")
    if part.test == "permutation" and not isinstance(measure, Permuted):
        raise ConfigError(f"{where}.test", f"the measure '{node['name']}' has no permutation test (no method null)")
    can_fail_and_hold(part, measure, where)
    return measure
