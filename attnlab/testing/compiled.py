"""Does a part compile, and give the same?"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from attnlab.testing.build import part_of
from attnlab.testing.common import plan_of


def first_difference(one: Mapping[str, Any], other: Mapping[str, Any]) -> str:
    """The first field of two runs' tables that is not the same, with its row and both values; empty if all are."""
    for table, columns in one.items():
        for name, values in columns.items():
            found = list(other[table][name])
            for row, value in enumerate(values):
                if row >= len(found) or repr(value) != repr(found[row]):
                    last = repr(found[row]) if row < len(found) else "nothing"
                    return f"{table}.{name}, row {row}: {value!r} interpreted, {last} compiled"
            if len(found) > len(values):
                return f"{table}.{name}: {len(values)} rows interpreted, {len(found)} compiled"
    return ""


def compiles(group: str, name: str, **settings: Any) -> Callable[[], None]:
    """A pytest function: the part compiles, and a run with it has the same tables from both engines. It takes some ten
    seconds the first time. Parts that say why they are ``interpreted`` need no such test."""
    def test() -> None:
        from attnlab.compiled.engine import Uncompilable
        from attnlab.robot.engines import build
        from attnlab.robot.episodes import play_run
        why = getattr(part_of(group, name).cls, "interpreted", "")
        assert not why, f"{name} runs as Python alone: {why}"
        try:
            build(plan_of(group, name, settings))
        except Uncompilable as cause:
            raise AssertionError(f"{name} does not compile: {cause}") from None
        one, other = (play_run(plan_of(group, name, settings), engine=engine)[0] for engine in ("python", "compiled"))
        found = first_difference(one, other)
        assert not found, f"{name} compiles to something else: {found}"
    test.__doc__ = f"{group} '{name}' compiles, and gives the same."
    return test
