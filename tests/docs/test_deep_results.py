"""The paragraph on deep networks: words follow the signs of the tables, and its numbers are theirs."""

import csv
import importlib
import json
from pathlib import Path

import pytest
import yaml

from attnlab.claims import DEFAULT, claims_hash

ROOT = Path(__file__).resolve().parents[2]
UP, DOWN, FLAT = (2.0, 1.0, 3.0), (-20.0, -30.0, -10.0), (0.5, -1.0, 2.0)


@pytest.fixture
def script(monkeypatch):
    """A module of the folder of results by name."""
    monkeypatch.syspath_prepend(str(ROOT / "docs" / "results"))
    return importlib.import_module


def written(folder, name, heads, rows):
    (folder / "deep").mkdir(exist_ok=True)
    with (folder / "deep" / f"{name}.csv").open("w", newline="") as sink:
        csv.writer(sink).writerows([heads, *rows])
    (folder / "deep" / "made.json").write_text(json.dumps({"claims_sha256": claims_hash(DEFAULT), "seeds": 3}))


def test_words_follow_signs(script, tmp_path):
    deep, found, studies = script("deep"), script("found"), script("studies")
    assert deep.text(tmp_path).startswith("This is not known yet: deep")
    ends = dict(zip(studies.RIVALS, (DOWN, FLAT, DOWN, UP), strict=True))
    written(tmp_path, "contrasts", ("quantity", "unit", "treatment", "control", "seeds", "treatment_mean",
                                    "control_mean", "difference", "low", "high"),
            [(found.VALID, "%", "DQN", rival, 3, 70 + e[0], 70, *e) for rival, e in ends.items()])
    written(tmp_path, "conditions", ("condition", "activations"),
            [(name, f"{i} 20 30") for i, name in enumerate((*studies.NETWORKS, *studies.RIVALS))])
    said = deep.text(tmp_path)
    assert said.startswith("The networks of a robot are trained on 100,000 decisions before its run. DQN looks 50 "
                           "times an episode and survives in validation less than Q-learning "
                           "(NCR) (50.0 against 70.0 %, -20.0 [-30.0, -10.0] points), fixed at 4 (50.0 ")
    assert "; neither clearly more nor clearly less than TempoRL (" in said
    assert "; more than random (72.0 against 70.0 %, +2.0 [+1.0, +3.0] points)." in said and "PPO" not in said
    assert said.endswith("Looks of the others: Q-learning (NCR) 52, TempoRL 53, fixed at 4 54, random 55.")


def test_the_study_is_the_experiment(script):
    """The conditions that are held against each other are labels of what it sweeps, and networks have 1e5 steps."""
    from attnlab.learners.sb3 import Sb3
    studies = script("studies")
    node = yaml.safe_load((ROOT / "conf" / "experiment" / "deep.yaml").read_text())
    swept = node["hydra"]["sweeper"]["params"]["learner"].split(",")
    assert set(node["labels"]) <= set(swept)
    assert {*studies.NETWORKS, *studies.RIVALS} <= {node["labels"].get(name, name) for name in swept}
    assert Sb3.Params().steps == 100_000


@pytest.mark.long
def test_it_runs_with_networks(attnlab, tmp_path):
    """The whole study in little: every network is trained, and one report holds all."""
    pytest.importorskip("stable_baselines3")
    short = ("seed=0-1", "train_episodes=12", "validation_episodes=4", "max_cycles=150")
    for learner in ("dqn", "ppo"):
        done = attnlab(f"learner={learner}", "simulator=planar", "curiosity=none", "learner.steps=600", "study=deep",
                       "report=false", "picture=false", "-m", *short)
        assert done.returncode == 0, done.stderr
    done = attnlab("+experiment=deep", "learner=q_learning,random", "-m", *short)
    assert done.returncode == 0, done.stderr
    page = (tmp_path / "outputs" / "deep" / "report" / "index.html").read_text()
    assert all(name in page for name in ("DQN", "PPO", "random", "Q-learning (NCR)"))
    about = [json.loads(file.read_text()) for file in tmp_path.glob("outputs/deep/*/run.json")]
    assert len(about) == 8 and sum("exempt_from_same_bytes" in one for one in about) == 4
