"""Many robots in a step are each the single one, compiled or not. What is compiled is also run as Python here, so that
most of it is tested without a compiler; what takes compiling whole robots is long."""

import warnings

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium")

import attnlab.gym  # noqa: E402, F401  registers
from attnlab.errors import ConfigError  # noqa: E402

HOW = ["simulator=planar", "max_cycles=200", "reading.need_start=900"]
SMALL = [*HOW, "behaviours=[avoid]", "curiosity=none"]  # both environments of it are one composition
SEEDS = 3
BOTH = pytest.mark.parametrize("name", ["Attention", "Survival"])


def many(mode=None, name="Attention", **settings):
    return gymnasium.make_vec(f"attnlab/{name}-v0", num_envs=SEEDS, vectorization_mode=mode,
                              **{"overrides": HOW, **settings})


def opened(name, how=SMALL):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        envs = many(name=name, overrides=how)
    assert envs.unwrapped.engine_why == "compiled"
    return envs


@pytest.fixture
def as_python(monkeypatch):
    """What compiled code does, done by Python with the objects that are at the addresses."""
    from attnlab.compiled.layout import Memory
    from attnlab.compiled.words import code
    from attnlab.gym import steps
    things = {}
    monkeypatch.setattr(Memory, "address", lambda self, thing: things.update({id(thing): thing}) or id(thing))
    monkeypatch.setattr(steps, "at_address", lambda address, key: things[int(address)])
    monkeypatch.setattr(steps, "compiled", lambda signature, **options: lambda function: function)
    monkeypatch.setattr(steps, "word_code", code)
    monkeypatch.setattr(steps, "_made", {})


@BOTH
def test_a_step_is_that_of_single_ones(as_python, name):
    envs = opened(name, HOW)
    each_step_is_that_of_single_ones(name, envs, HOW, 300)
    envs.close()


@pytest.fixture(scope="module")
def compiled():
    """Both environments, by name."""
    found = {name: opened(name) for name in ("Attention", "Survival")}
    yield found
    for envs in found.values():
        envs.close()


@BOTH
def test_compiled_it_is_too(compiled, name):
    each_step_is_that_of_single_ones(name, compiled[name], SMALL, 300)


@pytest.mark.long
@BOTH
def test_the_whole_robot_compiled(name):
    envs = opened(name, HOW)
    each_step_is_that_of_single_ones(name, envs, HOW, 900)
    envs.close()


def each_step_is_that_of_single_ones(name, envs, how, steps):
    """To the last bit, through ends of both kinds, and the others learn."""
    draw, ended = np.random.default_rng(0), [0, 0]
    sync = many("sync", name, overrides=how)
    same(envs.reset(seed=3), sync.reset(seed=3))
    for step in range(steps):
        actions = draw.integers(0, 4, envs.action_space.shape)
        found = envs.step(actions)
        same(found, sync.step(actions))
        assert envs.observation_space.contains(found[0])
        ended = [ended[0] + found[2].sum(), ended[1] + found[3].sum()]
        if step == steps // 2:
            same(envs.reset(seed=[7, 3, 5]), sync.reset(seed=[7, 3, 5]))
        if step == steps * 3 // 4:
            same(envs.reset(), sync.reset())
    assert ended[1] > 2 and (ended[0] > 0 or (name, how) != ("Attention", HOW))
    sync.close()


def same(one, other):
    for mine, its in zip(one[:-1], other[:-1], strict=True):
        assert mine.dtype == its.dtype and np.array_equal(mine, its)
    mine, its = one[-1], other[-1]
    assert mine.keys() == its.keys() and mine["states"].keys() == its["states"].keys()
    for infos, others in ((mine, its), (mine["states"], its["states"])):
        for name in infos.keys() - {"states"}:
            assert infos[name].tolist() == others[name].tolist(), name


@BOTH
@pytest.mark.parametrize("action", [0, 3])
def test_constant_actions_are_the_episodes_of_single_ones(compiled, name, action):
    envs, lived = compiled[name], {seed: [] for seed in range(SEEDS)}
    actions = np.full(envs.action_space.shape, action)
    envs.reset(seed=0)
    while min(map(len, lived.values())) < 2:
        _, _, died, late, infos = envs.step(actions)
        for seed in np.flatnonzero(died | late).tolist():
            lived[seed].append((int(infos["cycle"][seed]), infos["death"][seed]))
    for seed, episodes in lived.items():
        env, found = gymnasium.make(f"attnlab/{name}-v0", overrides=SMALL), []
        for episode in range(2):
            env.reset(seed=seed if episode == 0 else None)
            over = False
            while not over:
                *_, died, late, info = env.step(actions[0])
                over = died or late
            found.append((info["cycle"], info["death"]))
        assert episodes[:2] == found


def test_penalties_are_those_of_single_ones(as_python):
    """Ours, and one of one's own for each that is penalised."""
    for penalty in (None, -7.0):
        how = [*HOW[:2], "reading.need_start=1400", "reading.penalised=all"]
        envs, sync = (many(mode, "Survival", overrides=how, penalty=penalty) for mode in (None, "sync"))
        assert envs.unwrapped.engine_why == "compiled"
        same(envs.reset(seed=0), sync.reset(seed=0))
        deaths = []
        while len(deaths) < 4:
            actions = np.full((SEEDS, 3), 3)
            found = envs.step(actions)
            same(found, sync.step(actions))
            deaths += found[1][found[2]].tolist()
        assert deaths == [3 * (-1500.0 if penalty is None else penalty)] * len(deaths)


@BOTH
def test_gymnasiums_wrappers_take_it(compiled, name):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        envs = gymnasium.wrappers.vector.RecordEpisodeStatistics(compiled[name])
        envs.reset(seed=1)
        for _ in range(300):
            *_, infos = envs.step(envs.action_space.sample())
            if "episode" in infos:
                return
    pytest.fail("no episode ended")


def test_what_does_not_compile_is_gymnasiums_own_vector():
    for name, how, why in (("Attention", ["simulator=pybullet", "max_cycles=50"], "simulator=pybullet runs as Python"),
                           ("Survival", [*HOW, "engine=python"], "engine=python")):
        envs = many(name=name, overrides=how)
        assert isinstance(envs, gymnasium.vector.SyncVectorEnv) and envs.engine_why.startswith(why)
        envs.reset(seed=0)
        assert len(envs.step(np.zeros(envs.action_space.shape, int))[0]) == SEEDS
        envs.close()
    with pytest.raises(ConfigError, match="engine=compiled: cannot be: simulator=pybullet"):
        many(overrides=["simulator=pybullet", "engine=compiled"])


def test_what_cannot_be_is_one_line(compiled):
    with pytest.raises(ConfigError, match="Did you mean 'avoid'"):
        many(behaviour="avid")
    for name, wrong in (("Attention", ([0, 1], [0, 1, 4], [0, -2, 0])), ("Survival", ([0, 1, 2], [[0], [1], [4]]))):
        envs = compiled[name]
        with pytest.raises(ConfigError, match="2 seeds for 3 robots"):
            envs.reset(seed=[1, 2])
        envs.reset(seed=0)
        for actions in wrong:
            with pytest.raises(gymnasium.error.InvalidAction):
                envs.step(np.array(actions))
