"""The suite of measures finds measures that break what all promise."""

import random

import pytest

from attnlab import registry
from attnlab.measures.base import CannotMeasure, Measure
from attnlab.testing import checks
from attnlab.testing.study import conditions


class Bad(Measure):
    """The path, and then something that no measure may do."""
    unit = "m"

    def of(self, runs):
        return self.mean_of(runs, "path_m", "validation")


class WithoutUnit(Bad):
    unit = ""


class Forgetful(Bad):
    """Leaves a seed out."""

    def of(self, runs):
        return {seed: value for seed, value in super().of(runs).items() if seed}


class Silent(Bad):
    def of(self, runs):
        raise CannotMeasure


class Brittle(Bad):
    """Needs hunger, and does not say so."""

    def of(self, runs):
        return {seed: 1 / int(rows["hunger"].count()) for seed, rows in self.last_cycles(runs).items()}


class Counting(Bad):
    """Says something else each time it is asked."""
    asked = 0

    def of(self, runs):
        Counting.asked += 1
        return {seed: value + Counting.asked for seed, value in super().of(runs).items()}


class Relative(Bad):
    """Compares each seed to all of the study, other conditions too, and does not declare it."""

    def of(self, runs):
        mean = runs.conditions.frame("episodes")["path_m"].mean()
        return {seed: value - mean for seed, value in super().of(runs).items()}


class Chancy(Bad):
    def of(self, runs):
        return {seed: value + random.random() for seed, value in super().of(runs).items()}


@pytest.fixture
def registered(monkeypatch):
    def put(cls):
        monkeypatch.setitem(registry.parts, ("measure", "bad"), registry.Spec("measure", "bad", cls, {}, __file__))
    return put


@pytest.mark.parametrize(("cls", "check"), [
    (WithoutUnit, "unit_is_a_word"), (Forgetful, "a_value_for_each_seed"), (Silent, "a_value_for_each_seed"),
    (Brittle, "a_value_for_each_seed"), (Counting, "pure"), (Relative, "each_seed_alone"),
    (Chancy, "no_hidden_randomness")])
def test_a_bad_measure_is_found(registered, cls, check):
    registered(cls)
    with pytest.raises((AssertionError, ZeroDivisionError)):
        checks("measure")[check]("bad")


@pytest.mark.parametrize("check", ["unit_is_a_word", "a_value_for_each_seed", "pure", "each_seed_alone",
                                   "no_hidden_randomness"])
def test_a_good_one_passes(registered, check):
    registered(Bad)
    checks("measure")[check]("bad")


def test_a_measure_has_a_method_of():
    class Nothing(Measure):
        """Measures nothing."""
    with pytest.raises(TypeError, match="Nothing lacks of"):
        registry.register("measure", "nothing")(Nothing)


def test_one_answer_serves_all_conditions():
    """The means of a column are computed once for all runs of a study, and each condition gets its own."""
    study = conditions()
    before = study.frame
    asked = []
    study.frame = lambda table: asked.append(table) or before(table)
    first = {who: Bad(None).of(study.runs(who)) for who in ("litman", "none")}
    tables = len(asked)
    assert {who: Bad(None).of(study.runs(who)) for who in ("litman", "none")} == first
    assert len(asked) == tables and first["litman"] != first["none"]
