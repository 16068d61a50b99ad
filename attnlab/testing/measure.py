"""Checks of a measure, on small studies."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Mapping
from typing import Any

from attnlab.measures.base import CannotMeasure, Measure
from attnlab.results.conditions import Conditions
from attnlab.testing.build import make
from attnlab.testing.study import conditions

WHO = ("litman", "none")


def unit_is_a_word(name: str, **settings: Any) -> None:
    """Its unit is a word without spaces around it; "1" for a number without one."""
    unit = make("measure", name, **settings).unit
    assert isinstance(unit, str) and unit and unit == unit.strip(), f"{name}: the unit is {unit!r}"


def a_value_for_each_seed(name: str, **settings: Any) -> None:
    """``of`` gives every seed a number (nan for one that has none) or raises CannotMeasure with a reason; also where
    robots have no needs and nobody avoids anything."""
    for kind in ("normal", "bare"):
        study = conditions(kind)
        for who in WHO:
            runs = study.runs(who)
            found = taken(make("measure", name, **settings), study, who)
            if isinstance(found, str):
                assert found, f"{name}: CannotMeasure without a reason"
            else:
                assert set(found) == set(runs.runs), f"{name}: values for seeds {set(found)} of {set(runs.runs)}"
                assert all(isinstance(value, float) for value in found.values()), f"{name}: {found}"


def pure(name: str, **settings: Any) -> None:
    """Asked again, and of the study read again, it says the same."""
    measure, study = make("measure", name, **settings), conditions()
    for who in WHO:
        first = taken(measure, study, who)
        assert same(first, taken(measure, study, who)), f"{name}: asked again, it says something else"
        assert same(first, taken(make("measure", name, **settings), conditions(), who)), f"{name}: not pure"


def each_seed_alone(name: str, **settings: Any) -> None:
    """What other seeds did changes no seed's value, unless the measure says that it compares them."""
    measure = make("measure", name, **settings)
    together, alone = conditions(seeds=(0, 1, 2)), conditions(seeds=(1,))
    if measure.compares_seeds:
        return
    for who in WHO:
        all_seeds, one = taken(measure, together, who), taken(measure, alone, who)
        if not isinstance(all_seeds, str) and not isinstance(one, str):
            assert same({1: all_seeds[1]}, one), f"{name}: seed 1 has {all_seeds[1]} among others, {one[1]} alone"


def no_hidden_randomness(name: str, **settings: Any) -> None:
    """Nothing is drawn from ``random`` or ``numpy.random``: a measure that must draw takes its own fixed seed."""
    results = under_random_states(name, lambda: repr(taken(make("measure", name, **settings), conditions(), "litman")))
    assert results[0] == results[1], f"{name}: its values depend on the global random state"


def taken(measure: Measure, study: Conditions, who: str) -> Mapping[int, float] | str:
    """The values of a condition, or why there are none."""
    try:
        return measure.of(study.runs(who))
    except CannotMeasure as why:
        return str(why)


def same(one: Mapping[int, float] | str, two: Mapping[int, float] | str) -> bool:
    """Are these the same values, nan being nan?"""
    if isinstance(one, str) or isinstance(two, str):
        return one == two
    return set(one) == set(two) and all(one[seed] == two[seed] or (math.isnan(one[seed]) and math.isnan(two[seed]))
                                        for seed in one)


def under_random_states(name: str, compute: Callable[[], Any]) -> list[Any]:
    """What is computed under two global random states, neither of which it may move."""
    import numpy as np
    saved, results = (random.getstate(), np.random.get_state()), []
    try:
        for seed in (1, 2):
            random.seed(seed)
            np.random.seed(seed)
            before = random.getstate(), repr(np.random.get_state())
            results.append(compute())
            assert before == (random.getstate(), repr(np.random.get_state())), f"{name}: moves the global random state"
    finally:
        random.setstate(saved[0])
        np.random.set_state(saved[1])
    return results


CHECKS = (unit_is_a_word, a_value_for_each_seed, pure, each_seed_alone, no_hidden_randomness)
