"""Settings of a few values: the type says which, and a wrong one is named with the nearest right one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import pytest

from attnlab.errors import ConfigError
from attnlab.settings import build, choices_of, defaults_of, setting


@dataclass
class Inner:
    shape: Literal["linear", "exponential"] = setting("linear", "of a schedule")


@dataclass
class Outer:
    drive: Literal["kinematic", "wheels"] | None = setting(None, "None for the same")
    orders: list[Literal["first", "last"]] = setting([], "in this order")
    power: Literal[1, 2] = setting(1, "of the distance")
    inner: Inner = setting(Inner(), "nested")


def test_right_values_pass():
    assert build(Outer, defaults_of(Outer), "") == Outer()
    made = build(Outer, {"drive": "wheels", "orders": ["last", "first"], "power": 2.0,
                         "inner": {"shape": "exponential"}}, "")
    assert made == Outer("wheels", ["last", "first"], 2, Inner("exponential"))
    assert build(Outer, {"drive": None}, "").drive is None


@pytest.mark.parametrize(("node", "line"), [
    ({"drive": "wheel"}, "w.drive: 'wheel' is not one of its values. Did you mean 'wheels'? Known: kinematic, wheels"),
    ({"orders": ["first", "lust"]}, "w.orders[1]: 'lust' is not one of its values. Did you mean 'last'?"),
    ({"power": 3}, "w.power: '3' is not one of its values. Known: 1, 2"),
    ({"power": "two"}, "w.power: expected a whole number, got 'two'"),
    ({"drive": {"name": "wheels"}}, "w.drive: expected a word, got"),
    ({"inner": {"shape": None}}, "w.inner.shape: expected a word, got None"),
    ({"inner": {"shape": "liner"}}, "w.inner.shape: 'liner' is not one of its values. Did you mean 'linear'?"),
])
def test_wrong_values_are_named(node, line):
    with pytest.raises(ConfigError) as told:
        build(Outer, node, "w")
    assert str(told.value).startswith(line)


def test_choices_are_found_in_the_type():
    assert choices_of(Literal["a", "b"] | None) == ("a", "b") == choices_of(list[Literal["a", "b"]])
    assert choices_of(str) == choices_of(list[float]) == choices_of(float | None) == ()
