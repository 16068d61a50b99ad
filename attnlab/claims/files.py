"""Claims files: read, checked, typed. docs/claims.md tells how to write one."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Protocol, runtime_checkable

from attnlab import registry
from attnlab.claims import claims_path
from attnlab.config import check_path
from attnlab.errors import ConfigError, nearest
from attnlab.groups import GROUPS
from attnlab.loading import config_homes, load_all
from attnlab.measures.base import Measure
from attnlab.results.conditions import Runs
from attnlab.settings import build, setting

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

ROLES = ("treatment", "control")
DIRECTIONS = ("higher", "lower", "at_least", "at_most")


@runtime_checkable
class Permuted(Protocol):
    """A measure that can be judged by a permutation test."""

    def null(self, runs: Runs, draws: int, seed: int) -> npt.NDArray[np.float64]:
        """What it would be if nothing of interest mattered, shape (draws,)."""


@dataclass
class Rules:
    confidence: float = setting(0.95, "of all intervals", above=0.5, high=0.999)
    resamples: int = setting(4000, "bootstrap samples", low=100, high=1_000_000)
    least_seeds: int = setting(3, "fewer seeds make a claim untestable", low=2)
    seed: int = setting(0, "of bootstrap and permutations", low=0)


@dataclass
class Role:
    label: str = setting("", "what it is called")
    where: dict[str, Any] = setting({}, "settings of its runs, e.g. {curiosity: litman}")


@dataclass
class Part:
    """One comparison. All numbers in ``unit``."""
    measure: Any = setting(None, "{name: ..., and its parameters}")
    test: Literal["paired", "level", "not_lower", "permutation"] = setting(
        "paired", "paired: treatment - control by seed; level: one role against reference; not_lower: paired, may be "
        "lower by margin; permutation: levels exchanged")
    direction: Literal["higher", "lower", "at_least", "at_most", "about"] = setting(
        "about", "claimed side of the reference")
    role: Literal["treatment", "control"] = setting("treatment", "whose level")
    reference: float = setting(0.0, "what the direction is against")
    number: float | None = setting(None, "what the paper found")
    tolerance: float | None = setting(None, "how far from the number counts as the same", low=0)
    margin: float | None = setting(None, "of not_lower", low=0)
    unit: str | None = setting(None, "unit of the measure; must be the measure's own")
    counts: bool = setting(True, "false: shown, but no part of the verdict")
    note: str = setting("", "shown beside it")

    @property
    def measure_name(self) -> str:
        """Of the measure that it compares."""
        return str(self.measure if isinstance(self.measure, str) else self.measure["name"])

    def __post_init__(self) -> None:
        if self.measure is None:
            raise ConfigError("measure", "is missing", "Write measure: {name: survival}")
        if self.unit is None:
            raise ConfigError("unit", "is missing", "Name the measure's unit, so that nobody misreads a number")
        if (self.number is None) != (self.tolerance is None):
            raise ConfigError("tolerance" if self.tolerance is None else "number",
                              "is missing", "number and tolerance belong together")
        if self.test in ("paired", "level") and self.direction == "about" and self.number is None:
            raise ConfigError("direction", "is missing", f"One of {', '.join(DIRECTIONS)}, or a number to be near")
        if self.test == "not_lower" and self.margin is None:
            raise ConfigError("margin", "is missing", "How much lower still counts as not lower?")


@dataclass
class Claim:
    title: str = setting("", "in a few words")
    where: str = setting("", "where in the paper")
    says: str = setting("", "what it says there")
    parts: list[Part] = setting([], "comparisons; all that count must hold")

    def __post_init__(self) -> None:
        for name in ("title", "where", "says"):
            if not getattr(self, name).strip():
                raise ConfigError(name, "is missing")
        if not any(part.counts for part in self.parts):
            raise ConfigError("parts", "has no comparison that counts")


@dataclass
class _File:
    title: str = setting("", "of the paper or the study")
    source: str = setting("", "where it was published")
    roles: dict[str, Any] = setting({}, "treatment and control")
    rules: Rules = setting(Rules(), "how verdicts are reached")
    claims: dict[str, Any] = setting({}, "by id")


@dataclass
class Claims:
    """A checked claims file. ``measures[id][i]`` is the measure of part i of claim id."""
    path: Path
    sha256: str
    title: str
    source: str
    roles: dict[str, Role]
    rules: Rules
    claims: dict[str, Claim]
    measures: dict[str, list[Measure]]

    @property
    def labels(self) -> dict[str, str]:
        """Names of curiosities, as far as the roles are told apart by them."""
        return {str(r.where["curiosity"]): r.label for r in self.roles.values() if set(r.where) == {"curiosity"}}


def load_claims(name: str) -> Claims:
    """The claims file of this name or path. Raises ConfigError naming file, claim and field."""
    import yaml
    path = claims_path(name)
    data = path.read_bytes()
    try:
        content = yaml.safe_load(data.decode())
    except (yaml.YAMLError, UnicodeDecodeError) as cause:
        raise ConfigError(str(path.name), f"is no readable YAML: {cause}") from None
    where = path.name
    file = build(_File, content, where)
    if not file.claims:
        raise ConfigError(f"{where}.claims", "there are none")
    roles = _roles(file.roles, where)
    load_all()
    claims, measures = {}, {}
    for key, node in file.claims.items():
        place = f"{where}.{key}"
        claims[str(key)] = claim = build(Claim, node, place)
        measures[str(key)] = [_measure(part, f"{place}.parts[{i}]") for i, part in enumerate(claim.parts)]
        used = {r for part in claim.parts for r in (ROLES if part.test in ("paired", "not_lower") else (part.role,))}
        for role in sorted(used - set(roles)):
            raise ConfigError(f"{place}", f"compares the role '{role}', which roles does not name")
    return Claims(path, hashlib.sha256(data).hexdigest(), file.title or path.stem, file.source, roles, file.rules,
                  claims, measures)


def _roles(node: Mapping[str, Any], where: str) -> dict[str, Role]:
    for name in node:
        if name not in ROLES:
            raise ConfigError(f"{where}.roles.{name}", "no such role", nearest(str(name), ROLES))
    roles = {name: build(Role, value, f"{where}.roles.{name}") for name, value in node.items()}
    for name, role in roles.items():
        if not role.where:
            raise ConfigError(f"{where}.roles.{name}.where", "is missing", "Write where: {curiosity: litman}")
        for told_by in role.where:
            _check_setting(str(told_by), f"{where}.roles.{name}.where")
        role.label = role.label or name
    if "treatment" not in roles:
        raise ConfigError(f"{where}.roles", "names no treatment")
    return roles


def _check_setting(name: str, where: str) -> None:
    """Can runs be told apart by this: a setting, a variant, or a group of files such as generation?"""
    if name == "variant" or (config_homes(name) and name not in GROUPS):
        return
    try:
        check_path(name)
    except ConfigError as error:
        raise ConfigError(f"{where}.{name}", error.problem, error.hint) from None


def _measure(part: Part, where: str) -> Measure:
    node = {"name": part.measure} if isinstance(part.measure, str) else part.measure
    measure: Measure = registry.make("measure", node, None, f"{where}.measure")
    if measure.unit != part.unit:
        raise ConfigError(f"{where}.unit", f"is '{part.unit}', but the measure '{node['name']}' is in "
                          f"'{measure.unit}'")
    if part.test == "permutation" and not isinstance(measure, Permuted):
        raise ConfigError(f"{where}.test", f"the measure '{node['name']}' has no permutation test (no method null)")
    return measure
