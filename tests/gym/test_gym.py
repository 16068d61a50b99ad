"""The environments pass the checkers of those who define them, and are the same robot."""

import json
import re
import warnings
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

gymnasium = pytest.importorskip("gymnasium")
pytest.importorskip("pettingzoo")

import attnlab.gym  # noqa: E402, F401  registers
from attnlab.cli.calls import composed  # noqa: E402
from attnlab.errors import ConfigError  # noqa: E402
from attnlab.gym.aec import BehavioursEnv  # noqa: E402
from attnlab.robot.episodes import play_run  # noqa: E402
from attnlab.robot.plan import RunPlan  # noqa: E402
from benchmarks import decisions  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
SHORT = ["max_cycles=200"]
PERIODS = [1, 4, 8, 12]


def made(name, **settings):
    return gymnasium.make(f"attnlab/{name}-v0", **settings)


@pytest.mark.parametrize("name", ["Attention", "Survival"])
def test_gymnasium_checks_it(name):
    from gymnasium.utils.env_checker import check_env
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        env = made(name, overrides=SHORT, render_mode="ansi")
        check_env(env.unwrapped)
        env.reset(seed=1)
        assert "cycle 0" in env.render()


@pytest.mark.parametrize("name", ["Attention", "Survival"])
def test_sb3_checks_it(name):
    checker = pytest.importorskip("stable_baselines3.common.env_checker")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        checker.check_env(made(name, overrides=SHORT).unwrapped)


def test_pettingzoo_checks_it():
    from pettingzoo.test import api_test, seed_test
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        api_test(BehavioursEnv(SHORT), num_cycles=200, verbose_progress=False)
        seed_test(lambda: BehavioursEnv(SHORT), num_cycles=100)


def recorded(overrides):
    """(cycles, episodes, behaviours) of all training episodes of a run."""
    config = composed([*overrides, "validation_episodes=0", "record=all"])
    tables, _ = play_run(RunPlan(config))
    return [pd.DataFrame(tables[name]) for name in ("cycles", "episodes", "behaviours")]


def attention(overrides, seed, action, episodes):
    env = made("Attention", behaviour="avoid", overrides=overrides).unwrapped
    return gym_episodes(env, seed, action, episodes)


def survival(overrides, seed, action, episodes):
    env = made("Survival", overrides=overrides).unwrapped
    return gym_episodes(env, seed, [action] * len(env.behaviours), episodes)


def gym_episodes(env, seed, action, episodes):
    for episode in range(episodes):
        observation, info = env.reset(seed=seed if episode == 0 else None)
        total, over = 0.0, False
        while not over:
            assert env.observation_space.contains(observation)
            observation, reward, died, out_of_time, info = env.step(action)
            total, over = total + reward, died or out_of_time
        assert died == (info["death"] != "none")
        yield env._play.simulator.trace[1:info["cycle"] + 1].copy(), info["death"], total
    env.close()


def aec(overrides, seed, action, episodes):
    env = BehavioursEnv(overrides)
    for episode in range(episodes):
        env.reset(seed=seed if episode == 0 else None)
        total = 0.0
        for _ in env.agent_iter():
            _, reward, died, out_of_time, info = env.last()
            total += reward
            env.step(None if died or out_of_time else action)
        yield env._play.simulator.trace[1:info["cycle"] + 1].copy(), info["death"], total
    env.close()


@pytest.mark.parametrize("play", [attention, survival, aec])
@pytest.mark.parametrize(("period", "simulator"), [(1, "planar"), (4, "planar"), (12, "planar"), (8, "pybullet")])
def test_constant_actions_are_the_fixed_learner(play, period, simulator):
    """The same poses to the last bit, the same deaths, and the rewards of the tables."""
    episodes = 2 if simulator == "pybullet" else 4
    how = [f"learner=fixed_{period}", "max_cycles=500", f"simulator={simulator}", "reading.need_start=900"]
    cycles, lived, behaviours = recorded([*how, "seed=5", f"train_episodes={episodes}"])
    found = list(play(how, 5, PERIODS.index(period), episodes))
    assert [death for _, death, _ in found] == lived["death"].tolist()
    for episode, (path, _, total) in enumerate(found):
        mine = cycles[cycles["episode"] == episode]
        assert np.array_equal(path, mine[["x_m", "y_m", "heading_rad"]].to_numpy())
        paid = behaviours[behaviours["episode"] == episode]
        if play is attention:
            paid = paid[paid["behaviour"] == "avoid"]
        assert total == pytest.approx(paid["reward"].sum() + paid["penalty"].sum())
    if period == 12 and play is not attention:
        assert "crash" in lived["death"].tolist()


def test_the_others_learn_as_the_config_says():
    """Nobody decides for EAT and DRINK: they learn with streams and tables of their own, from episode to episode."""
    env = made("Attention", behaviour="avoid", overrides=SHORT).unwrapped
    for episode in range(3):
        env.reset(seed=0 if episode == 0 else None)
        while not any(env.step(1)[2:4]):
            pass
    eat = env._play.agent.attentions[1]
    assert sum(map(sum, eat.learner.visits)) > 20 and any(any(row) for row in eat.learner.q)
    first = env._play.simulator.trace[0].copy()
    env.reset(seed=0)
    assert not np.array_equal(first, env._play.simulator.trace[0])
    assert not any(map(sum, env._play.agent.attentions[1].learner.visits))  # a seed begins a run anew


def test_a_penalty_of_ones_own():
    env = made("Attention", behaviour="avoid", overrides=["learner=fixed_12", "reading.need_start=300"], penalty=-7.0)
    for seed in range(20):
        env.reset(seed=seed)
        over = False
        while not over:
            _, reward, died, out_of_time, info = env.step(3)
            over = died or out_of_time
        if info["death"] == "crash":
            assert reward == -7.0
            return
    pytest.fail("nobody crashed at period 12 in 20 episodes")


def test_stable_baselines3_learns_as_the_page_says(capsys):
    pytest.importorskip("stable_baselines3")
    [block] = [block for block in BLOCKS if "stable_baselines3" in block]
    exec(compile(block, "docs/gym.md", "exec"), {})
    assert capsys.readouterr().out == "(3,)\n"


def test_what_cannot_be_is_one_line():
    for settings, said in (({"behaviour": "avid"}, "Did you mean 'avoid'"), ({"overrides": ["curiosity=litmann"]},
                           "litmann"), ({"overrides": ["reading.reward_period=chosen"]}, "elapsed")):
        with pytest.raises(ConfigError, match=said):
            made("Attention", **settings)
    env = made("Survival", overrides=SHORT).unwrapped
    with pytest.raises(gymnasium.error.ResetNeeded):
        env.step([0, 0, 0])


@pytest.mark.long
def test_a_cycle_costs_at_most_twice_the_plain_loop():
    found = decisions.ratios(4, times=3)
    assert max(of for name, of in found.items() if name != "plain_us") < 2.0, found


def test_the_page_says_what_was_measured():
    """If not: python benchmarks/decisions.py --publish."""
    text, found = decisions.PAGE.read_text(), json.loads(decisions.RESULT.read_text())
    assert decisions.page(text, found) == text and "<!-- decisions:" in text
    assert all(of < 2.0 for row in found["ratios"].values() for name, of in row.items() if name != "plain_us")


BLOCKS = re.findall(r"```python\n(.*?)```", (ROOT / "docs" / "gym.md").read_text(), re.S)


def test_the_page_of_the_docs_runs(capsys):
    said = []
    for block in BLOCKS:
        if "make_vec" not in block and "stable_baselines3" not in block:
            exec(compile(block, "docs/gym.md", "exec"), {})
            said.append(capsys.readouterr().out)
    assert len(said) == 2 and re.fullmatch(r"\d+ (none|crash|hunger|thirst) .*\n", said[0])


@pytest.mark.parametrize("engine", ["python", pytest.param("auto", marks=pytest.mark.long)])
def test_so_do_its_vectors(capsys, engine):
    """As Python; compiled, as it says there, takes compiling two whole robots."""
    blocks = [block for block in BLOCKS if "make_vec" in block]
    for block in blocks:
        exec(compile(block.replace('"simulator=planar"', f'"simulator=planar", "engine={engine}"'), "docs/gym.md",
                     "exec"), {})
    assert len(blocks) == 1 and capsys.readouterr().out == "(8, 5) True\n(8, 18) [4 4 4]\n"
