"""Objects laid out for compiled code: what they hold is copied in, and back."""

from __future__ import annotations

import typing
from collections.abc import Callable, Collection, Sequence
from random import Random
from types import FunctionType
from typing import Any

import numpy as np
from numba import types

from attnlab.compiled.fields import are, hints, is_frozen, names, own
from attnlab.compiled.kinds import ARRAYS, FLOATS, PAIR, WHOLES, OneOf, Reference, Row
from attnlab.compiled.methods import class_of, one_of, source_of
from attnlab.compiled.words import PLAIN, WORD, code
from attnlab.curiosity.base import Curiosity
from attnlab.exploration.base import Exploration
from attnlab.worlds.base import Layout as WorldLayout

PAIRS = (tuple[float, float] | None,)
HELD = (Exploration | None,)  # a part that keeps the exploration it was given; before that it holds the first
Fields = dict[str, tuple[types.Type, Any]]  # name -> (kind, value)


class Memory:
    """Objects in memory: every one that is reached from those that are placed, each once; ``explorations`` are placed
    at once, and ``exploration`` is their kind.

    ``left_out``: fields that have no place, with what they hold, for messages.
    """

    def __init__(self, explorations: Sequence[Exploration]):
        self._fields: dict[int, Fields] = {}
        self._kinds: dict[str, Reference] = {}
        self._slots: dict[int, np.ndarray] = {}
        self._arrays: dict[tuple[int, str], np.ndarray] = {}
        self._lists: dict[int, tuple[list[Any], np.ndarray]] = {}  # by id: a list that several hold is one array
        self._placed: dict[int, tuple[Any, Reference]] = {}
        self._keep: list[Any] = []
        self._open: set[int] = set()  # being described
        self.left_out: dict[str, str] = {}
        self._explorations = explorations
        self.exploration = one_of(tuple(dict.fromkeys(self.place(one)[0] for one in explorations)))

    def place(self, thing: Any) -> tuple[Reference, int]:
        """The kind of an object and its address."""
        kind = self._kind(type(thing), self._describe(thing))
        return kind, self._address(thing, kind)

    def push(self, thing: Any) -> None:
        """What the object holds now into its slots."""
        for name in self._placed[id(thing)][1].layout:
            if name in own(thing):
                self.write(thing, name)

    def write(self, thing: Any, name: str) -> None:
        """One field of it."""
        kind = self._placed[id(thing)][1]
        self._write(thing, name, kind.layout[name], getattr(thing, name), self._slots[id(thing)], kind.slots[name])

    def address(self, thing: Any) -> int:
        """Where an object that was placed is."""
        return int(self._slots[id(thing)].ctypes.data)

    def pull(self, thing: Any, fields: Collection[str] | None = None) -> None:
        """What its slots hold now into the object (those of these ``fields``): numbers and lists of numbers; words and
        references stay."""
        kind, slots = self._placed[id(thing)][1], self._slots[id(thing)]
        if isinstance(thing, Random):
            words = self._arrays[id(thing), "state"].tolist()
            thing.setstate((3, (*words, int(slots[kind.slots["at"]])), None))
            return
        for name in fields or [name for name in own(thing) if name in kind.layout]:
            of, at = kind.layout[name], kind.slots[name]
            if of is types.float64:
                setattr(thing, name, float(slots.view(np.float64)[at]))
            elif of is types.int64:
                setattr(thing, name, int(slots[at]))
            elif of is types.boolean:
                setattr(thing, name, bool(slots[at]))
            elif of == PAIR:
                setattr(thing, name, tuple(slots.view(np.float64)[at + 1:at + 3].tolist()) if slots[at] else None)
            elif isinstance(of, types.Array) and isinstance(held := getattr(thing, name), list) and not are(held, str):
                found = self._arrays[id(thing), name]
                held[:] = (found != 0 if are(held, bool) else found).tolist()

    def reader(self, thing: Any, fields: Collection[str]) -> Callable[[], None]:
        """What pulls these fields whenever it is called, the numbers among them without a detour."""
        kind, slots = self._placed[id(thing)][1], self._slots[id(thing)]
        views: dict[Any, Any] = {types.float64: slots.view(np.float64).data, types.int64: slots.data}
        numbers = [(name, views[kind.layout[name]], kind.slots[name]) for name in fields if kind.layout[name] in views]
        others = [name for name in fields if kind.layout[name] not in views]

        def read() -> None:
            for name, view, at in numbers:
                setattr(thing, name, view[at])
            if others:
                self.pull(thing, others)
        return read

    def pull_all(self) -> None:
        """Every object as it is in memory now."""
        for thing, _ in list(self._placed.values()):
            if not is_frozen(type(thing)):
                self.pull(thing)

    def _describe(self, thing: Any) -> Fields:
        if id(thing) in self._fields:
            return self._fields[id(thing)]
        self._keep.append(thing)
        fields: Fields = {}
        if isinstance(thing, Random):
            state = thing.getstate()[1]
            fields |= {"state": (WHOLES, list(state[:-1])), "at": (types.int64, state[-1])}
            self._fields[id(thing)] = fields
            return fields
        if id(thing) in self._open:
            raise _Unfit("refers back to itself")
        self._open.add(id(thing))
        for name in names(thing):
            try:
                value = getattr(thing, name)
                fields[name] = self._kind_of(thing, name, value), value
            except _Unfit as why:
                self.left_out[f"{type(thing).__name__}.{name}"] = str(why)
        if isinstance(thing, Curiosity):  # what memory() makes, to be copied where a fresh one is asked for
            fresh = thing.memory()
            try:
                fields["_fresh"] = self._kind_of(thing, "memory", fresh), fresh
            except _Unfit as why:
                self.left_out[f"{type(thing).__name__}.memory()"] = str(why)
        self._fields[id(thing)] = fields
        return fields

    def _kind_of(self, thing: Any, name: str, value: Any) -> types.Type:
        if type(value) in PLAIN:
            return PLAIN[type(value)]
        if isinstance(value, np.ndarray):
            if (value.dtype, value.ndim) in ARRAYS and value.flags.c_contiguous:
                return ARRAYS[value.dtype, value.ndim]
            raise _Unfit(f"an array of {value.dtype}")
        pair = value is None or (isinstance(value, tuple) and len(value) == 2 and are(value, float))
        if pair and hints(type(thing)).get(name) in PAIRS:
            return PAIR
        if hints(type(thing)).get(name) in HELD:
            return self.exploration
        if type(value) in (list, tuple):
            said = typing.get_args(hints(type(thing)).get(name))
            return self._kind_of_list(value) if value else self._kind_of_empty(*said[:1])
        if isinstance(value, WorldLayout):
            raise _Unfit("the plan of the world, which nobody asks while a robot moves")
        if type(value).__module__.split(".")[0] == "attnlab" or isinstance(value, Random):
            if isinstance(value, (FunctionType, type)):
                raise _Unfit("a function or class")
            return self._kind(type(value), self._describe(value))
        raise _Unfit(f"of type {type(value).__name__}")

    def _kind_of_empty(self, of: Any = None) -> types.Type:
        """Of a list that is said to hold such things; objects by what is said of their fields."""
        if of not in PLAIN and not is_frozen(of):
            raise _Unfit("an empty list, of nobody knows what")
        fields: Fields = {name: (PLAIN[kind], None) for name, kind in hints(of).items() if kind in PLAIN}
        return FLOATS if of is float else WHOLES if of in PLAIN else Row(self._kind(of, fields))

    def _kind_of_list(self, value: Any) -> types.Type:
        if are(value, int) or are(value, bool) or are(value, str):
            return WHOLES
        if all(type(item) in (int, float) for item in value):
            return FLOATS
        if are(value, list) and all(value) and len({len(row) for row in value}) == 1 and not are(value[0], str):
            inner = [self._kind_of_list(row) for row in value]
            dims = {kind.ndim if isinstance(kind, types.Array) else 0 for kind in inner}
            of = np.dtype("f8" if any(getattr(kind, "dtype", None) is types.float64 for kind in inner) else "i8")
            if len(dims) == 1 and (of, 1 + max(dims)) in ARRAYS and 0 not in dims:
                return ARRAYS[of, 1 + max(dims)]
        if all(type(item).__module__.split(".")[0] == "attnlab" and not isinstance(item, tuple) for item in value):
            kinds = self._merge(value)
            return Row(kinds[0] if len(kinds) == 1 else one_of(kinds))
        raise _Unfit("a list of unlike things")

    def _merge(self, things: Any) -> tuple[Reference, ...]:
        """Kinds of the objects of a row. Those of one class are given one, with fields that refer to one of several
        classes where theirs differ."""
        for source in {source_of(type(thing)) for thing in things}:
            same = [thing for thing in things if source_of(type(thing)) is source]
            described = [self._describe(thing) for thing in same]
            for name in dict.fromkeys(name for fields in described for name in fields):
                kinds = tuple(dict.fromkeys(fields[name][0] for fields in described if name in fields))
                missing = not all(name in fields for fields in described)
                if len(kinds) > 1 and all(isinstance(kind, Reference) for kind in kinds) and not missing:
                    for fields in described:
                        fields[name] = one_of(kinds), fields[name][1]  # type: ignore[arg-type]
                elif len(kinds) > 1 or missing:
                    for fields in described:
                        fields.pop(name, None)
                    self.left_out[f"{source.__name__}.{name}"] = "of unlike kinds"
        return tuple(dict.fromkeys(self._kind(type(thing), self._describe(thing)) for thing in things))

    def _kind(self, of: type, fields: Fields) -> Reference:
        layout = {name: kind for name, (kind, _) in fields.items()}
        cls = class_of(source_of(of))
        key = f"{cls.__name__} {cls.source.__module__} {layout}"
        if key not in self._kinds:
            self._kinds[key] = cls(layout)
        return self._kinds[key]

    def _address(self, thing: Any, kind: Reference) -> int:
        if id(thing) not in self._slots:
            slots = self._slots[id(thing)] = np.zeros(kind.size, np.int64)
            slots[0] = kind.number
            self._placed[id(thing)] = thing, kind
            for name, (of, value) in self._fields[id(thing)].items():
                self._write(thing, name, of, value, slots, kind.slots[name])
        return self.address(thing)

    def _write(self, thing: Any, name: str, of: types.Type, value: Any, slots: np.ndarray, at: int) -> None:
        if of is types.float64:
            slots.view(np.float64)[at] = value
        elif of is types.int64 or of is types.boolean:
            slots[at] = value
        elif of is WORD:
            slots[at] = code(value)
        elif of == PAIR:
            slots[at] = value is not None
            slots.view(np.float64)[at + 1:at + 3] = value or (0.0, 0.0)
        elif isinstance(of, types.Array):
            array = value if isinstance(value, np.ndarray) else self._array(thing, name, of, value)
            slots[at:at + 1 + of.ndim] = array.ctypes.data, *array.shape
        elif isinstance(of, Row):
            where = self._array(thing, name, WHOLES, [self.place(item)[1] for item in value])
            slots[at:at + 2] = where.ctypes.data, len(where)
        elif isinstance(of, (Reference, OneOf)):
            slots[at] = self.place(self._explorations[0] if value is None else value)[1]

    def _array(self, thing: Any, name: str, of: types.Array, value: Any) -> np.ndarray:
        """A list's array, the same one whenever it is written."""
        found = np.array([code(word) for word in value] if are(value, str) else value,
                         np.float64 if of.dtype is types.float64 else np.int64)
        if (id(thing), name) not in self._arrays:
            self._arrays[id(thing), name] = self._lists.setdefault(id(value), (value, found))[1]
        kept = self._arrays[id(thing), name]
        kept[...] = found
        return kept


class _Unfit(Exception):
    """A field that compiled code has no kind for."""
