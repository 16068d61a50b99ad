"""The name of a variant is no factor of the multiverse."""

from __future__ import annotations

from types import SimpleNamespace

from attnlab.report.multiverse import _factors


def test_the_name_of_a_combination_is_left_out():
    conditions = SimpleNamespace(settings=["reading.need_k", "variant"],
                                 strata=[("1", "r0"), ("2", "r1"), ("1", "r2"), ("2", "r3")])
    levels, defaults = _factors(conditions)
    assert set(levels) == {"need_k"}
    assert defaults["need_k"] == "1"
