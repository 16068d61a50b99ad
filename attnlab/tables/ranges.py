"""Runs of numbers as people type them: 0-4,7."""

from __future__ import annotations

import re
from collections.abc import Iterable

from attnlab.errors import ConfigError

RANGED = ("seed",)  # settings in which 0-4,7 means 0,1,2,3,4,7
MOST_SEEDS = 100_000
_ITEM = re.compile(r"(\d+)(?:-(\d+))?\Z")


def seeds(key: str, text: str) -> list[int]:
    """``0-4,7`` as [0, 1, 2, 3, 4, 7]; Hydra's own ``range(0,5)`` and ``choice(...)`` are understood too."""
    inside = re.fullmatch(r"(range|choice)\(([\d,\s]*)\)", text.strip())
    if inside and inside[1] == "range":
        numbers = [int(n) for n in inside[2].split(",") if n.strip()]
        found = list(range(*numbers)) if 1 <= len(numbers) <= 3 and 0 not in numbers[2:] else []
        if not found:
            raise ConfigError(key, f"{text} is empty", f"Write {key}=0-4")
    else:
        found = []
        for item in (inside[2] if inside else text).split(","):
            found += _item(key, item.strip(), text)
            if len(found) > MOST_SEEDS:
                raise ConfigError(key, f"{text} asks for more than {MOST_SEEDS} runs")
    twice = sorted({n for n in found if found.count(n) > 1}) if len(found) < 2000 else []
    if twice:
        raise ConfigError(key, f"{text} names {twice[0]} twice", "Each seed once")
    return found


def compact(numbers: Iterable[int]) -> str:
    """The inverse of :func:`seeds`: [0, 1, 2, 7] as ``0-2,7``."""
    runs: list[list[int]] = []
    for n in numbers:
        if runs and n == runs[-1][-1] + 1:
            runs[-1].append(n)
        else:
            runs.append([n])
    return ",".join(f"{run[0]}-{run[-1]}" if len(run) > 1 else str(run[0]) for run in runs)


def _item(key: str, item: str, text: str) -> list[int]:
    if item.startswith("-") and item[1:].isdigit():
        raise ConfigError(key, f"is {item}, must be at least 0")
    match = _ITEM.match(item)
    if not match:
        raise ConfigError(key, f"'{item or text}' is not a whole number or a range", f"Write {key}=3, {key}=0-4,7")
    first, last = int(match[1]), int(match[2] if match[2] is not None else match[1])
    if last < first:
        raise ConfigError(key, f"{item} runs backwards", f"Write {key}={last}-{first}")
    if last - first > MOST_SEEDS:
        raise ConfigError(key, f"{item} asks for more than {MOST_SEEDS} runs")
    return list(range(first, last + 1))
