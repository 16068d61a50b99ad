"""How compiled code reads and writes fields, goes through rows, and tells the classes of objects apart."""

from __future__ import annotations

import operator
from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.imputils import RefType, iternext_impl, lower_builtin, lower_getattr_generic, lower_setattr_generic
from numba.core.typing.templates import AttributeTemplate
from numba.extending import infer_getattr, intrinsic, overload
from numba.np import arrayobj

from attnlab.compiled.kinds import DOUBLE, INTEGER, PAIR, OneOf, Reference, Row, RowIterator, width


@infer_getattr
class _Fields(AttributeTemplate):
    key = Reference

    def generic_resolve(self, of: Reference, name: str) -> types.Type | None:
        return of.layout.get(name)


def _slot(builder: Any, value: Any, at: int, kind: Any = INTEGER) -> Any:
    """The address of a slot, as that of a number."""
    return builder.bitcast(builder.gep(value, [ir.Constant(INTEGER, at)], inbounds=True), kind.as_pointer())


@lower_getattr_generic(Reference)
def _load(context: Any, builder: Any, of: Reference, value: Any, name: str) -> Any:
    kind, at = of.layout[name], of.slots[name]
    if kind is types.float64:
        return builder.load(_slot(builder, value, at, DOUBLE))
    number = builder.load(_slot(builder, value, at))
    if kind is types.boolean:
        return builder.icmp_unsigned("!=", number, ir.Constant(INTEGER, 0))
    if isinstance(kind, (Reference, OneOf)):
        return builder.inttoptr(number, INTEGER.as_pointer())
    if isinstance(kind, types.Array):
        return _array(context, builder, kind, number, [builder.load(_slot(builder, value, at + 1 + i))
                                                       for i in range(kind.ndim)])
    if isinstance(kind, Row):
        row = cgutils.create_struct_proxy(kind)(context, builder)
        row.address, row.length = number, builder.load(_slot(builder, value, at + 1))
        return row._getvalue()
    if kind == PAIR:
        there = builder.icmp_unsigned("!=", number, ir.Constant(INTEGER, 0))
        both = [builder.load(_slot(builder, value, at + i, DOUBLE)) for i in (1, 2)]
        pair = cgutils.create_struct_proxy(kind)(context, builder)
        pair.data, pair.valid = context.make_tuple(builder, kind.type, both), there
        return pair._getvalue()
    return number


def _array(context: Any, builder: Any, kind: types.Array, address: Any, shape: list[Any]) -> Any:
    made, item = arrayobj.make_array(kind)(context, builder), ir.Constant(INTEGER, 8)
    strides = [item]
    for extent in shape[:0:-1]:
        strides.insert(0, builder.mul(extent, strides[0]))
    arrayobj.populate_array(made, data=builder.inttoptr(address, made.data.type), shape=shape, strides=strides,
                            itemsize=item, meminfo=None)
    return made._getvalue()


@lower_setattr_generic(Reference)
def _store(context: Any, builder: Any, signature: Any, args: Any, name: str) -> None:
    of, (value, new) = signature.args[0], args
    kind, at = of.layout[name], of.slots[name]
    if kind is types.float64:
        builder.store(new, _slot(builder, value, at, DOUBLE))
    elif kind is types.boolean:
        builder.store(builder.zext(new, INTEGER), _slot(builder, value, at))
    elif kind == PAIR:
        pair = cgutils.create_struct_proxy(kind)(context, builder, value=new)
        builder.store(builder.zext(pair.valid, INTEGER), _slot(builder, value, at))
        for i in (0, 1):
            builder.store(builder.extract_value(pair.data, i), _slot(builder, value, at + 1 + i, DOUBLE))
    elif isinstance(kind, Reference):  # what is held is one object; another's content becomes its own
        target = builder.inttoptr(builder.load(_slot(builder, value, at)), INTEGER.as_pointer())
        _copy(builder, kind, new, target)
    elif isinstance(kind, types.Array):  # the same of an array
        _copy_array(context, builder, kind, new, _load(context, builder, of, value, name))
    elif isinstance(kind, OneOf):  # another object from now on
        builder.store(builder.ptrtoint(new, INTEGER), _slot(builder, value, at))
    elif isinstance(kind, Row):
        raise NotImplementedError(f"{name} is set anew in compiled code; change what it holds instead")
    else:
        builder.store(new, _slot(builder, value, at))


def _copy_array(context: Any, builder: Any, kind: types.Array, source: Any, target: Any) -> None:
    one, other = (arrayobj.make_array(kind)(context, builder, value=which) for which in (target, source))
    size = builder.mul(one.nitems, ir.Constant(INTEGER, 8))
    cgutils.raw_memcpy(builder, one.data, other.data, size, 1)


def _copy(builder: Any, kind: Reference, source: Any, target: Any) -> None:
    """The content of an object into another of its kind, arrays of the same shapes included."""
    for name, inner in kind.layout.items():
        at = kind.slots[name]
        if isinstance(inner, types.Array):
            size = ir.Constant(INTEGER, 8)
            for i in range(inner.ndim):
                size = builder.mul(size, builder.load(_slot(builder, source, at + 1 + i)))
            one, other = (builder.inttoptr(builder.load(_slot(builder, which, at)), cgutils.voidptr_t)
                          for which in (target, source))
            cgutils.raw_memcpy(builder, one, other, size, 1)
        elif isinstance(inner, Reference):
            one, other = (builder.inttoptr(builder.load(_slot(builder, which, at)), INTEGER.as_pointer())
                          for which in (target, source))
            _copy(builder, inner, other, one)
        elif not isinstance(inner, (Row, OneOf)):
            for i in range(width(inner)):
                builder.store(builder.load(_slot(builder, source, at + i)), _slot(builder, target, at + i))


@lower_builtin("getiter", Row)
def _through(context: Any, builder: Any, signature: Any, args: Any) -> Any:
    row = cgutils.create_struct_proxy(signature.args[0])(context, builder, value=args[0])
    iterator = cgutils.create_struct_proxy(signature.return_type)(context, builder)
    iterator.address, iterator.length = row.address, row.length
    iterator.at = cgutils.alloca_once_value(builder, ir.Constant(INTEGER, 0))
    return iterator._getvalue()


@lower_builtin("iternext", RowIterator)
@iternext_impl(RefType.UNTRACKED)
def _next(context: Any, builder: Any, signature: Any, args: Any, result: Any) -> None:
    iterator = cgutils.create_struct_proxy(signature.args[0])(context, builder, value=args[0])
    at = builder.load(iterator.at)
    there = builder.icmp_signed("<", at, iterator.length)
    result.set_valid(there)
    with builder.if_then(there):
        addresses = builder.inttoptr(iterator.address, INTEGER.as_pointer())
        result.yield_(builder.inttoptr(builder.load(builder.gep(addresses, [at])), INTEGER.as_pointer()))
        builder.store(builder.add(at, ir.Constant(INTEGER, 1)), iterator.at)


@overload(len)
def _length(row):
    return (lambda row: row_length(row)) if isinstance(row, Row) else None


@intrinsic
def row_length(_: Any, row: Any) -> Any:
    """How many objects a row holds."""
    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return cgutils.create_struct_proxy(signature.args[0])(context, builder, value=args[0]).length
    return types.intp(row), generate


@overload(operator.getitem)
def _item(row, at):
    return (lambda row, at: row_item(row, at)) if isinstance(row, Row) else None


@intrinsic
def row_item(_: Any, row: Any, at: Any) -> Any:
    """An object of a row, by its place."""
    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        found = cgutils.create_struct_proxy(signature.args[0])(context, builder, value=args[0])
        addresses = builder.inttoptr(found.address, INTEGER.as_pointer())
        return builder.inttoptr(builder.load(builder.gep(addresses, [args[1]])), INTEGER.as_pointer())
    return row.of(row, types.intp), generate


@intrinsic
def kind_number(_: Any, one: Any) -> Any:
    """Which class an object is of: what its first slot holds."""
    return types.int64(one), lambda context, builder, signature, args: builder.load(args[0])


def taken_as(kind: Reference) -> Any:
    """An intrinsic that takes an object of several classes, or an address, for one of this kind."""
    @intrinsic
    def take(_: Any, one: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            if isinstance(signature.args[0], OneOf):
                return args[0]
            return builder.inttoptr(args[0], INTEGER.as_pointer())
        return kind(one), generate
    return take
