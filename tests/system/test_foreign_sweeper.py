"""A sweeper that was written for Hydra asks for runs of a study, and is told what they are worth."""

from __future__ import annotations

import csv
import io
import json

import pytest

from attnlab.results.load import load
from tests.conftest import ROOT

SHORT = ("simulator=planar", "train_episodes=2", "validation_episodes=1", "max_cycles=120", "picture=false",
         "report=false", "cluster=serial", "engine=python")
SWEEPER = '''
from hydra.core.config_store import ConfigStore
from hydra.core.override_parser.overrides_parser import OverridesParser
from hydra.core.plugins import Plugins
from hydra.plugins.sweeper import Sweeper


class Halving(Sweeper):
    """Both ends of an interval, then the middle of it."""
    def __init__(self, mind, params=None):
        self.mind = mind

    def setup(self, *, hydra_context, task_function, config):
        self.launcher = Plugins.instance().instantiate_launcher(
            config=config, hydra_context=hydra_context, task_function=task_function)

    def sweep(self, arguments):
        parsed = OverridesParser.create().parse_overrides(arguments)
        plain = [o.input_line for o in parsed if not o.is_sweep_override()]
        at, = (o for o in parsed if o.is_sweep_override())
        low, high = at.value().start, at.value().end
        for batch in ([low, high], [(low + high) / 2]):
            told = self.launcher.launch([[*plain, f"{at.key_or_group}={value}"] for value in batch], initial_job_idx=0)
            for value, answer in zip(batch, told):
                print(f"TOLD,{value},{answer.return_value},{self.mind}")


ConfigStore.instance().store(group="hydra/sweeper", name="halving", provider="x", node={
    "_target_": "hydra_plugins.halving.Halving", "mind": "not set", "params": None})
'''


@pytest.fixture
def sweeping(attnlab, tmp_path):
    """Run a command where that sweeper is installed."""
    (tmp_path / "site" / "hydra_plugins").mkdir(parents=True)
    (tmp_path / "site" / "hydra_plugins" / "halving.py").write_text(SWEEPER)
    return lambda *arguments: attnlab(*arguments, env={"PYTHONPATH": f"{ROOT}:{tmp_path / 'site'}"})


def test_it_is_told_the_mean_over_seeds(sweeping, tmp_path):
    typed = ("hydra/sweeper=halving", "hydra.sweeper.mind=set", "tune.goal={name: survival, phase: train}",
             "learner.alpha=interval(0.2,0.8)", "seed=0-1", "study=s", *SHORT)
    done = sweeping(*typed)
    assert done.returncode == 0, done.stderr
    told = [row[1:] for row in csv.reader(io.StringIO(done.stdout)) if row and row[0] == "TOLD"]
    assert [float(alpha) for alpha, *_ in told] == [0.2, 0.8, 0.5] and {mind for *_, mind in told} == {"set"}
    episodes = load(tmp_path / "outputs" / "s").episodes.query("phase == 'train'")
    for alpha, value, _ in told:
        mine = episodes[episodes["learner.alpha"].astype(float) == float(alpha)]
        assert set(mine["seed"]) == {0, 1}
        assert float(value) == pytest.approx(100 * mine["survival"].mean())
    study = json.loads((tmp_path / "outputs" / "s" / "study.json").read_text())
    assert len(study["runs"]) == 6 and study["commands"][0]["typed"] == list(typed)


def test_a_run_that_fails_ends_it_in_one_line(sweeping, tmp_path):
    (tmp_path / "plugins").mkdir()
    (tmp_path / "plugins" / "ill.py").write_text(
        "from attnlab.api import *\nfrom attnlab.learners.q_learning import QLearning\n"
        "@register('learner', 'ill')\nclass Ill(QLearning):\n    '''Ill.'''\n"
        "    def update(self, state, action, reward, next_state, next_action, cycles):\n"
        "        raise ValueError('ill')\n")
    done = sweeping("hydra/sweeper=halving", "tune.goal=survival", "learner=ill",
                    "learner.alpha=interval(0.2,0.8)", *SHORT)
    assert done.returncode == 1 and "Traceback" not in done.stderr
    assert "the sweeper stopped: " in done.stderr.splitlines()[-1] and "ill" in done.stderr.splitlines()[-1]


@pytest.mark.parametrize(("arguments", "says"), [
    (["hydra/sweeper=halvin", "tune.goal=survival"], "no hydra/sweeper is called 'halvin'. Did you mean 'halving'"),
    (["hydra/sweeper=halving"], "hydra/sweeper=halving: must be told what a run is worth. tune.goal=survival"),
    (["hydra/sweeper=halving", "tune.goal=survivall", "learner.alpha=interval(0.2,0.8)"], "Did you mean 'survival'"),
    (["hydra/sweeper=halving", "tune.goal=survival", "learner.alfa=interval(0.2,0.8)"], "Did you mean 'alpha'"),
    (["hydra.sweeper.mind=x"], "is not used here")])
def test_wrong_words_are_one_line(sweeping, arguments, says, tmp_path):
    done = sweeping(*arguments, *SHORT)
    assert (done.returncode, len(done.stderr.splitlines())) == (2, 1) and says in done.stderr, done.stderr
    assert not (tmp_path / "outputs").exists()


def test_no_config_file_chooses_it(sweeping, tmp_path):
    (tmp_path / "plugins" / "experiment").mkdir(parents=True)
    sly = tmp_path / "plugins" / "experiment" / "sly.yaml"
    sly.write_text("# @package _global_\ndefaults:\n  - override /hydra/sweeper: halving\nstudy: sly\n")
    done = sweeping("experiment=sly", *SHORT)
    assert done.returncode == 2 and "is chosen by a config file" in done.stderr, done.stderr
    sly.write_text("# @package _global_\nhydra: {sweeper: {mind: os.getcwd}}\n")
    done = sweeping("experiment=sly", "hydra/sweeper=halving", "tune.goal=survival", *SHORT)
    assert done.returncode == 2 and "hydra.sweeper.mind is for the command line" in done.stderr, done.stderr
