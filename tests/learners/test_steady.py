"""A clock of any mean period, by hand and over a whole run."""

import pytest

from attnlab.testing import make, run

PERIODS = [1, 4, 8, 12]


def grants(period, times):
    """The periods granted one after the other."""
    learner = make("learner", "steady", period=period, levels=("none",))
    learner.start()
    return [PERIODS[learner.decide(0, None, None)] for _ in range(times)]


@pytest.mark.parametrize(("period", "granted"), [
    (10.0, [8, 12, 8, 12]),  # 2 too few, made up for by 2 too many
    (9.0, [8, 8, 12, 8, 8]),  # -1, -2, then +3 - 2: over by 1
    (3.0, [4, 1, 4, 4, 1]), (4.0, [4, 4, 4, 4]), (1.0, [1, 1, 1]), (40.0, [12, 12, 12])])
def test_by_hand(period, granted):
    assert grants(period, len(granted)) == granted


@pytest.mark.parametrize("period", [1.5, 2.5, 6.0, 7.3, 11.0])
def test_the_mean_is_the_wanted_one(period):
    assert sum(grants(period, 1000)) / 1000 == pytest.approx(period, abs=0.012)


def test_a_robot_looks_that_often():
    tables = run(learner={"name": "steady", "period": 6.0}, curiosity="none", max_cycles=300)
    cycles = {(e, p): n for e, p, n in zip(*(tables["episodes"][name] for name in ("episode", "phase", "cycles")),
                                           strict=True)}
    for e, p, looks in zip(*(tables["behaviours"][name] for name in ("episode", "phase", "activations")), strict=True):
        assert looks == pytest.approx(cycles[e, p] / 6, abs=1.5)
