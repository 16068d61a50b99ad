"""The multiverse: a balanced fraction of all combinations of how the paper's open points may be read.

``design(64, seed=0)`` is a list of overrides, one mapping a reading, e.g. {"reading.crash": "contact", ...}. Each level
of a point is used equally often (give or take one), and the levels of any two points meet as evenly as a seeded search
finds, so that main effects can be told apart.
"""

from __future__ import annotations

import dataclasses
import itertools
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from attnlab.config import check_path
from attnlab.errors import ConfigError, nearest
from attnlab.groups import GROUPS
from attnlab.loading import named_file
from attnlab.reading import Reading
from attnlab.settings import build

DEFAULT = "dinocera2014"
Factors = dict[str, dict[str, dict[str, Any]]]  # point -> level -> overrides
Files = str | Path | Sequence[str | Path]  # by name or path


def load_factors(names: Files = DEFAULT) -> Factors:
    """The open points and their levels, of the file of this name or path, or of several. Raises ConfigError."""
    found: Factors = {}
    set_by: dict[str, str] = {}
    for name in [names] if isinstance(names, (str, Path)) else names:
        for point, levels in _of_file(str(name), set_by).items():
            if point in found:
                raise ConfigError("variants.factors", f"'{point}' is a factor of two of these files", "Call one "
                                  "otherwise")
            found[point] = levels
    return found


def _of_file(name: str, set_by: dict[str, str]) -> Factors:
    """The factors of one file; ``set_by``: the factor by which each setting is set already."""
    import yaml
    path = named_file("multiverse", name, "variants.factors")
    try:
        content = yaml.safe_load(path.read_text())
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as cause:
        raise ConfigError(path.name, f"cannot be read: {cause}") from None
    if not isinstance(content, Mapping) or not content:
        raise ConfigError(path.name, "expected open points by name")
    for point, levels in content.items():
        if not isinstance(levels, Mapping) or len(levels) < 2:
            raise ConfigError(f"{path.name}.{point}", "needs two levels or more")
        if len({tuple(sorted(level)) if isinstance(level, Mapping) else None for level in levels.values()}) != 1:
            raise ConfigError(f"{path.name}.{point}", "its levels must set the same settings")
        for level, overrides in levels.items():
            for setting in overrides:
                _check(str(setting), f"{path.name}.{point}.{level}")
                if set_by.setdefault(str(setting), str(point)) != point:
                    raise ConfigError(f"{path.name}.{point}", f"sets {setting}, and so does {set_by[setting]}",
                                      "Two factors that set one setting contradict each other")
    return {str(point): {str(level): dict(of) for level, of in levels.items()} for point, levels in content.items()}


def _check(setting: str, where: str) -> None:
    """Is this a setting of the reading, or another of a run? Raises ConfigError."""
    known = {f"reading.{field.name}" for field in dataclasses.fields(Reading)}
    if setting.startswith("reading.") or "." not in setting:
        if setting not in known and setting not in GROUPS:
            raise ConfigError(where, f"no setting is called '{setting}'", nearest(setting, known))
        return
    try:
        check_path(setting)
    except ConfigError as error:
        raise ConfigError(where, f"no setting is called '{setting}'", error.hint) from None


def design(size: int = 64, seed: int = 0, factors: Files = DEFAULT) -> list[dict[str, Any]]:
    """``size`` readings as overrides of the config, all of them valid. Raises ConfigError naming what is not."""
    points = load_factors(factors)
    return [overrides_of(points, levels) for levels in design_levels(points, size, seed)]


def design_levels(points: Factors, size: int, seed: int) -> list[dict[str, str]]:
    """``size`` readings as the level of each factor, all of them valid. Raises ConfigError naming what is not."""
    if size < 2:
        raise ConfigError("multiverse.size", f"is {size}, must be at least 2")
    table = balanced([len(levels) for levels in points.values()], size, seed)
    found = [{point: list(levels)[level] for (point, levels), level in zip(points.items(), row, strict=True)}
             for row in table]
    for levels in found:
        try:
            _build(points, levels)
        except ConfigError as error:
            raise _contradiction(points, levels) or error from None
    return found


def overrides_of(points: Factors, levels: Mapping[str, str]) -> dict[str, Any]:
    """The settings for which these levels stand."""
    return {setting: value for point, level in levels.items() for setting, value in points[point][level].items()}


def _build(points: Factors, levels: Mapping[str, str]) -> None:
    """Raise ConfigError unless these levels make a reading, all else at its default."""
    build(Reading, {name.removeprefix("reading."): value for name, value in overrides_of(points, levels).items()
                    if name.startswith("reading.")}, "reading")


def _contradiction(points: Factors, levels: Mapping[str, str]) -> ConfigError | None:
    """The error for the first two levels that are no reading together; None if one alone is none."""
    for number in (1, 2):
        for some in itertools.combinations(levels, number):
            try:
                _build(points, {point: levels[point] for point in some})
            except ConfigError as error:
                if number == 1:
                    return None
                one, other = (f"{point}={levels[point]}" for point in some)
                return ConfigError("variants.factors", f"{one} and {other} contradict each other: {error}",
                                   "Every combination of levels must be a reading")
    return None


def balanced(levels: list[int], size: int, seed: int, proposals: int = 30_000) -> np.ndarray:
    """A design of shape (size, factors) with entries 0..levels-1: every column balanced, pairs as even as found.

    Two entries of a column are exchanged whenever that lowers the sum of squared deviations of all pair counts from
    evenness; ``proposals`` such exchanges are tried.
    """
    rng = np.random.default_rng([seed, size, *levels])
    columns = len(levels)
    start = np.concatenate([[0], np.cumsum(levels)[:-1]])
    table = np.column_stack([rng.permutation(np.arange(size) % count) for count in levels])
    codes = table + start  # each level of each factor has a number of its own
    pairs = np.zeros((sum(levels), sum(levels)))
    for row in codes:
        pairs[np.ix_(row, row)] += 1
    even = size / np.outer(np.repeat(levels, levels), np.repeat(levels, levels))
    off = pairs - even
    others = [np.array([k for k in range(columns) if k != j], int) for j in range(columns)]
    draws = np.column_stack([rng.integers(0, columns, proposals), rng.integers(0, size, (proposals, 2))])
    for j, r, s in draws:
        a, b = codes[r, j], codes[s, j]
        if a == b:
            continue
        at_r, at_s = codes[r, others[j]], codes[s, others[j]]
        apart = at_r != at_s
        at_r, at_s = at_r[apart], at_s[apart]
        # moving a from row r to row s, and b back: squares change by 2 x + 1 or -2 x + 1
        change = 2 * (off[b, at_r] - off[a, at_r] + off[a, at_s] - off[b, at_s]).sum() + 4 * len(at_r)
        if change < 0:
            for one, where, by in ((a, at_r, -1), (b, at_r, 1), (a, at_s, 1), (b, at_s, -1)):
                off[one, where] += by
                off[where, one] += by
            codes[r, j], codes[s, j] = b, a
    found: np.ndarray = codes - start
    return found


def imbalance(table: np.ndarray) -> float:
    """How uneven the worst pair of columns is: largest deviation of a pair's count from its even share, in rows."""
    worst = 0.0
    for i, j in itertools.combinations(range(table.shape[1]), 2):
        counts = crossed(table[:, i], table[:, j])
        worst = max(worst, float(abs(counts - len(table) / counts.size).max()))
    return worst


def crossed(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """How often each level (0, 1, ...) of one column meets each of another, shape (levels, levels)."""
    counts = np.zeros((one.max() + 1, other.max() + 1))
    np.add.at(counts, (one, other), 1)
    return counts


def confounded(table: np.ndarray) -> tuple[int, int, float]:
    """(i, j, V): the two columns of which one tells most of the other, by Cramer's V, 0 (nothing) to 1 (all)."""
    worst = (0, 0, 0.0)
    for i, j in itertools.combinations(range(table.shape[1]), 2):
        counts = crossed(table[:, i], table[:, j])
        counts = counts[counts.any(axis=1)][:, counts.any(axis=0)]  # the levels that are there
        expected = np.outer(counts.sum(axis=1), counts.sum(axis=0)) / len(table)
        most = len(table) * (min(counts.shape) - 1)
        found = float(np.sqrt(((counts - expected) ** 2 / expected).sum() / most)) if most else 0.0
        worst = max(worst, (i, j, found), key=lambda pair: pair[2])
    return worst
