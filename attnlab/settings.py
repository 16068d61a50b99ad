"""From a composed config to typed, checked dataclasses, with errors that name the setting and the nearest right name.

Parts declare their parameters as dataclass fields made by :func:`setting`. Composing checks nothing about ranges and
lets ``+any.thing=1`` through, so everything passes here, for every run of a sweep, before the first run starts.
"""

from __future__ import annotations

import copy
import dataclasses
import math
import types
import typing
from collections.abc import Mapping
from functools import cache
from typing import TYPE_CHECKING, Any, Literal, TypeVar

from attnlab.errors import ConfigError, nearest

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

Settings = TypeVar("Settings", bound="DataclassInstance")


def setting(default: Any, doc: str, *, unit: str = "", low: float | None = None, high: float | None = None,
            above: float | None = None, cosmetic: bool = False, late: bool = False) -> Any:
    """A dataclass field with its meaning, unit and range (``low``/``high`` inclusive, ``above`` exclusive).
    ``cosmetic``: it changes no number of a run. ``late``: at its default a run is what it was before there was this
    setting, so that it is in no key (of the top, ``reading``, ``validation``, and parts of which there is one)."""
    meta = {"doc": doc, "unit": unit, "low": low, "high": high, "above": above, "cosmetic": cosmetic, "late": late}
    if isinstance(default, (list, dict)) or dataclasses.is_dataclass(default):
        return dataclasses.field(default_factory=lambda: copy.copy(default), metadata=meta)
    return dataclasses.field(default=default, metadata=meta)


def cosmetics(cls: type) -> frozenset[str]:
    """Names of the settings of a dataclass that change no number."""
    return frozenset(field.name for field in dataclasses.fields(cls) if field.metadata.get("cosmetic"))


def without_late(cls: type | None, node: Any) -> Any:
    """The settings of dataclass ``cls``, if there is one, in a config, without late ones that are at their defaults."""
    if cls is None:
        return node
    late = {field.name: field.default for field in dataclasses.fields(cls) if field.metadata.get("late")}
    return {name: value for name, value in node.items() if name not in late or value != late[name]} \
        if isinstance(node, Mapping) else node


def defaults_of(cls: type) -> dict[str, Any]:
    """The dataclass's defaults as a plain mapping, as stored in the config."""
    return dataclasses.asdict(cls())


def build(cls: type[Settings], node: Any, where: str) -> Settings:
    """An instance of dataclass ``cls`` from the mapping ``node``; raises :class:`ConfigError` naming ``where``."""
    if not isinstance(node, Mapping):
        raise ConfigError(where, f"expected settings by name, got {_shown(node)}")
    fields = {field.name: field for field in dataclasses.fields(cls)}
    for key in node:
        if key not in fields:
            known = nearest(str(key), fields) if fields else "It takes no settings"
            raise ConfigError(f"{where}.{key}" if where else str(key), "no such setting", known)
    hints = hints_of(cls)
    values = {}
    for key, value in node.items():
        path = f"{where}.{key}" if where else key
        values[key] = convert(value, hints[key], path)
        _check_range(values[key], fields[key].metadata, path)
    try:
        return cls(**values)
    except ConfigError as error:
        inner = error.setting
        setting = ".".join(name for name in (where, inner) if name)
        raise ConfigError(setting, error.problem, error.hint) from None


@cache
def hints_of(cls: type) -> dict[str, Any]:
    """The types of a dataclass's fields."""
    return typing.get_type_hints(cls)


def choices_of(hint: Any) -> tuple[Any, ...]:
    """The values that a setting of this type may have if it names them (``Literal``, also within a union or a list),
    else ()."""
    args = typing.get_args(hint)
    if typing.get_origin(hint) is Literal:
        return args
    return next(filter(None, map(choices_of, args)), ())


def convert(value: Any, kind: Any, where: str) -> Any:
    """``value`` as type ``kind``, or a ConfigError. Whole floats (1e3) pass as whole numbers, 1 as 1.0."""
    origin, args = typing.get_origin(kind), typing.get_args(kind)
    if kind is Any:
        return value
    if origin in (types.UnionType, typing.Union):
        if value is None and type(None) in args:
            return None
        return convert(value, next(arg for arg in args if arg is not type(None)), where)
    if origin is Literal:
        named = convert(value, type(args[0]), where)
        if named not in args:
            raise ConfigError(where, f"'{named}' is not one of its values", nearest(named, map(str, args)))
        return named
    if origin is list:
        if not isinstance(value, (list, tuple)):
            raise ConfigError(where, f"expected a list, got {_shown(value)}", "Write it as [a,b]")
        return [convert(item, args[0], f"{where}[{i}]") for i, item in enumerate(value)]
    if origin is dict or kind is dict:
        if not isinstance(value, Mapping):
            raise ConfigError(where, f"expected settings by name, got {_shown(value)}")
        return dict(value)
    if isinstance(kind, type) and dataclasses.is_dataclass(kind):
        return build(kind, value, where)
    if kind is bool and isinstance(value, bool):
        return value
    if kind is int and isinstance(value, (int, float)) and not isinstance(value, bool) and _whole(value):
        return int(value)
    if kind is float and isinstance(value, (int, float)) and not isinstance(value, bool):
        if not math.isfinite(value):
            raise ConfigError(where, f"expected a finite number, got {value}")
        return float(value)
    if kind is str and isinstance(value, (str, int, float)) and not isinstance(value, bool):
        return str(value)
    names = {int: "a whole number", float: "a number", bool: "true or false", str: "a word"}
    raise ConfigError(where, f"expected {names.get(kind, kind)}, got {_shown(value)}")


def _shown(value: Any) -> str:
    """A value within a line of text."""
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def _whole(value: float) -> bool:
    return math.isfinite(value) and value == int(value)


def _check_range(value: Any, meta: Mapping[str, Any], where: str) -> None:
    for item in value if isinstance(value, list) else [value]:
        if not isinstance(item, (int, float)) or isinstance(item, bool):
            continue
        unit = f" {meta['unit']}" if meta.get("unit") else ""
        if meta.get("low") is not None and item < meta["low"]:
            raise ConfigError(where, f"is {item}{unit}, must be at least {meta['low']}{unit}")
        if meta.get("above") is not None and item <= meta["above"]:
            raise ConfigError(where, f"is {item}{unit}, must be more than {meta['above']}{unit}")
        if meta.get("high") is not None and item > meta["high"]:
            raise ConfigError(where, f"is {item}{unit}, must be at most {meta['high']}{unit}")
