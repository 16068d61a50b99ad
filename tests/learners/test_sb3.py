"""learner=sb3: a network that is frozen decides in the run as it would in the environment; and how it is trained."""

import importlib.util
import json
import random
import warnings
from dataclasses import asdict

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium")

from attnlab import registry  # noqa: E402
from attnlab.errors import ConfigError  # noqa: E402
from attnlab.learners.sb3 import Sb3, answer  # noqa: E402
from attnlab.robot.agents import saved  # noqa: E402
from attnlab.robot.episodes import play_run  # noqa: E402
from attnlab.robot.folder import run_to_folder  # noqa: E402
from attnlab.robot.plan import RunPlan  # noqa: E402
from attnlab.robot.rehearsal import Rehearsal  # noqa: E402
from attnlab.testing import config  # noqa: E402
from attnlab.testing.build import make  # noqa: E402

BEHAVIOURS = ("avoid", "eat", "drink")
SHORT = {"train_episodes": 2, "validation_episodes": 1, "max_cycles": 150}


def networks(seed=0):
    """A network for each behaviour that nobody trained: 5 inputs, 8 hidden, 4 actions."""
    draw = np.random.default_rng(seed)

    def layer(n, m):
        return [draw.normal(size=(n, m)).tolist(), draw.normal(size=n).tolist()]
    return {name: [layer(8, 5), layer(4, 8)] for name in BEHAVIOURS}


@pytest.fixture
def frozen(monkeypatch):
    """The learner with networks of ours, and no need of the package."""
    made = networks()
    monkeypatch.setattr(Sb3, "requires", ())
    monkeypatch.setattr(Sb3, "prepare", classmethod(lambda cls, params, play: {"networks": made}))
    return made


@pytest.mark.parametrize("algorithm", ["dqn", "ppo"])
def test_the_run_sees_what_the_environment_shows(frozen, algorithm):
    """The networks, asked of the observations of Survival-v0, live the run's training episodes; with curiosity."""
    import attnlab.gym.envs
    chosen = config(learner=algorithm, **SHORT)
    tables, cycles = play_run(RunPlan(chosen))
    env = attnlab.gym.envs.SurvivalEnv(config(**SHORT))
    taken = []
    for episode in range(2):
        seen, info = env.reset(seed=0 if episode == 0 else None)
        over = False
        while not over:
            said = [answer([tuple(map(np.array, layer)) for layer in frozen[name]], seen[6 * i + 1:6 * i + 6],
                           algorithm) for i, name in enumerate(env.behaviours)]
            actions = [values.index(max(values)) for values in said]
            taken += [action for i, action in enumerate(actions) if seen[6 * i]]
            seen, _, died, late, info = env.step(actions)
            over = died or late
        path = env._play.simulator.trace[1:info["cycle"] + 1]
        mine = [i for i, (phase, n) in enumerate(zip(tables["cycles"]["phase"], tables["cycles"]["episode"],
                                                     strict=True)) if (phase, n) == ("train", episode)]
        assert [tables["cycles"]["x_m"][i] for i in mine] == path[:, 0].tolist()
    env.close()
    assert len(set(taken)) > 1 and cycles > 300
    assert sum(tables["policy"]["visits"]) > 0 and any(tables["policy"]["q"])


def test_what_a_network_says_by_hand():
    layers = [(np.array([[1.0, 0.0], [0.0, -1.0]]), np.array([0.5, 0.0])), (np.array([[2.0, 3.0]]), np.array([1.0]))]
    assert answer(layers, [0.5, 0.25], "dqn") == [2.0 * 1.0 + 3.0 * 0.0 + 1.0]
    assert answer(layers, [0.5, 0.25], "ppo") == pytest.approx([2 * np.tanh(1.0) + 3 * np.tanh(-0.25) + 1])


def test_a_run_of_it_is_exempt_interpreted_and_keeps_its_networks(frozen, tmp_path):
    folder = tmp_path / "run"
    chosen = config(learner="dqn", engine="auto", **SHORT)
    assert run_to_folder(chosen, folder, {"run": "run", "key": "k", "overrides": [], "swept": {}})
    about = json.loads((folder / "run.json").read_text())
    assert about["engine"] == "python" and "why_not" not in about["agent"]
    assert about["exempt_from_same_bytes"].startswith("learner=dqn: PyTorch may give other numbers")
    del frozen["avoid"][:]  # who goes on from there has them from the robot's file
    there = RunPlan({**chosen, "start_from": str(folder)}).parts_alone()
    assert [len(attention.learner.layers) for attention in there.attentions] == [2, 2, 2]
    assert saved(str(folder)).content["learner"] == "sb3"
    long = RunPlan({**chosen, "max_cycles": 10_000, "train_episodes": 500})
    from attnlab.robot.engines import choose
    assert choose(long) == ("python", "learner=dqn runs as Python: its network asks for what is perceived, not for a "
                            "row of a table")


def test_what_cannot_be_is_one_line(monkeypatch):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    with pytest.raises(ConfigError, match=r"needs the package stable_baselines3.*pip install 'attnlab\[sb3\]'"):
        RunPlan(config(learner="ppo"))
    for name in ("tensorboard", "mlflow", "wandb"):
        with pytest.raises(ConfigError, match=rf"needs the package {name}.*pip install 'attnlab\[{name}\]'"):
            make("callback", name)
    monkeypatch.undo()
    monkeypatch.setattr(Sb3, "requires", ())
    for settings, said in (({"beside": "evolution"}, "evolution plays episodes of its own"),
                           ({"beside": "q_lerning"}, "Did you mean 'q_learning'"), ({"gamma": 1.0}, "at most")):
        with pytest.raises(ConfigError, match=said):
            make("learner", "sb3", **settings)
    with pytest.raises(ConfigError, match="reward_period=elapsed"):
        RunPlan(config(learner="sb3", how={"reward_period": "chosen"}))
    import attnlab.gym.envs
    with pytest.raises(ConfigError, match="sb3 plays episodes before a run"):
        attnlab.gym.envs.AttentionEnv("avoid", config(learner="sb3"))


def test_what_training_found_is_kept(tmp_path):
    """An interrupted run does not train again; one with other settings, or with fresh=true, does."""
    asked = []

    def once(**top):
        with Rehearsal(RunPlan(config(**top)), tmp_path) as play:
            return play.once("found", lambda: asked.append(1) or {"a": [0.1, len(asked)]})
    assert once() == once(study="other") == {"a": [0.1, 1]}
    assert once(seed=1) == {"a": [0.1, 2]} and once(seed=1, fresh=True) == {"a": [0.1, 3]}


def params(**settings):
    return registry.build_params("learner", {"name": "sb3", **asdict(Sb3.Params()), **settings}, "learner")[1]


@pytest.fixture
def training():
    """The module that trains; needs the package."""
    pytest.importorskip("stable_baselines3")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return importlib.import_module("attnlab.learners.sb3.training")


@pytest.mark.parametrize(("algorithm", "steps"), [("dqn", 300), ("ppo", 640)])
def test_a_network_is_what_stable_baselines3_trained(training, algorithm, steps):
    """It says what theirs does, and training it repeats and touches no random state that others use."""
    chosen, how = config(max_cycles=200, periods=[1, 4, 8, 12]), params(algorithm=algorithm, steps=steps)
    before = random.getstate(), repr(np.random.get_state())
    trained = training.model(chosen, "avoid", how)
    assert (random.getstate(), repr(np.random.get_state())) == before
    assert trained.num_timesteps == steps
    layers = training.layers(trained)
    arrays = [tuple(map(np.array, layer)) for layer in layers]
    seen = 20 * np.random.default_rng(1).normal(size=(200, 5)).astype(np.float32)  # wide, so that answers differ
    theirs = trained.predict(seen, deterministic=True)[0].tolist()
    mine = [said.index(max(said)) for said in (answer(arrays, row, algorithm) for row in seen.tolist())]
    assert mine == theirs and len(set(mine)) > 1
    assert training.train(chosen, "avoid", how) == layers


def test_a_decision_is_discounted_by_its_cycles(training):
    """DQN: each of a batch by its period. PPO: generalised advantages with one discount a step, and those of
    Stable-Baselines3 where all are equal."""
    import torch
    from stable_baselines3.common.buffers import RolloutBuffer
    spaces = gymnasium.spaces.Box(0.0, 1.0, (5,)), gymnasium.spaces.Discrete(4)
    replay = training.Replay(10, *spaces, device="cpu", discounts=[0.9, 0.5, 0.3, 0.1])
    for action in (3, 0, 1):
        replay.add(np.zeros((1, 5)), np.zeros((1, 5)), np.array([[action]]), np.array([1.0]), np.array([False]), [{}])
    found = replay._get_samples(np.array([0, 1, 2]))
    assert found.discounts.flatten().tolist() == pytest.approx([0.1, 0.9, 0.5])
    assert found.discounts.shape == found.rewards.shape

    def filled(cls, actions, **more):
        buffer = cls(4, *spaces, device="cpu", gamma=0.9, gae_lambda=0.8, **more)
        for i, action in enumerate(actions):
            buffer.add(np.zeros((1, 5)), np.array([[action]]), np.array([1.0 + i]), np.array([i == 2]),
                       torch.tensor([0.5 * i]), torch.tensor([0.0]))
        buffer.compute_returns_and_advantage(torch.tensor([[2.0]]), np.array([False]))
        return buffer.advantages.flatten()
    assert filled(training.Rollout, [0, 1, 2, 3], discounts=[0.9] * 4) == pytest.approx(
        filled(RolloutBuffer, [0, 1, 2, 3]))
    powers = [0.9, 0.5, 0.3, 0.1]
    last = 4.0 + 0.1 * 2.0 - 1.5
    third = 3.0 + 0.3 * 1.5 - 1.0 + 0.3 * 0.8 * last
    second = 2.0 - 0.5  # the third begins an episode
    first = 1.0 + 0.9 * 0.5 - 0.0 + 0.9 * 0.8 * second
    assert filled(training.Rollout, [0, 1, 2, 3], discounts=powers) == pytest.approx([first, second, third, last])


def test_rewards_are_rates_and_a_death_is_bearable(training):
    class Fake(gymnasium.Env):
        observation_space, action_space = gymnasium.spaces.Box(0.0, 1.0, (5,)), gymnasium.spaces.Discrete(4)
        steps = [(0.5, False, 4), (1.0, False, 16), (-1500.0, True, 17)]

        def reset(self, **_):
            self.at = iter(self.steps)
            return np.zeros(5), {}

        def step(self, action):
            reward, died, cycle = next(self.at)
            return np.zeros(5), reward, died, False, {"cycle": cycle}
    for death, penalty, scale in (("clip", -1500.0, 1.0), ("normalise", -1500.0, 10 / 1500), ("clip", 0.0, 1.0),
                                  ("normalise", -2000.0, 10 / 2000), ("normalise", 0.0, 1.0)):
        env = training.Paid(Fake(), 0, penalty, params(death=death))
        for _ in range(2):
            env.reset()
            paid = [env.step(0)[1] for _ in range(3)]
            rates = [0.5 * sum(0.9 ** k for k in range(4)), sum(0.9 ** k for k in range(12))]
            assert paid == pytest.approx([*(scale * rate for rate in rates), max(-10.0, scale * -1500)])


def test_a_run_trains_for_all_its_behaviours(training, tmp_path):
    folder = tmp_path / "run"
    chosen = config(learner={"name": "dqn", "steps": 150}, **SHORT)
    assert run_to_folder(chosen, folder, {"run": "run", "key": "k", "overrides": [], "swept": {}})
    assert sorted(file.name for file in folder.glob("sb3_*.jsonl")) == [f"sb3_{name}.jsonl" for name in
                                                                       sorted(BEHAVIOURS)]
