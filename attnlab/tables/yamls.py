"""YAML that others wrote, read without harm."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

MOST = 1_000_000  # values that a file may stand for, once its anchors are written out


def read_yaml(text: str) -> Any:
    """The content. Raises yaml.YAMLError, and ValueError for a file whose anchors stand for more than ``MOST``
    values."""
    import yaml
    content = yaml.load(text, getattr(yaml, "CSafeLoader", yaml.SafeLoader))
    if _size(content, {}) > MOST:
        raise ValueError(f"its anchors stand for more than {MOST:,} values")
    return content


def _size(node: Any, known: dict[int, float]) -> float:
    """How many values a node stands for; infinitely many if it holds itself."""
    if not isinstance(node, (Mapping, list)):
        return 1
    if id(node) not in known:
        known[id(node)] = float("inf")
        children = node.values() if isinstance(node, Mapping) else node
        known[id(node)] = 1 + sum(_size(child, known) for child in children)
    return known[id(node)]
