"""What objects hold, as JSON and back: for agents that live on, and for runs that are interrupted.

Reading it runs no code. What is there is written into objects that were made anew from the same config, field by field;
what those have and a text cannot hold (functions, classes, the world) stays as it was made. Numbers come back with all
their bits. What cannot be kept is refused by name, never left out in silence.
"""

from __future__ import annotations

import base64
import math
from collections import defaultdict, deque
from collections.abc import Iterable, Mapping
from random import Random
from types import BuiltinFunctionType, FunctionType, MethodType, ModuleType
from typing import Any

import numpy as np

from attnlab.compiled.fields import is_frozen, own

PLAIN = (bool, int, str, type(None))
CODE = (FunctionType, BuiltinFunctionType, MethodType, ModuleType, type)
NUMBERS = "biuf"  # kinds of numpy arrays that are kept


class UnkeptError(Exception):
    """Something that cannot be kept, or that has no place where it is to go; the message names it."""


def written(roots: Mapping[str, Any], leave: tuple[type, ...] = ()) -> dict[str, Any]:
    """What these objects hold, as plain data for JSON. ``leave``: types of objects that are not looked into. Raises
    :class:`UnkeptError`."""
    return _Writer(leave).mapping(roots)


def changed(now: Any, before: Any) -> Any:
    """Of what was written, what differs from what was written earlier: of an object the fields that do, and of those
    the same; anything else whole."""
    if not (isinstance(now, dict) and isinstance(before, dict) and "has" in now and now["is"] == before.get("is")):
        return now
    return {**now, "has": differing(now["has"], before["has"])}


def differing(now: Mapping[str, Any], before: Mapping[str, Any]) -> dict[str, Any]:
    """The same, of several things by name."""
    return {name: changed(value, before.get(name)) for name, value in now.items()
            if name not in before or value != before[name]}


class _Writer:
    """Goes through objects; one that comes again is written as where it came first."""

    def __init__(self, leave: tuple[type, ...]):
        self.leave, self.seen = leave, dict[int, str]()
        self.held: list[Any] = []  # so that no other object gets the place of one that was seen

    def mapping(self, things: Mapping[str, Any], path: str = "") -> dict[str, Any]:
        return {name: self.value(thing, f"{path}.{name}" if path else name) for name, thing in things.items()}

    def value(self, thing: Any, path: str) -> Any:
        kind = type(thing)
        if kind in PLAIN:
            return thing
        if kind is float:
            return thing if math.isfinite(thing) else {"float": repr(thing)}
        if isinstance(thing, (*CODE, *self.leave)):
            return {"made": named(thing if isinstance(thing, CODE) else kind)}
        if isinstance(thing, np.generic):
            return {"number": kind.__name__, "value": self.value(thing.item(), path)}
        if kind is tuple:
            return {"tuple": self.items(thing, path)}
        if id(thing) in self.seen:
            return {"same": self.seen[id(thing)]}
        self.seen[id(thing)] = path
        self.held.append(thing)
        if kind is list:
            return self.items(thing, path)
        if kind in (dict, defaultdict):
            if all(type(key) is str for key in thing):
                return {"dict": self.mapping(thing, path)}
            return {"pairs": [[self.value(key, path), self.value(value, f"{path}.{key}")]
                              for key, value in thing.items()]}
        if kind in (set, frozenset):
            return {kind.__name__: sorted((self.value(item, path) for item in thing), key=repr)}
        if kind is deque:
            return {"deque": self.items(list(thing), path), "most": thing.maxlen}
        if kind is Random:
            _, words, gauss = thing.getstate()
            return {"random": _packed(words), "gauss": gauss}
        if kind is np.ndarray and thing.dtype.kind in NUMBERS:
            return {"array": thing.dtype.str, "shape": list(thing.shape), "values": self.items(
                thing.ravel().tolist(), path)}
        if kind is np.random.Generator:
            return {"generator": self.value(thing.bit_generator.state, path)}
        return self.object(thing, path)

    def items(self, things: Iterable[Any], path: str) -> list[Any]:
        things = list(things)
        kinds = set(map(type, things))
        if kinds <= set(PLAIN) or (kinds <= {*PLAIN, float} and
                                   all(math.isfinite(x) for x in things if type(x) is float)):
            return things
        return [self.value(thing, f"{path}.{i}") for i, thing in enumerate(things)]

    def object(self, thing: Any, path: str) -> dict[str, Any]:
        cls = type(thing)
        if not _is_open(thing):
            raise UnkeptError(f"{path} is a {named(cls)}, which cannot be written down")
        fields = {name: getattr(thing, name) for name in own(thing)}
        if is_frozen(cls):  # settings and the like; what they point to may change
            fields = {name: value for name, value in fields.items() if type(value) not in (*PLAIN, float)}
        return {"is": named(cls), "has": self.mapping(fields, path)}


def _is_open(thing: Any) -> bool:
    """Is all that an object holds in its fields? Not if its class has a way of its own to be copied, or is of C."""
    cls: Any = type(thing)
    if cls.__reduce_ex__ is not object.__reduce_ex__ or cls.__reduce__ is not object.__reduce__ or \
            getattr(cls, "__getstate__", None) is not getattr(object, "__getstate__", None):
        return False
    try:
        found = thing.__reduce_ex__(2)
    except TypeError:
        return False
    return found[3:] == (None, None) and bool(cls.__flags__ & 1 << 9)  # no list, no dict; a class that Python made


def named(thing: Any) -> str:
    """What a class, a function or a module is called: ``attnlab.learners.base:Learner``."""
    return thing.__name__ if isinstance(thing, ModuleType) else \
        f"{getattr(thing, '__module__', '')}:{getattr(thing, '__qualname__', thing)}"


def _packed(words: tuple[int, ...]) -> str:
    return base64.b64encode(np.array(words, "<u4").tobytes()).decode()
