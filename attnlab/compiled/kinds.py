"""Types of compiled fields: an object is a row of 8-byte slots, the first of which says which class it is of.

A whole number, a float, a bool, a word and a reference take a slot each; an array an address and its shape, a sequence
of objects an address and its length, a pair of floats that may be None three slots.
"""

from __future__ import annotations

from hashlib import sha256
from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.extending import models, register_model

PAIR = types.Optional(types.UniTuple(types.float64, 2))
ARRAYS = {(np.dtype(str(of)), n): types.Array(of, n, "C") for of in (types.float64, types.int64) for n in (1, 2, 3)}
FLOATS, WHOLES = (ARRAYS[np.dtype(of), 1] for of in (np.float64, np.int64))
INTEGER, DOUBLE = ir.IntType(64), ir.DoubleType()


class Reference(types.Type):
    """An object of compiled code: its class, ``layout`` the kind of each field by name, ``number`` what its first slot
    holds. It is called by a hash of both, the same in every process."""
    source: type

    def __init__(self, layout: dict[str, types.Type]):
        self.layout, self.slots, at = layout, dict[str, int](), 1
        for name, kind in layout.items():
            self.slots[name] = at
            at += width(kind)
        self.size = at
        called = f"{self.source.__module__}.{self.source.__qualname__}"
        fields = ", ".join(f"{name}: {kind}" for name, kind in layout.items())
        found = sha256(f"{called}({fields})".encode()).hexdigest()[:12]
        self.number = int(found, 16)
        super().__init__(f"{called}#{found}")


class OneOf(types.Type):
    """A reference to an object of one of several classes."""

    def __init__(self, kinds: tuple[Reference, ...]):
        self.kinds = kinds
        super().__init__(f"one of [{', '.join(map(str, kinds))}]")


class Row(types.SimpleIterableType):
    """A sequence of references of one kind."""

    def __init__(self, of: types.Type):
        self.of = of
        super().__init__(f"row of {of}", RowIterator(of))


class RowIterator(types.SimpleIteratorType):
    """Goes through a row."""

    def __init__(self, of: types.Type):
        super().__init__(f"iterator over {of}", of)


def width(kind: types.Type) -> int:
    """How many slots a field of this kind takes."""
    return 1 + kind.ndim if isinstance(kind, types.Array) else {Row: 2, types.Optional: 3}.get(type(kind), 1)


class _Address(models.PrimitiveModel):
    def __init__(self, manager: Any, of: Any):
        super().__init__(manager, of, INTEGER.as_pointer())


def by_address(kind: type[types.Type]) -> type[types.Type]:
    """Values of this type are addresses of slots."""
    register_model(kind)(_Address)
    return kind


@register_model(Row)
class _RowModel(models.StructModel):
    def __init__(self, manager: Any, of: Any):
        super().__init__(manager, of, [("address", types.intp), ("length", types.intp)])


@register_model(RowIterator)
class _RowIteratorModel(models.StructModel):
    def __init__(self, manager: Any, of: Any):
        members = [("address", types.intp), ("length", types.intp), ("at", types.EphemeralPointer(types.intp))]
        super().__init__(manager, of, members)
