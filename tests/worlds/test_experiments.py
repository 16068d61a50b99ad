"""The zoo's experiments name what exists, and run."""

import json

import pytest
import yaml

from attnlab import registry
from attnlab.paths import conf_dir
from attnlab.testing import run


def params(experiment):
    """What an experiment sweeps."""
    node = yaml.safe_load((conf_dir() / "experiment" / f"{experiment}.yaml").read_text())
    return {key: value.split(",") for key, value in node["hydra"]["sweeper"]["params"].items()}


APART = {"shuffled_liking", "random_wanting",  # controls of bigger_table, no models of curiosity
         "composed", "litman_itti"}  # litman, surprise


def test_curiosities_holds_every_built_in_model():
    built_in = {option for spec in registry.parts.values() if spec.group == "curiosity"
                and spec.cls.__module__.startswith("attnlab.curiosity.") for option in (spec.name, *spec.presets)}
    assert set(params("curiosities")["curiosity"]) == built_in - APART


def test_a_model_composed_of_a_models_parts_is_that_model():
    """So each of them is named once in curiosities."""
    tables = [run(seed=2, max_cycles=200, train_episodes=2, curiosity=name) for name in ("litman_itti", "surprise")]
    kept = [{column: values for column, values in of["behaviours"].items() if column not in ("run", "curiosity")}
            for of in tables]
    assert kept[0] == kept[1]


def test_generations_are_files_that_name_parts():
    for name in params("generations")["+generation"]:
        node = yaml.safe_load((conf_dir() / "generation" / f"{name}.yaml").read_text())
        chosen = {key.removeprefix("override /"): value for entry in node["defaults"] for key, value in entry.items()}
        assert set(chosen) == {"learner", "curiosity"} and set(node) <= {"defaults", "learner"}  # settings of it
        assert all(registry.find(group, option) for group, option in chosen.items())


@pytest.mark.long
def test_generations_run_paired(attnlab, tmp_path):
    done = attnlab("+experiment=generations", "-m", "seed=0", "simulator=planar", "train_episodes=2",
                   "validation_episodes=1", "max_cycles=60", "learner.generations=1", "report=false", "picture=false")
    assert done.returncode == 2 and "learner.generations" in done.stderr  # only one of them has that setting
    done = attnlab("+experiment=generations", "-m", "seed=0", "simulator=planar", "train_episodes=2",
                   "validation_episodes=1", "max_cycles=60", "report=false", "picture=false")
    assert done.returncode == 0, done.stderr
    runs = [json.loads(path.read_text()) for path in tmp_path.glob("outputs/generations/*/run.json")]
    assert {about["swept"]["generation"] for about in runs} == set(params("generations")["+generation"])
    assert list(tmp_path.glob("outputs/generations/evolved-*/evolved.yaml"))
