"""Configs as flat texts, so that settings of any type can be compared, sorted and shown."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any


def dig(node: Any, name: str) -> Any:
    """A setting by its dotted name; None if there is none."""
    for part in name.split(".") if name else ():
        node = node.get(part) if isinstance(node, Mapping) else None
    return node


def flatten(node: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Every setting by its dotted name."""
    flat = {}
    for name, value in node.items():
        if isinstance(value, Mapping) and value:
            flat.update(flatten(value, f"{prefix}{name}."))
        else:
            flat[f"{prefix}{name}"] = value
    return flat


def text(value: Any) -> str:
    """A setting's value as one text, so that values of any type can be compared, sorted and shown."""
    if isinstance(value, float) and value == int(value) and abs(value) < 1e15:
        value = int(value)
    return value if isinstance(value, str) else json.dumps(value, default=str)


def natural(value: str) -> tuple[Any, ...]:
    """Numbers by size before words by letter; numbers within words by size."""
    try:
        return (0, float(value), ())
    except ValueError:
        return (1, 0.0, tuple(int(part) if i % 2 else part for i, part in enumerate(re.split(r"(\d+)", value))))
