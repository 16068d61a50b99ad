"""The two controls of CR: liking drawn from the behaviour's own past, wanting drawn from nowhere."""

from __future__ import annotations

from collections import Counter

import pytest

from attnlab.robot.engines import choose
from attnlab.robot.episodes import play_run
from attnlab.robot.plan import RunPlan
from attnlab.testing import config, make, run
from attnlab.testing.curiosity import StillSenses


class Draws:
    """Numbers in the order in which they are asked for."""

    def __init__(self, *numbers):
        self.numbers = list(numbers)

    def random(self):
        return self.numbers.pop(0)


def begun(name, cycle=1, **how):
    """(a model that senses this cycle, its memory)."""
    model = make("curiosity", name, how=how)
    now = StillSenses()
    now.cycle = cycle
    model.attach(now)
    return model, model.memory()


def test_shuffled_by_hand():
    """A window of four. True likings of 2, 2, 2, 5 are 1, 3/4, 2/4, 1: the past is {1}, {1, .75}, {1, .75, .5}, and
    {1, 1, .75, .5}; a draw of u takes the one at u times its size, the most liked first."""
    model, memory = begun("shuffled_liking", novelty_window=4)
    assert model.liking(memory, 0) == 1.0  # nothing is known yet
    model.draw = Draws(0.9, 0.5, 0.7, 0.49, 0.5)
    found = []
    for percept in (2, 2, 2, 5, 2):
        model.observe(memory, percept)
        found.append(model.liking(memory, percept))
    assert memory.counts == [2, 1, 1, 1, 0]  # the last 2 was seen three times in four
    assert found == [1.0, 0.75, 0.5, 1.0, 0.75]  # the last: place 2 of 5 (two of 1.0, one of .75, ...)
    assert all(model.liking(memory, percept) == found[-1] for percept in range(model.bins))


def test_the_past_is_kept_and_the_window_is_not():
    """In an episode's first cycle the window is empty, as that of litman; the counts go on."""
    model, memory = begun("shuffled_liking", novelty_window=4)
    for _ in range(3):
        model.observe(memory, 1)
    model.now.cycle = 0
    model.observe(memory, 1)
    assert memory.counts == [2, 1, 1, 0, 0] and memory.window.seen() == [1]
    model, memory = begun("shuffled_liking", 0, novelty_window=4, novelty_persists=True)
    for _ in range(3):
        model.observe(memory, 1)
    assert memory.counts == [1, 1, 1, 0, 0]


def test_shuffled_is_distributed_as_litmans():
    """Over a whole run: the likings that were drawn are those there were, in another order, and say nothing of the
    percept."""
    tables = run(curiosity="shuffled_liking", train_episodes=8, validation_episodes=1, max_cycles=600)
    plan = RunPlan(config(curiosity="shuffled_liking", max_cycles=600))
    agent = plan.agent(plan.simulator())
    assert len({id(a.memory) for a in agent.attentions}) == 3  # each its own past
    assert 0.0 < sum(tables["behaviours"]["liking_mean"]) / len(tables["behaviours"]["liking_mean"]) < 1.0
    model, memory = begun("shuffled_liking")
    drawn = Counter()
    for i in range(6000):
        model.observe(memory, (0, 0, 0, 1, 2, 3)[i % 6])
        drawn[memory.drawn] += 1
    for n, count in enumerate(memory.counts):
        assert drawn[n] / 6000 == pytest.approx(count / 6000, abs=0.02)


def test_random_wanting_by_hand():
    model, memory = begun("random_wanting")
    assert model.wanting(memory, 0.0) == 0.5 and model.level(0.5, 0.9) == 2
    model.draw = Draws(0.25, 0.75)
    litman, window = begun("litman")
    for percept, wanting in ((3, 0.25), (3, 0.75)):
        assert model.liking(memory, percept) == litman.liking(window, percept)
        model.observe(memory, percept)
        litman.observe(window, percept)
        assert model.wanting(memory, 0.0) == model.wanting(memory, 4600.0) == wanting
    assert model.mix(0.4, 1.0, 0.25) == pytest.approx(0.75 * 0.4 + 0.25)


def test_random_wanting_is_uniform():
    model, memory = begun("random_wanting")
    found = []
    for _ in range(4000):
        model.observe(memory, 0)
        found.append(memory.wanting)
    tenths = Counter(int(10 * wanting) for wanting in found)
    assert set(tenths) == set(range(10)) and all(300 < n < 500 for n in tenths.values())


@pytest.mark.long
@pytest.mark.parametrize("name", ["shuffled_liking", "random_wanting"])
def test_compiled_is_the_same(name):
    plan = RunPlan(config(curiosity=name, engine="compiled", max_cycles=300, train_episodes=4))
    assert choose(plan).name == "compiled"
    assert repr(play_run(plan, engine="compiled")[0]) == repr(play_run(plan)[0])
