"""The multiverse: a balanced fraction of all combinations of how the paper's open points may be read.

``design(64, seed=0)`` is a list of overrides, one mapping a reading, e.g. {"reading.crash": "contact", ...}. Each level
of a point is used equally often (give or take one), and the levels of any two points meet as evenly as a seeded search
finds, so that main effects can be told apart.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
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


def load_factors(name: str | Path = DEFAULT) -> Factors:
    """The open points and their levels, of the file of this name or path. Raises ConfigError."""
    import yaml
    path = named_file("multiverse", str(name), "variants.factors")
    try:
        content = yaml.safe_load(path.read_text())
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as cause:
        raise ConfigError(path.name, f"cannot be read: {cause}") from None
    if not isinstance(content, Mapping) or not content:
        raise ConfigError(path.name, "expected open points by name")
    set_by: dict[str, str] = {}
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


def design(size: int = 64, seed: int = 0, factors: str | Path = DEFAULT) -> list[dict[str, Any]]:
    """``size`` readings as overrides of the config, all of them valid. Raises ConfigError naming what is not."""
    points = load_factors(factors)
    if size < 2:
        raise ConfigError("multiverse.size", f"is {size}, must be at least 2")
    table = balanced([len(levels) for levels in points.values()], size, seed)
    readings = []
    for row in table:
        overrides: dict[str, Any] = {}
        for levels, level in zip(points.values(), row, strict=True):
            overrides.update(list(levels.values())[level])
        build(Reading, {name.removeprefix("reading."): value for name, value in overrides.items()
                        if name.startswith("reading.")}, "reading")
        readings.append(overrides)
    return readings


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
    for i in range(table.shape[1]):
        for j in range(i):
            counts = np.zeros((table[:, i].max() + 1, table[:, j].max() + 1))
            np.add.at(counts, (table[:, i], table[:, j]), 1)
            worst = max(worst, float(abs(counts - len(table) / counts.size).max()))
    return worst
