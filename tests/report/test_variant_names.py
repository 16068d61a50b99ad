"""The name of a variant is no factor of the multiverse."""

from __future__ import annotations

from attnlab.report.multiverse import factors_of


def test_the_name_of_a_combination_is_left_out():
    readings = [{"reading.need_k": k, "variant": name} for k, name in zip("1212", "abcd", strict=True)]
    levels, defaults = factors_of(readings)
    assert set(levels) == {"need_k"}
    assert defaults["need_k"] == "1"
