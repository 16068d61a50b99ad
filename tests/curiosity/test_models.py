"""Signals of each model over short histories worked out by hand. Percepts count from 0; there are six."""

from math import log, sqrt

import pytest

from attnlab.errors import ConfigError
from attnlab.testing import make
from attnlab.testing.curiosity import StillSenses


def after(name, percepts, **settings):
    """(model, memory) that has seen these percepts."""
    model = make("curiosity", name, **settings)
    model.attach(StillSenses())
    memory = model.memory()
    for percept in percepts:
        model.observe(memory, percept)
    return model, memory


def likings(name, percepts, **settings):
    """The liking of each percept when it was seen."""
    model, memory = after(name, [], **settings)
    found = []
    for percept in percepts:
        found.append(model.liking(memory, percept))
        model.observe(memory, percept)
    return found


def test_litman_and_none_as_ever():
    """The default study's numbers, to the bit: wanting, liking, level, reward."""
    model, memory = after("litman", [2, 2, 2, 0])
    assert (model.wanting(memory, 4000.0), model.liking(memory, 2)) == (933.0 / 1533.0, 0.7)
    assert [model.level(w, r) for w, r in ((0.0, 0.9), (0.2, 0.5), (0.2, 0.51))] == [0, 1, 2]
    assert model.mix(0.25, 0.7, 0.5) == 0.5 * 0.25 + 0.5 * 0.7
    plain = make("curiosity", "none")
    assert plain.levels == ("none",)
    assert (plain.wanting(None, 4600.0), plain.level(0.0, 0.9), plain.mix(0.25, 0.7, 0.5)) == (0.0, 0, 0.25)


def test_novelty_window_forgets_after_its_length():
    assert likings("novelty_window", [1, 1, 1, 2, 2, 1], length=3) == pytest.approx([1, 2 / 3, 1 / 3, 1, 2 / 3, 2 / 3])


def test_novelty_window_of_the_papers_length_is_litman():
    views = [0, 0, 3, 3, 3, 0, 5, 3, 3, 3, 3, 3, 0, 0, 1]
    assert likings("novelty_window", views, length=10) == likings("litman", views)


def test_novelty_decay_halves_after_its_half_life():
    model, memory = after("novelty_decay", [2], half_life=2.0)
    k = 0.5 ** 0.5
    assert model.liking(memory, 2) == pytest.approx(k)
    model.observe(memory, 0)
    model.observe(memory, 0)
    assert 1 - model.liking(memory, 2) == pytest.approx((1 - k) / 2)
    assert sum(memory) == pytest.approx(1 - k ** 3)


def test_count():
    assert likings("count", [4, 4, 4, 1]) == pytest.approx([1, 1 / sqrt(2), 1 / sqrt(3), 1])


def test_litman_gap_wants_what_it_does_not_know():
    model, memory = after("litman_gap", [])
    assert model.wanting(memory, 0.0) == pytest.approx(1.0)  # nothing is known, whatever the energy
    model, memory = after("litman_gap", [3] * 4, length=10, prior=0.5)
    p, q = 4.5 / 7, 0.5 / 7
    assert model.wanting(memory, 0.0) == pytest.approx(-(p * log(p) + 5 * q * log(q)) / log(6))
    assert model.liking(memory, 3) == pytest.approx(0.6)
    assert [model.level(w, 0.9) for w in (0.5, 0.51)] == [0, 2]
    _, memory = after("litman_gap", [0] * 9 + [1] * 10, length=10)
    assert memory.a == [0.5, 10.5, 0.5, 0.5, 0.5, 0.5]  # the zeros have left the window


def test_information_gap():
    model, memory = after("information_gap", [], prior=1.0)
    uniform, once = log(6), -(2 / 7 * log(2 / 7) + 5 / 7 * log(1 / 7))
    assert model.reduction(memory, 0) == pytest.approx(uniform - once)
    assert uniform - once == pytest.approx(0.0439, abs=1e-4)
    model, memory = after("information_gap", [0] * 8, prior=1.0)
    assert model.reduction(memory, 1) < 0 and model.liking(memory, 1) == 0.0  # the model gets less sure
    assert model.liking(memory, 0) > 0
    model, memory = after("information_gap", [0] * 10)
    assert model.liking(memory, 0) == 0.0  # the window is full of it: nothing is left to learn


def test_surprise_of_the_belief_in_the_science_notes():
    views = [0] + [1] * 2 + [3] * 3
    for name, first, fifth in (("surprise", 0.228118, 0.534971), ("surprise_reverse", 0.188549, 0.381696)):
        model, memory = after(name, views)
        assert memory == [2, 3, 1, 4, 1, 1]
        assert model.surprise(memory, 0) == pytest.approx(first, abs=5e-7)
        assert model.surprise(memory, 4) == pytest.approx(fifth, abs=5e-7)
        assert model.liking(memory, 4) > model.liking(memory, 0)


def test_surprise_wears_off_and_comes_back_with_forgetting():
    model, memory = after("surprise", [2] * 50)
    assert model.liking(memory, 2) < 0.01 < 0.9 < model.liking(memory, 0)
    model, memory = after("surprise", [2] * 30 + [0] * 60, forgetting=0.9)
    assert model.liking(memory, 2) > 0.9  # unlike one that never forgets
    assert after("surprise", [2] * 30 + [0] * 60)[0].liking(after("surprise", [2] * 30 + [0] * 60)[1], 2) < 0.3


def test_poisson_surprise_knows_that_percepts_are_ordered():
    model, memory = after("surprise_poisson", [], forgetting=0.5)
    assert memory == [7.0, 2.0]  # beta = 1/(1 - 0.5), a mean of 3.5
    model.observe(memory, 2)
    assert memory == [0.5 * 7 + 3, 0.5 * 2 + 1]
    model, memory = after("surprise_poisson", [1] * 40)
    near, far = model.surprise(memory, 2), model.surprise(memory, 5)
    assert far > 5 * near > 0 and model.surprise(memory, 1) < near
    assert memory[0] / memory[1] == pytest.approx(2.0, rel=1e-3)  # percept 1 is the second: rate 2


def test_prediction_error_learns_what_follows_what():
    assert likings("prediction_error", [0, 1, 0, 1], rate=0.5) == pytest.approx([5 / 6, 5 / 6, 5 / 6, 5 / 12])
    model, memory = after("prediction_error", [0, 1] * 60)
    assert model.liking(memory, 0) < 0.01 and model.liking(memory, 4) > 0.99
    assert [sum(row) for row in memory.p] == pytest.approx([1.0] * 6)


def test_learning_progress_is_the_fall_of_the_error():
    model = make("curiosity", "learning_progress", window=2, delay=2, gain=1.0)
    assert model.progress([0.9, 0.8, 0.5]) == 0.0  # too few
    assert model.progress([0.9, 0.8, 0.5, 0.4]) == pytest.approx(0.4)
    assert model.progress([0.1, 0.9, 0.8, 0.5, 0.4]) == pytest.approx(0.4)
    memory = model.memory()
    memory.errors[2], memory.known[2] = [0.4, 0.4, 0.9, 0.9], 4
    assert model.liking(memory, 2) == 0.0  # getting worse is not liked


def test_learning_progress_is_bored_by_the_known_and_by_noise():
    from random import Random
    draw = Random(1)
    model, memory = after("learning_progress", [0] * 300)
    assert model.liking(memory, 0) < 0.01
    learnt = max(likings("learning_progress", [0] * 40))
    noise = likings("learning_progress", [draw.randrange(6) for _ in range(3000)])
    assert learnt > 0.9 and sum(noise[1000:]) / 2000 < 0.3


def test_salience_needs_an_event():
    assert likings("salience", [3, 3, 4, 3], rate=0.5) == pytest.approx([0, 0, 11 / 12, 5 / 6])
    assert likings("salience", [3, 4, 1], jump=2) == pytest.approx([0, 0, 5 / 6])


def test_habituation_to_a_view_and_growth_for_a_new_one():
    model, now = make("curiosity", "habituation"), StillSenses()
    model.attach(now)
    memory = model.memory()
    seen = []
    for _ in range(10):
        seen.append(model.liking(memory, 0))
        model.observe(memory, 0)
    once = 1 - 1 / 3.33  # y + (1.05 (1 - y) - 1) / 3.33 from y = 1
    assert seen[:3] == pytest.approx([1.0, once, once + (1.05 * (1 - once) - 1) / 3.33])
    assert seen[-1] < 0.1 and memory.n == 1
    now._ring = [0.3] * 8 + [5.0] * 8
    assert model.liking(memory, 0) == 1.0
    model.observe(memory, 0)
    assert memory.n == 2


def test_optimal_arousal_likes_some_novelty():
    from attnlab.curiosity.formulas import wundt
    signal = {"name": "novelty_window", "length": 10}
    seen = likings("optimal_arousal", [0] * 11, signal=signal)
    assert seen == pytest.approx([max(0.0, wundt(1 - i / 10, 0.3, 0.8, 20.0, 1.0)) for i in range(11)])
    assert max(range(11), key=seen.__getitem__) in (4, 5)


def test_composed_takes_each_aspect_from_the_model_named():
    mixed = make("curiosity", "composed", wanting="litman", liking={"name": "surprise", "direction": "post_prior"},
                 level="none", mix={"name": "additive", "bonus": 2.0})
    memory = mixed.memory()
    for percept in (0, 1, 1, 3, 3, 3):
        mixed.observe(memory, percept)
    surprise = make("curiosity", "surprise_reverse")
    assert mixed.wanting(memory, 4000.0) == 933.0 / 1533.0
    assert mixed.liking(memory, 4) == surprise.liking([2, 3, 1, 4, 1, 1], 4)
    assert (mixed.levels, mixed.level(1.0, 1.0)) == (("none",), 0)
    assert mixed.mix(0.5, 0.5, 0.5) == pytest.approx(0.5 + 2.0 * 0.25)


def test_composed_of_one_model_is_that_model():
    for name in ("litman", "surprise", "litman_gap", "learning_progress"):
        whole = make("curiosity", name)
        parts = make("curiosity", "composed", wanting=name, liking=name, level=name, mix=name)
        mine, theirs = whole.memory(), parts.memory()
        for percept in (0, 3, 3, 1, 0, 0, 5, 2, 2) * 9:
            assert whole.wanting(mine, 4000.0) == parts.wanting(theirs, 4000.0)
            assert whole.liking(mine, percept) == parts.liking(theirs, percept)
            whole.observe(mine, percept)
            parts.observe(theirs, percept)


def test_a_wrong_component_is_named():
    with pytest.raises(ConfigError, match=r"curiosity.liking=suprise: no curiosity is called 'suprise'. Did you mean"):
        make("curiosity", "composed", liking="suprise")
    with pytest.raises(ConfigError, match=r"curiosity.liking.directon: no such setting"):
        make("curiosity", "composed", liking={"name": "surprise", "directon": "post_prior"})
    node = "litman"
    for _ in range(9):
        node = {"name": "additive", "signal": node}
    with pytest.raises(ConfigError, match="nested more than"):
        make("curiosity", "composed", liking=node)


@pytest.mark.parametrize(("name", "lines"), [("optimal_arousal", 30)])
def test_a_new_model_is_short(name, lines):
    import inspect

    from attnlab import registry
    source = inspect.getsource(inspect.getmodule(registry.find("curiosity", name).cls))
    assert len(source.splitlines()) <= lines
