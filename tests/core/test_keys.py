"""Keys of runs that are there already hold when there is a new setting."""

from __future__ import annotations

import pytest

import attnlab
from attnlab.config import run_key
from attnlab.tables.study import condition_key

KEYS = {(): "72b9fd8383", ("curiosity=none",): "9f4552a2fd",
        ("simulator=planar", "exploration=greedy", "seed=3"): "c5c52b5f8e"}  # before there were reading.novelty_over,
# reading.tie_break and exploration.ties


@pytest.mark.parametrize("typed", KEYS)
def test_the_key_of_what_was_there_before(typed):
    assert run_key(attnlab.compose(*typed)) == KEYS[typed]


def test_what_is_set_is_in_the_key():
    plain = attnlab.compose("exploration=greedy")
    others = [{**plain, "reading": {**plain["reading"], "tie_break": "last"}},
              {**plain, "reading": {**plain["reading"], "novelty_over": "state"}},
              {**plain, "exploration": {**plain["exploration"], "ties": "last"}}]
    for key in (run_key, condition_key):
        assert len({key(config) for config in (plain, *others)}) == 4
