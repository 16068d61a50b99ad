"""Texts of parts in compiled code: words that are only compared, each a number."""

from __future__ import annotations

import operator
from typing import Any
from zlib import crc32

from llvmlite import ir
from numba import types
from numba.core.typeconv import Conversion
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import intrinsic, lower_builtin, lower_cast, models, register_model


def code(word: str) -> int:
    """What stands for a word in compiled code, where words are only compared."""
    return crc32(word.encode())


class Word(types.Type):
    """A text, by its code."""
    bitwidth = -1  # by which numba sorts the types that it makes one of: a word comes before None

    def __init__(self) -> None:
        super().__init__("word")

    def unify(self, context: Any, other: Any) -> types.Type | None:
        """A text that stands in the code is a word where another way gives one; so is a word or nothing."""
        if isinstance(other, types.Optional):
            return other if isinstance(other.type, (Word, types.StringLiteral)) else None
        return self if isinstance(other, types.StringLiteral) else None

    def can_convert_from(self, context: Any, other: Any) -> Any:
        return Conversion.safe if isinstance(other, types.StringLiteral) else None


WORD = Word()
PLAIN: dict[Any, types.Type] = {bool: types.boolean, int: types.int64, float: types.float64, str: WORD}


@register_model(Word)
class _WordModel(models.PrimitiveModel):
    def __init__(self, manager: Any, of: Any):
        super().__init__(manager, of, ir.IntType(64))


@intrinsic
def word_code(_: Any, word: Any) -> Any:
    """The code of a word."""
    return types.int64(WORD), lambda context, builder, signature, args: args[0]


@intrinsic
def as_word(_: Any, number: Any) -> Any:
    """The word of a code."""
    return WORD(number), lambda context, builder, signature, args: args[0]


@lower_cast(types.StringLiteral, Word)
def _literal(context: Any, builder: Any, text: Any, word: Any, value: Any) -> Any:
    return ir.Constant(ir.IntType(64), code(text.literal_value))


class _Comparison(AbstractTemplate):
    """Two words, or one and a text that stands in the code."""

    def generic(self, args: Any, kws: Any) -> Any:
        words = [type(arg) for arg in args if isinstance(arg, (Word, types.StringLiteral))]
        return signature(types.boolean, WORD, WORD) if len(words) == 2 and Word in words else None


for _operator, _sign in ((operator.eq, "=="), (operator.ne, "!=")):
    infer_global(_operator)(type("Comparison", (_Comparison,), {}))

    @lower_builtin(_operator, Word, Word)
    def _compare(context: Any, builder: Any, of: Any, args: Any, sign: str = _sign) -> Any:
        return builder.icmp_unsigned(sign, *args)
