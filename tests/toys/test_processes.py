"""The small decision processes, by hand."""

from random import Random

import pytest

from attnlab.testing.driving import clock, drive, greedy
from attnlab.testing.processes import (
    BRIDGE,
    CHAIN,
    CLIFF,
    EVEN_ODD,
    RING,
    WALK,
    ZIGZAG,
    Grid,
    Treatment,
    earn,
    optimal,
    powers,
)

UP, RIGHT, DOWN, LEFT = range(4)


@pytest.mark.parametrize(("grid", "steps", "decisions"), [(CLIFF, 15, 3), (BRIDGE, 13, 3), (ZIGZAG, 20, 5)],
                         ids=["cliff", "bridge", "zigzag"])
def test_the_grids_are_as_long_as_the_paper_says(grid, steps, decisions):
    """Appendix D: three decisions on the cliff, five on the zigzag, 20 steps there. It says 16 steps on the cliff, of
    which ten to the right; its own grid is ten wide, which is nine."""
    assert grid.states == 60 and grid.start == 0
    assert grid.fewest() == steps and grid.fewest(9) == decisions


def test_a_step_on_a_grid():
    """Into the border: stays. Into lava and onto the goal: ends."""
    assert CLIFF.step(0, UP) == CLIFF.step(0, LEFT) == (0, 0.0, False)
    assert CLIFF.step(1, RIGHT) == (2, -1.0, True) and CLIFF.step(0, DOWN) == (10, 0.0, False)
    assert CLIFF.step(8, RIGHT) == (9, 1.0, True) and CLIFF.step(59, DOWN) == CLIFF.step(59, RIGHT) == (59, 0.0, False)
    assert CLIFF.table()[1][RIGHT] == CLIFF.step(1, RIGHT)
    assert Grid(("S.X",)).fewest() is None


def test_a_step_on_a_chain():
    assert CHAIN.step(0, 0) == (0, -0.01, False) and CHAIN.step(0, 1) == (1, -0.01, False)
    assert CHAIN.step(9, 1) == (10, 1.0, True) and CHAIN.step(5, 0) == (4, -0.01, False)
    assert EVEN_ODD.step(1, 0) == (2, -1.0, False) and EVEN_ODD.step(1, 1) == (0, -1.0, False)
    assert EVEN_ODD.step(18, 1) == (19, 300.0, True)


def test_a_treatment_by_hand():
    """Certain chances, discount 0.5, cost 5: 8 + 0.5 * 4 - 5 after two steps; death ends it and pays nothing."""
    sure = Treatment(chances=(((0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, 1.0)),), pays=(8.0, 4.0, 0.0),
                     begin=(0.0, 1.0, 0.0), discount=0.5)
    draw = Random(0)
    assert sure.first(draw) == 1 and sure.death == 2
    assert sure.hold(0, 0, 1, 50, draw) == (1, 3.0, 1)
    assert sure.hold(0, 0, 9, 50, draw) == (2, 5.0, 2)
    assert sure.hold(0, 0, 9, 1, draw) == (1, 3.0, 1)  # no more steps are left


def test_chains_of_percepts():
    assert all(sum(row) == pytest.approx(1.0) for row in (*RING, *WALK))
    assert powers(RING)[8][1][3] == 1.0 and powers(WALK)[2][0][0] == pytest.approx(0.8 ** 2 + 0.2 * 0.1)
    assert earn(1, 0) == 0.5 and earn(12, 5) == 0.5 and earn(12, 0) == 1.0


def test_optimal_values_by_hand():
    """Without a future: what arriving earns, less the cost. With one: V is 5 (1 a look, 0.8 of it kept)."""
    now = optimal(RING, earn, lambda p: 0.0, 0.25)
    assert now[0][1] == pytest.approx(earn(4, 4) - 0.25)
    assert optimal(WALK, lambda p, x: 1.0, lambda p: 0.8)[3] == pytest.approx([5.0] * 4)


def test_driving_shows_every_cycle_to_those_who_need_it():
    ends = drive(clock("tempo_rl"), RING, earn, 10)
    every = drive(clock("tempo_rl", observe="all"), RING, earn, 10)
    assert sum(map(sum, ends.visits)) == 10 and any(map(any, every.q)) and every.q != ends.q
    once = drive(clock("q_learning"), RING, earn, 1, choose=lambda state: 2)
    assert once.visits[0] == [0, 0, 1, 0] and greedy(once, 0) == 2
