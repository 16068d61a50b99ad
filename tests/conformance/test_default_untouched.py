"""Parts that are there but not chosen change no number of a study, and cost it nothing."""

import hashlib

import pytest

from attnlab import registry
from attnlab.loading import load_all
from attnlab.testing import run

CORE = {("curiosity", "litman"), ("curiosity", "none"), ("learner", "q_learning"), ("exploration", "softmax"),
        ("exploration", "greedy"), ("behaviours", "avoid"), ("behaviours", "eat"), ("behaviours", "drink"),
        ("needs", "survival"), ("fusion", "min_speed_sum_turn"), ("penalty", "responsible"),
        ("simulator", "planar"), ("world", "layout")}
STUDY = {"train_episodes": 6, "validation_episodes": 2, "max_cycles": 400}


@pytest.fixture
def core_alone(monkeypatch):
    """A registry that holds the default study's parts and no others."""
    load_all()
    full = dict(registry.parts)

    def only(core: bool):
        registry.parts.clear()
        registry.parts.update({key: spec for key, spec in full.items() if not core or key in CORE})
    yield only
    only(core=False)


@pytest.mark.parametrize("curiosity", ["litman", "none"])
def test_the_numbers_are_the_same_without_all_other_parts(core_alone, curiosity):
    digests = []
    for core in (True, False):
        core_alone(core)
        digests.append(hashlib.sha256(repr(run(curiosity=curiosity, **STUDY)).encode()).hexdigest())
    assert digests[0] == digests[1]
    assert digests[0] != hashlib.sha256(repr(run(curiosity=curiosity, seed=1, **STUDY)).encode()).hexdigest()


def test_composed_of_litman_is_litman_to_the_bit():
    """The zoo's general path gives the default study's numbers exactly."""
    def numbers(tables):
        return {table: {column: values for column, values in columns.items() if column != "curiosity"}
                for table, columns in tables.items()}
    assert repr(numbers(run(curiosity="composed", **STUDY))) == repr(numbers(run(curiosity="litman", **STUDY)))
    window = run(curiosity={"name": "novelty_window", "length": 10}, **STUDY)
    assert repr(numbers(window)) == repr(numbers(run(curiosity="litman", **STUDY)))
