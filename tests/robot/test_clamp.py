"""``validation.clamp_level``: the curiosity level of the state, held where nothing is learned."""

from __future__ import annotations

import pytest

from attnlab.config import run_key
from attnlab.errors import ConfigError
from attnlab.robot.episodes import play_run
from attnlab.robot.plan import RunPlan
from attnlab.tables.study import condition_key
from attnlab.testing import config, run

SIZE = {"train_episodes": 3, "validation_episodes": 2, "max_cycles": 300}
LEVELS = ("low", "LH", "HH")


def test_training_is_the_same_and_validation_has_the_one_level():
    plain = run(**SIZE)
    for i, level in enumerate(LEVELS):
        held = run(**SIZE, validation={"clamp_level": level})
        assert held["policy"] == plain["policy"]
        assert {name: values[:3] for name, values in held["episodes"].items()} == \
            {name: values[:3] for name, values in plain["episodes"].items()}
        plan = RunPlan(config(**SIZE, validation={"clamp_level": level}))
        agent = plan.agent(plan.simulator())
        assert [attention.clamp for attention in agent.attentions] == [i] * 3
        seen = {"train": set(), "validation": set()}
        for phase, name, values in zip(held["cycles"]["phase"], held["cycles"]["avoid_level"],
                                       held["cycles"]["avoid_active"], strict=True):
            if values:
                seen[phase].add(name)
        assert seen["validation"] == {level} and len(seen["train"]) > 1


def test_what_is_wanted_and_liked_is_as_ever():
    """The level is that of the state alone: rewards are mixed from the wanting there is."""
    tables = run(**SIZE, validation={"clamp_level": "low"})
    assert max(tables["episodes"]["wanting_mean"][3:]) > 0.0


def test_the_key_of_a_run_that_holds_nothing_is_the_old_one():
    plain = config(validation={"simulator": None, "drive": None})
    for key in (run_key, condition_key):
        keys = [key({**plain, "validation": {**plain["validation"], "clamp_level": level}})
                for level in ("none", *LEVELS)]
        assert keys[0] == key(plain) and len(set(keys)) == 4


def test_a_level_that_is_none():
    with pytest.raises(ConfigError, match="validation.clamp_level: is HH, and curiosity=none has no such level. It has "
                                          "none"):
        RunPlan(config(curiosity="none", validation={"clamp_level": "HH"}))
    assert play_run(RunPlan(config(curiosity="none", how={"non_curious": "same_states"}, max_cycles=60,
                                   validation={"clamp_level": "HH"})))
    with pytest.raises(ConfigError, match="'hh' is not one of its values"):
        RunPlan(config(validation={"clamp_level": "hh"}))
