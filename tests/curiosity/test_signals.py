"""What the models do at their edges, by hand: full windows, limits of growth, models within models."""

from math import exp, log, sqrt
from types import SimpleNamespace

import pytest

from attnlab.curiosity.habituation import Units
from attnlab.errors import ConfigError
from attnlab.testing import make

RESIDUAL = 933.0 / 1533.0  # eq 11 at E = 4000: (4000 - 3067) / (4600 - 3067)


def seen(model, percepts):
    """The memory of a model that has seen these."""
    memory = model.memory()
    for percept in percepts:
        model.observe(memory, percept)
    return memory


def test_what_every_model_has_unless_it_says_otherwise():
    """Eqs 4 and 11, and levels by any wanting at all and a liking above a half."""
    model = make("curiosity", "count")
    assert model.wanting(None, 4000.0) == pytest.approx(RESIDUAL)
    assert [model.level(*pair) for pair in ((0.0, 1.0), (1e-9, 0.5), (1e-9, 0.51), (1.0, 0.0))] == [0, 1, 2, 1]
    assert model.mix(0.25, 0.75, 0.5) == 0.5 and model.levels == ("low", "LH", "HH")


def test_no_curiosity_with_the_states_of_the_curious():
    model = make("curiosity", "none", how={"non_curious": "same_states"})
    assert (model.levels, model.level(0.2, 0.9), model.level(0.0, 0.9)) == (("low", "LH", "HH"), 2, 0)
    assert model.wanting(model.memory(), 4000.0) == pytest.approx(RESIDUAL)
    assert model.mix(0.25, 0.75, 1.0) == 0.25


def test_additive_takes_nothing_away():
    """0.25 + 1 * 0.5 * 0.75, and with a bonus of 4."""
    assert make("curiosity", "additive").mix(0.25, 0.75, 0.5) == 0.625
    model = make("curiosity", "additive", bonus=4.0, signal="count")
    assert model.mix(0.25, 0.75, 0.5) == 1.75
    memory = seen(model, [3, 3, 3])
    assert (model.liking(memory, 3), model.wanting(memory, 4000.0)) == (0.5, pytest.approx(RESIDUAL))


def test_one_model_wants_and_another_likes():
    """Each sees what is seen once: four views of 3 among priors of a half, and the fifth view in a count."""
    model = make("curiosity", "composed", wanting="litman_gap", liking="count")
    memory, p, q = seen(model, [3] * 4), 4.5 / 7, 0.5 / 7
    assert model.wanting(memory, 0.0) == pytest.approx(-(p * log(p) + 5 * q * log(q)) / log(6))
    assert model.liking(memory, 3) == pytest.approx(1 / sqrt(5))
    alone = make("curiosity", "composed", wanting="count", liking="count")
    assert alone.liking(seen(alone, [3, 3, 3]), 3) == 0.5


@pytest.mark.parametrize("depth", [4, 5])
def test_models_may_be_nested_five_deep(depth):
    node = "litman"
    for _ in range(depth):
        node = {"name": "additive", "signal": node}
    if depth == 4:  # with the innermost one it is five
        assert make("curiosity", "additive", signal=node).mix(0.25, 0.5, 1.0) == 0.75
    else:
        with pytest.raises(ConfigError, match="nested more than 5 deep"):
            make("curiosity", "additive", signal=node)


def test_with_a_single_percept_nothing_is_unknown():
    for name in ("litman_gap", "information_gap"):
        model = make("curiosity", name, how={"percept_bins": 1})
        assert model.wanting(seen(model, [0, 0]), 4600.0) == 0.0


def test_with_two_percepts_nothing_known_is_all_to_be_known():
    model = make("curiosity", "litman_gap", how={"percept_bins": 2})
    assert model.wanting(model.memory(), 0.0) == pytest.approx(1.0)


def test_an_event_may_begin_at_any_percept():
    """What follows is as unknown as ever: 1 - 1/6; before the first view there is no event."""
    for first in range(5):
        model = make("curiosity", "salience")
        assert model.liking(model.memory(), first) == 0.0
        assert model.liking(seen(model, [first]), first + 1) == pytest.approx(5 / 6)
        assert model.liking(seen(model, [first]), first) == 0.0


def shares(*counts):
    """The entropy of these counts, in nats."""
    return -sum(c / sum(counts) * log(c / sum(counts)) for c in counts)


def test_information_gap_in_a_full_window():
    """The oldest view leaves as the new one comes: 0, 1 and then 2 leave 1, 2. With room for three, 0 stays."""
    for length, after in ((2, (2, 2, 1, 1, 1, 1)), (3, (2, 2, 2, 1, 1, 1))):
        model = make("curiosity", "information_gap", length=length, prior=1.0)
        reduction = shares(2, 2, 1, 1, 1, 1) - shares(*after)
        assert model.reduction(seen(model, [0, 1]), 2) == pytest.approx(reduction, abs=1e-12)
    full = make("curiosity", "information_gap", length=2, prior=1.0)
    memory = seen(full, [0, 1])
    gained = shares(2, 2, 1, 1, 1, 1) - shares(3, 1, 1, 1, 1, 1)  # 0 leaves, 1 comes again
    assert full.liking(memory, 1) == pytest.approx(1 - exp(-gained / 0.05))
    assert (memory.a, memory.window.seen()) == ([2.0, 2.0, 1.0, 1.0, 1.0, 1.0], [0, 1])


def test_litman_gap_forgets_what_left_its_window():
    model = make("curiosity", "litman_gap", length=2, prior=0.5)
    memory = seen(model, [0, 1, 1])
    assert (memory.a, memory.window.seen()) == ([0.5, 2.5, 0.5, 0.5, 0.5, 0.5], [1, 1])
    assert [model.liking(seen(model, [0, 1, 1]), percept) for percept in (0, 1)] == [1.0, 0.0]


def test_learning_progress_by_hand():
    """p(0|0) is 1/6, then halfway to 1 each time: the errors 5/6, 5/12, 5/24 of the cell 0."""
    model = make("curiosity", "learning_progress", window=1, delay=1, rate=0.5, gain=1.0)
    found, memory = [], model.memory()
    for _ in range(5):
        found.append(model.liking(memory, 0))
        model.observe(memory, 0)
    assert found == pytest.approx([0.0, 0.0, 0.0, 5 / 12, 5 / 24])
    assert memory.known == [2, 0, 0, 0, 0, 0]  # no more than window + delay
    assert memory.errors[0] == pytest.approx([5 / 24, 5 / 48])
    keen = make("curiosity", "learning_progress", window=1, delay=1, rate=0.5, gain=4.0)
    assert keen.liking(seen(keen, [0] * 3), 0) == 1.0  # 4 * 5/12, at most 1
    assert keen.liking(seen(keen, [0] * 4), 0) == pytest.approx(5 / 6)


def test_learning_progress_belongs_to_what_came_before():
    model = make("curiosity", "learning_progress", window=1, delay=1, rate=0.5)
    memory = seen(model, [0, 1, 2])
    assert memory.known == [1, 1, 0, 0, 0, 0]
    assert [memory.errors[cell][0] for cell in (0, 1)] == pytest.approx([5 / 6, 5 / 6])


def test_surprise_never_forgets_more_than_to_a_thousandth():
    """By halves: 1 is 1/512 after nine views and would be 1/1024 after ten."""
    model = make("curiosity", "surprise", forgetting=0.5)
    assert seen(model, [0]) == [1.5, 0.5, 0.5, 0.5, 0.5, 0.5]
    assert [seen(model, [0] * n)[1] for n in (9, 10, 12)] == [1 / 512, 0.001, 0.001]
    assert seen(make("curiosity", "surprise", prior=1e-4), [0])[1] == 1e-4  # nothing is forgotten, nothing raised


@pytest.mark.parametrize("direction", ["post_prior", "prior_post"])
def test_poisson_surprise_is_the_divergence_of_its_beliefs(direction):
    """Gamma(7, 2) at first; after percept 4, the fifth: 3.5 + 5 and 1 + 1. By quadrature."""
    from scipy.integrate import quad
    from scipy.stats import gamma
    model = make("curiosity", "surprise_poisson", forgetting=0.5, direction=direction)
    memory = model.memory()
    prior, post = gamma(7.0, scale=1 / 2.0), gamma(8.5, scale=1 / 2.0)
    p, q = (post, prior) if direction == "post_prior" else (prior, post)
    expected = quad(lambda x: p.pdf(x) * (p.logpdf(x) - q.logpdf(x)), 1e-9, 40)[0]
    assert model.surprise(memory, 4) == pytest.approx(expected, rel=1e-6)
    assert model.liking(memory, 4) == pytest.approx(1 - exp(-expected / 0.5), rel=1e-6)
    assert memory == [7.0, 2.0]
    model.observe(memory, 4)
    assert memory == [8.5, 2.0]


def habituation(ring, **settings):
    model = make("curiosity", "habituation", **settings)
    model.attach(SimpleNamespace(ring=lambda: list(ring)))
    return model


def units(*grown):
    """Units of these weights and freshness each, with room for nine."""
    made = Units(9)
    for weights, fresh in grown:
        made.fresh[made.grow(weights)] = fresh
    return made


HALF = [1.0] * 16  # of the range of 2 m
OTHER = [1.0] * 15 + [3.0]  # one sonar hears nothing within range: half the range away from HALF


def test_the_view_is_the_ring_over_its_range():
    """A first unit is that view: a quarter, then all from 2 m on."""
    model = habituation([0.5, 1.999, 2.0, 5.0] * 4)
    unit = seen(model, [0]).weights[0]
    assert unit == pytest.approx([0.25, 0.9995, 1.0, 1.0] * 4)


@pytest.mark.parametrize(("fresh", "activity", "most", "liking"), [
    (0.2, 0.61, 9, 1.0), (0.2, 0.60, 9, 0.2),  # its activity is exp(-0.5) = 0.6065
    (0.3, 0.61, 9, 0.3), (0.299, 0.61, 9, 1.0), (0.2, 0.61, 1, 0.2), (0.2, 0.61, 2, 1.0)])
def test_what_a_habituated_unit_does_not_stand_for_is_new(fresh, activity, most, liking):
    model = habituation(OTHER, activity=activity, units=most)
    memory = units(([0.5] * 16, fresh))
    assert model.liking(memory, 0) == liking
    model.observe(memory, 0)
    assert memory.n == (2 if liking == 1.0 else 1)


def test_the_same_view_again_is_never_new():
    assert habituation(HALF, activity=1.0).liking(units(([0.5] * 16, 0.1)), 0) == 0.1


def test_the_nearest_unit_wins():
    memory = units(([0.9] * 16, 0.7), ([0.5] * 16, 0.4), ([0.1] * 16, 0.8))
    assert memory.winner([0.5] * 15 + [0.75]) == (1, pytest.approx(exp(-0.25)))
    assert units().winner([0.5] * 16) == (-1, 0.0)
    assert habituation(HALF).liking(memory, 0) == 0.4


def test_a_winner_moves_and_habituates():
    """y = 0.5 and w = 0.25: y + (1 * 0.5 - 1) / 4 = 0.375, and w + 0.5 * 0.5 * 0.25."""
    memory = units(([0.25] * 16, 0.5))
    habituation(HALF, alpha=1.0, tau=4.0, rate=0.5).observe(memory, 0)
    assert (memory.weights[0], memory.fresh[0], memory.n) == ([0.3125] * 16, 0.375, 1)
    habituation(HALF, alpha=0.5, tau=1.0).observe(memory, 0)
    assert memory.fresh[0] == 0.0  # 0.375 + 0.3125 - 1 is below


def test_a_unit_grows_halfway_and_moves_on_at_once():
    """Between 0.5 and 1 is 0.75, and 0.1 of the rest of the way more; as fresh as after one view, 1 - 1 / 4."""
    memory = units(([0.5] * 16, 0.2))
    habituation(OTHER, activity=0.61, tau=4.0).observe(memory, 0)
    assert memory.weights[:2] == [[0.5] * 16, pytest.approx([0.5] * 15 + [0.775])]
    assert memory.fresh[:2] == [0.2, 0.75] and memory.n == 2
