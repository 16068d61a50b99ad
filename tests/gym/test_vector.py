"""Many robots in a step are each the single one, compiled or not."""

import warnings

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium")

import attnlab.gym  # noqa: E402, F401  registers
from attnlab.errors import ConfigError  # noqa: E402

HOW = ["simulator=planar", "max_cycles=200", "reading.need_start=900"]
SEEDS = 3


def many(mode=None, **settings):
    return gymnasium.make_vec("attnlab/Attention-v0", num_envs=SEEDS, vectorization_mode=mode,
                              **{"overrides": HOW, **settings})


@pytest.fixture(scope="module")
def compiled():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        envs = many()
    assert envs.unwrapped.engine_why == "compiled"
    yield envs
    envs.close()


def test_each_step_is_that_of_single_ones(compiled):
    """To the last bit, through ends of both kinds, and the others learn."""
    draw, ended = np.random.default_rng(0), [0, 0]
    sync = many("sync")
    same(compiled.reset(seed=3), sync.reset(seed=3))
    for step in range(900):
        actions = draw.integers(0, 4, SEEDS)
        found = compiled.step(actions)
        same(found, sync.step(actions))
        assert compiled.observation_space.contains(found[0])
        ended = [ended[0] + found[2].sum(), ended[1] + found[3].sum()]
        if step == 500:
            same(compiled.reset(seed=[7, 3, 5]), sync.reset(seed=[7, 3, 5]))
        if step == 700:
            same(compiled.reset(), sync.reset())
    assert min(ended) > 2
    sync.close()


def same(one, other):
    for mine, its in zip(one[:-1], other[:-1], strict=True):
        assert mine.dtype == its.dtype and np.array_equal(mine, its)
    mine, its = one[-1], other[-1]
    assert mine.keys() == its.keys() and mine["states"].keys() == its["states"].keys()
    for infos, others in ((mine, its), (mine["states"], its["states"])):
        for name in infos.keys() - {"states"}:
            assert infos[name].tolist() == others[name].tolist(), name


@pytest.mark.parametrize("action", [0, 3])
def test_constant_actions_are_the_episodes_of_single_ones(compiled, action):
    lived = {seed: [] for seed in range(SEEDS)}
    compiled.reset(seed=0)
    while min(map(len, lived.values())) < 2:
        _, _, died, late, infos = compiled.step(np.full(SEEDS, action))
        for seed in np.flatnonzero(died | late).tolist():
            lived[seed].append((int(infos["cycle"][seed]), infos["death"][seed]))
    for seed, episodes in lived.items():
        env, found = gymnasium.make("attnlab/Attention-v0", overrides=HOW), []
        for episode in range(2):
            env.reset(seed=seed if episode == 0 else None)
            over = False
            while not over:
                *_, died, late, info = env.step(action)
                over = died or late
            found.append((info["cycle"], info["death"]))
        assert episodes[:2] == found


def test_gymnasiums_wrappers_take_it(compiled):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        envs = gymnasium.wrappers.vector.RecordEpisodeStatistics(compiled)
        envs.reset(seed=1)
        for _ in range(300):
            *_, infos = envs.step(envs.action_space.sample())
            if "episode" in infos:
                return
    pytest.fail("no episode ended")


def test_what_does_not_compile_is_gymnasiums_own_vector():
    for how, why in ((["simulator=pybullet", "max_cycles=50"], "simulator=pybullet runs as Python"),
                     ([*HOW, "engine=python"], "engine=python")):
        envs = many(overrides=how)
        assert isinstance(envs, gymnasium.vector.SyncVectorEnv) and envs.engine_why.startswith(why)
        envs.reset(seed=0)
        assert envs.step(np.zeros(SEEDS, int))[0].shape == (SEEDS, 5)
        envs.close()
    with pytest.raises(ConfigError, match="engine=compiled: cannot be: simulator=pybullet"):
        many(overrides=["simulator=pybullet", "engine=compiled"])


def test_what_cannot_be_is_one_line(compiled):
    with pytest.raises(ConfigError, match="Did you mean 'avoid'"):
        many(behaviour="avid")
    with pytest.raises(ConfigError, match="2 seeds for 3 robots"):
        compiled.reset(seed=[1, 2])
    compiled.reset(seed=0)
    for actions in ([0, 1], [0, 1, 4], [0, -2, 0]):
        with pytest.raises(gymnasium.error.InvalidAction):
            compiled.step(np.array(actions))
