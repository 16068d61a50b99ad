"""Ways on toys: what must come out whatever is learned, and the papers' directions on a few seeds."""

from random import Random

import pytest

from attnlab.learners.tempo_rl import TempoTables
from attnlab.testing.processes import BRIDGE, CHAIN, CLIFF, DISEASE, EVEN_ODD, Grid, Treatment
from attnlab.toys import values
from attnlab.toys.chains import play_chain, play_chain_clock, summary
from attnlab.toys.grids import best, greedy, play_grid, schedule
from attnlab.toys.patients import EachDelay, OneStep, play_patients


@pytest.mark.parametrize("grid", [CLIFF, BRIDGE], ids=["cliff", "bridge"])
def test_tempo_rl_learns_sooner_and_decides_less_on_its_grids(grid):
    for seed in range(3):
        skipping, plain = play_grid(grid, seed, 150), play_grid(grid, seed, 150, (1,))
        assert skipping["area"] > plain["area"] and skipping["decisions"] < plain["decisions"] / 2
    assert play_grid(grid, 0, 20) == play_grid(grid, 0, 20) != play_grid(grid, 1, 20)


def test_what_is_told_of_a_grid():
    """Two cells: who steps right is there. Nothing known: all skips are equal, so that the longest is taken."""
    grid, draw = Grid(("SX",)), Random(0)
    tables = TempoTables(2, 4, (1, 2, 3), 0.5, 0.99)
    tables.behaviour[0][1] = 1.0
    assert greedy(grid, grid.table(), tables, draw) == (1.0, 1)
    tables.behaviour[0][0] = 2.0  # up, into the border, until 100 steps are over
    assert greedy(grid, grid.table(), tables, draw) == (0.0, 34)
    tables.skip[0][0] = [1.0, 0.0, 0.0]
    assert greedy(grid, grid.table(), tables, draw) == (0.0, 100)
    assert [schedule("linear", i, 5) for i in range(5)] == [1.0, 0.75, 0.5, 0.25, 0.0]
    assert schedule("constant", 4, 5) == 0.1
    assert {best([1.0, 0.0, 1.0], Random(i)) for i in range(9)} == {0, 2} and best([0.0, 2.0], draw) == 1


@pytest.mark.parametrize("chain", [CHAIN, EVEN_ODD], ids=["chain", "even_odd"])
def test_who_always_measures_pays_for_every_step(chain):
    told = play_chain(chain, 0, 60, always=True)
    assert told["measurements"] >= chain.states - 1
    assert told["costed_return"] == pytest.approx(told["free_return"] - chain.cost * told["measurements"])
    assert told["free_return"] == pytest.approx(chain.goal_reward + chain.step_reward * (told["measurements"] - 1))


def test_amrl_measures_less_on_its_chain():
    for seed in range(3):
        mine, always = play_chain(CHAIN, seed, 300), play_chain(CHAIN, seed, 300, always=True)
        assert mine["costed_return"] > always["costed_return"] and mine["measurements"] < always["measurements"] / 2


def test_the_clock_on_the_chain():
    """Always: ten looks, nine steps at 0.01. The clock earns more, within what the chain can give."""
    always, mine = (play_chain_clock(CHAIN, 0, 200, always) for always in (True, False))
    assert always["measurements"] == 10 and always["costed_return"] == pytest.approx(1 - 0.09 - 0.5)
    assert always["costed_return"] < mine["costed_return"] < 0.91


def test_the_last_episodes_tell_what_was_learned():
    told = summary([(0.0, 9)] * 50 + [(1.0, 2)] * 100, 0.1)
    assert told["free_return"] == 1.0 and told["measurements"] == 2.0 and told["costed_return"] == pytest.approx(0.8)
    assert told["free_return_all"] == pytest.approx(100 / 150)
    assert told["costed_return_all"] == pytest.approx((100 * 0.8 - 50 * 0.9) / 150)


def test_models_of_a_patient():
    """Both begin with chances and end near the truth, the one-step model from looks of other delays, too."""
    draw = Random(0)
    models = OneStep(DISEASE), EachDelay(DISEASE)
    for _ in range(4000):
        delay, state = draw.choice((1, 2, 5)), draw.randrange(2)
        after, _, steps = DISEASE.hold(state, 0, delay, 50, draw)
        for model in models:
            model.saw(state, 0, steps, after)
            model.renew()
    for delay, known in ((0, True), (2, True), (7, False)):
        one, each = (model.after(0, delay) for model in models)
        assert all(sum(row) == pytest.approx(1.0) for row in (*one, *each)) and one[2] == each[2] == [0.0, 0.0, 1.0]
        truth = {0: 1.0, 2: 0.89 ** 2 + 0.1 * 0.15, 7: 0.602}[delay]
        assert one[0][0] == pytest.approx(truth, abs=0.08)
        assert each[0][0] == (pytest.approx(truth, abs=0.08) if known else pytest.approx(1 / 3))


@pytest.mark.parametrize("way", ["one_step", "each_delay", "model_free"])
def test_a_patient_whose_treatment_is_certain(way):
    """Treatment 1 keeps paying 10 a step, at a look for 1 every two steps; treatment 0 kills at once. All learn it."""
    alive, dead = (1.0, 0.0), (0.0, 1.0)
    process = Treatment(chances=((dead, dead), (alive, dead)), pays=(10.0, 0.0), begin=alive, delays=(1, 2), cost=1.0,
                        discount=1.0, horizon=20)
    told = play_patients(process, 0, 60, way)
    assert 100 < told["return"] <= 200 - 10 and told["return_all"] <= 190
    assert ("error" in told) == (way != "model_free")


def test_errors_are_shares_of_the_largest_value():
    assert values.off([[1.0, 2.0]], [[1.0, -4.0]]) == {"error": 1.5}
    assert values.during(0.5)[4] == 1.875
    learned, drawn, exact = (play(0, 500)["return"] for play in (values.regulations, values.chance, values.best))
    assert 0.0 < drawn < exact <= 1.0 and 0.0 < learned <= 1.0
