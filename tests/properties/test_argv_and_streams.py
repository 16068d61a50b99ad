"""Seeds as typed, and random streams."""

from __future__ import annotations

import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from attnlab.cli.argv import normalise
from attnlab.errors import ConfigError
from attnlab.streams import stream
from attnlab.tables.ranges import compact, seeds


def test_the_papers_command_is_reordered_for_hydra():
    assert normalise(["+experiment=cr_vs_ncr", "-m", "seed=0-3,7"]) == (
        ["-m"], ["+experiment=cr_vs_ncr", "seed=0,1,2,3,7"])
    assert normalise(["seed=range(0,3)"]) == ([], ["seed=0,1,2"])


@pytest.mark.parametrize(("text", "says"), [("5-2", "backwards"), ("a", "whole number"), ("-1", "at least 0"),
                                            ("1,1", "twice"), ("0-3,2", "twice"), ("1.5", "whole number"),
                                            ("", "whole number"), ("0-999999999999", "more than"),
                                            ("range(3,3)", "empty"), ("1,,2", "whole number")])
def test_seeds_that_are_none(text, says):
    with pytest.raises(ConfigError, match=says):
        seeds("seed", text)


@given(st.lists(st.tuples(st.integers(0, 50), st.integers(0, 5)), min_size=1, max_size=5))
def test_ranges_are_written_out(ranges):
    expected = [n for first, more in ranges for n in range(first, first + more + 1)]
    text = ",".join(f"{first}-{first + more}" if more else str(first) for first, more in ranges)
    if len(set(expected)) < len(expected):
        with pytest.raises(ConfigError, match="twice"):
            seeds("seed", text)
    else:
        assert seeds("seed", text) == expected
        assert seeds("seed", compact(expected)) == expected


@given(st.integers(0, 2**63), st.lists(st.text(max_size=8), min_size=1, max_size=3))
def test_a_stream_follows_from_seed_and_name_alone(seed, names):
    first = stream(seed, *names)
    other = stream(seed, *names, "x")
    other.random()
    random.seed(1)
    again = stream(seed, *names)
    assert [first.random() for _ in range(5)] == [again.random() for _ in range(5)]
    assert stream(seed + 1, *names).random() != stream(seed, *names).random()


def test_streams_leave_the_global_generator_alone():
    before = random.getstate()
    stream(0, "a").random()
    assert random.getstate() == before


def test_seed_zero_is_a_seed():
    assert stream(0, "start").random() == pytest.approx(stream(0, "start").random())
    assert stream(0, "start").random() != stream(1, "start").random()
