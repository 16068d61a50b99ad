"""Classes in compiled code: their own methods, compiled for the fields of their objects, and functions they call."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Callable
from pathlib import Path
from types import FunctionType
from typing import Any

from numba import njit, types
from numba.core.typing.typeof import Purpose
from numba.extending import overload_attribute, overload_method, typeof_impl

from attnlab.compiled import access
from attnlab.compiled.kinds import OneOf, Reference, Row, by_address
from attnlab.kernels.compile import ONLY_COMPILED
from attnlab.paths import PACKAGE

# As Python has it: a division by zero and an index that is none are errors. They end the episode, and the run is played
# again uncompiled, which says where it was.
OPTIONS: dict[str, Any] = {"error_model": "python", "boundscheck": True}
INSIDE = {**OPTIONS, **ONLY_COMPILED}
_method: Any = overload_method  # numba's own types leave jit_options out
_attribute: Any = overload_attribute
counterparts: dict[tuple[type, str], Callable[..., Any]] = {}  # (class, method) -> what stands for it when compiled
_below: set[tuple[type, str]] = set()
_classes: dict[type, type[Reference]] = {}
_functions: dict[FunctionType, Any] = {}


def counterpart(source: type, *, also_below: bool = False) -> Callable[[FunctionType], FunctionType]:
    """Decorator: a function that stands for the method of its name of this class in compiled code; ``also_below``: and
    of the classes that inherit from it, though they have their own."""
    def keep(function: FunctionType) -> FunctionType:
        counterparts[source, function.__name__] = function
        if also_below:
            _below.add((source, function.__name__))
        return function
    return keep


def source_of(cls: type) -> type:
    """The class whose methods objects of ``cls`` have: itself, or the nearest above that has any of its own."""
    for above in cls.__mro__:
        if any(isinstance(value, FunctionType) for value in vars(above).values()) or \
                any(owner is above for owner, _ in counterparts):
            return above
    return cls


def class_of(source: type) -> type[Reference]:
    """The type of references to objects of this class."""
    if source not in _classes:
        made: type[Reference] = type(f"{source.__name__}Reference", (Reference,), {"source": source})
        by_address(made)
        for name, method in methods(source).items():
            _method(made, name, jit_options=INSIDE)(_same(method))
        _classes[source] = made
    return _classes[source]


def methods(source: type) -> dict[str, FunctionType]:
    """The methods of a class by name, counterparts in place of those that have one."""
    found: dict[str, Any] = {name: counterparts[above, name] for above, name in _below if issubclass(source, above)}
    for above in source.__mro__[:-1]:
        for name, value in vars(above).items():
            if isinstance(value, FunctionType) and not (name.startswith("__") and name.endswith("__")):
                found.setdefault(name, counterparts.get((above, name), value))
        for (owner, name), function in counterparts.items():
            if owner is above:
                found.setdefault(name, function)
    return found


def _same(method: FunctionType) -> FunctionType:
    """A function of the same arguments that returns the method, which is what numba wants to be told."""
    defaults: dict[str, Any] = {}
    arguments = []
    for i, parameter in enumerate(inspect.signature(method).parameters.values()):
        if parameter.default is not parameter.empty:
            defaults[f"default_{i}"] = parameter.default
        arguments.append(parameter.name + (f"=default_{i}" if f"default_{i}" in defaults else ""))
    space = {"__name__": __name__, "method": method, **defaults}
    exec(f"def same({', '.join(arguments)}): return method", space)
    made: FunctionType = space["same"]
    made.__annotations__ = method.__annotations__
    return made


def one_of(kinds: tuple[Reference, ...]) -> OneOf:
    """The type of references to an object of one of these kinds: a method of it is that of the object's own class."""
    key = " ".join(str(kind) for kind in kinds)
    if key not in _unions:
        cls: type[OneOf] = type("OneOfThese", (OneOf,), {})
        by_address(cls)
        takes = [access.taken_as(kind) for kind in kinds]
        shared = set.intersection(*({*methods(kind.source)} for kind in kinds))
        for name in sorted(shared):
            arguments = list(inspect.signature(methods(kinds[0].source)[name]).parameters)[1:]
            call = f"({', '.join(arguments)})"
            _method(cls, name, jit_options=INSIDE)(_choosing(kinds, takes, arguments, f".{name}", call))
        for name in sorted(set.intersection(*({*kind.layout} for kind in kinds))):
            _attribute(cls, name, jit_options=INSIDE)(_choosing(kinds, takes, [], f".{name}", ""))
        _unions[key] = cls(kinds)
    return _unions[key]


def _choosing(kinds: tuple[Reference, ...], takes: list[Any], arguments: list[str], what: str, call: str
              ) -> FunctionType:
    lines = [f"def choose({', '.join(['one', *arguments])}):", "    number = kind_number(one)"]
    for i, kind in enumerate(kinds[:-1]):
        lines += [f"    if number == {kind.number}:", f"        return take_{i}(one){what}{call}"]
    lines.append(f"    return take_{len(kinds) - 1}(one){what}{call}")
    space: dict[str, Any] = {"__name__": __name__, "kind_number": access.kind_number,
                             **{f"take_{i}": take for i, take in enumerate(takes)}}
    exec("\n".join(lines), space)
    return _same(space["choose"])


def sources(kind: types.Type) -> set[str]:
    """Files of the classes of other packages that a kind is made of."""
    found, queue, seen = set[str](), [kind], set[str]()
    while queue:
        kind = queue.pop()
        if str(kind) in seen:
            continue
        seen.add(str(kind))
        if isinstance(kind, Reference):
            queue += kind.layout.values()
            found |= {file for above in kind.source.__mro__ if (file := _file(above)) and
                      not Path(file).is_relative_to(PACKAGE)}
        queue += kind.kinds if isinstance(kind, OneOf) else [kind.of] if isinstance(kind, Row) else []
    return found


def _file(cls: type) -> str | None:
    return getattr(sys.modules.get(cls.__module__), "__file__", None) if cls.__module__ != "random" else None


def _is_ours(function: FunctionType) -> bool:
    module = str(function.__module__)
    return module.split(".")[0] in _packages and not module.startswith("attnlab.compiled")  # those are numba's own


_unions: dict[str, OneOf] = {}
_packages = {"attnlab"}


@typeof_impl.register(FunctionType)
def _plain_function(function: FunctionType, context: Any) -> Any:
    """A function that a part calls by its name is compiled with it."""
    if context.purpose is not Purpose.constant or not _is_ours(function):
        return None
    if function not in _functions:
        _functions[function] = njit(**INSIDE)(function)
    return types.Dispatcher(_functions[function])
