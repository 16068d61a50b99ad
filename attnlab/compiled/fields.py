"""What an object holds, by name."""

from __future__ import annotations

import dataclasses
import typing
from functools import cached_property
from typing import Any


def is_frozen(cls: type) -> bool:
    """A dataclass whose objects do not change?"""
    return dataclasses.is_dataclass(cls) and bool(cls.__dataclass_params__.frozen)  # type: ignore[attr-defined]


def are(values: Any, of: type) -> bool:
    """Some values, and all of this very type?"""
    return len(values) > 0 and all(type(value) is of for value in values)


def own(thing: Any) -> list[str]:
    """Attributes of the object itself."""
    slots = [name for cls in type(thing).__mro__ for name in getattr(cls, "__slots__", ()) if hasattr(thing, name)]
    return [*getattr(thing, "__dict__", ()), *slots]


def names(thing: Any) -> list[str]:
    """Attributes that hold something: the object's own, its classes', and what a frozen dataclass computes."""
    found = dict.fromkeys(own(thing))
    for cls in type(thing).__mro__[:-1]:
        for name, value in vars(cls).items():
            computed = isinstance(value, (property, cached_property)) and is_frozen(cls)
            if computed or not (name.startswith("__") or callable(value) or hasattr(value, "__get__")):
                found.setdefault(name)
    return [name for name in found if not name.startswith("_abc_")]


def hints(cls: type) -> dict[str, Any]:
    """Types that the class says its attributes have."""
    if cls not in _hints:
        try:
            _hints[cls] = typing.get_type_hints(cls)
        except Exception:  # noqa: BLE001  names that exist for type checkers alone
            _hints[cls] = {}
    return _hints[cls]


_hints: dict[type, dict[str, Any]] = {}
