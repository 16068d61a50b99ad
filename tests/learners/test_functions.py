"""Monitoring functions at their edges, and those that a genome stands for."""

from __future__ import annotations

import pytest

from attnlab.testing import config, make

PERIODS = [1, 4, 8, 12]


def derivative(**settings):
    return make("learner", "monitor", behaviours={"avoid": {"kind": "derivative", **settings}})


@pytest.mark.parametrize("first", range(6))
def test_the_first_view_has_nothing_to_compare_with(first):
    """The shortest period; then, as nothing changes, the longest; and in the next episode the shortest again."""
    learner = derivative()
    for _ in range(2):
        assert [PERIODS[learner.decide(first, None, None)] for _ in range(2)] == [1, 12]
        learner.start()


@pytest.mark.parametrize(("level", "period", "granted"), [(0, 3, 8), (2, 3, 8), (0, 1, 4), (1, 1, 4), (2, 0, 1)])
def test_a_change_counts_by_the_period_it_took(level, period, granted):
    """From the fourth percept to the second: |3 - 1| / 4 = 0.5 in 12, 4 or 1 cycles, whatever the level of curiosity.
    12 / (1 + 20 * 0.5 / 12) = 6.5, 12 / (1 + 20 * 0.5 / 4) = 3.4, 12 / (1 + 20 * 0.5) = 1.1."""
    learner = derivative(gain=20.0)
    learner.decide(3, None, None)
    assert PERIODS[learner.decide((level * 4 + period) * 6 + 1, None, None)] == granted


def test_a_change_counts_by_what_it_was_before():
    """From the first percept to the second, all of it, in 12 cycles: 12 / (1 + 20 / 12) = 4.5."""
    learner = derivative(gain=20.0)
    learner.decide(0, None, None)
    assert PERIODS[learner.decide(3 * 6 + 1, None, None)] == 4


def test_a_need_is_looked_at_most_when_it_is_greatest():
    for name, ends in (("avoid", (1.0, 12.0)), ("eat", (12.0, 1.0)), ("drink", (12.0, 1.0)), ("give", (12.0, 1.0))):
        function = make("learner", "monitor", behaviour=name).function
        assert (function.lowest_mc, function.highest_mc) == ends


@pytest.mark.parametrize(("wanted", "granted"), [
    (0.5, 1), (2.4, 1), (2.5, 1), (2.6, 4), (5.9, 4), (6.0, 4), (6.1, 8), (10.0, 8), (10.1, 12), (40.0, 12)])
def test_the_nearest_period_and_the_shorter_of_two(wanted, granted):
    learner = make("learner", "monitor", behaviours={"avoid": {"lowest_mc": wanted, "highest_mc": wanted}})
    assert {PERIODS[learner.decide(percept, None, None)] for percept in range(6)} == {granted}


def test_one_percept_has_the_lowest_period_and_two_have_both():
    learner = make("learner", "monitor", how={"percept_bins": 1}, behaviours={"avoid": {"lowest_mc": 8.0}})
    assert PERIODS[learner.decide(0, None, None)] == 8
    two = make("learner", "monitor", how={"percept_bins": 2})
    assert [PERIODS[two.decide(percept, None, None)] for percept in (0, 1)] == [1, 12]


def test_a_genome_holds_three_genes_a_behaviour():
    from attnlab.learners.evolution import functions_of
    found = functions_of([3.0, 5.0, 1.0, 12.0, 2.0, -2.0], ["avoid", "eat"])
    assert found == {"avoid": {"kind": "linear", "lowest_mc": 3.0, "highest_mc": 5.0, "bend": 2.0},
                     "eat": {"kind": "linear", "lowest_mc": 12.0, "highest_mc": 2.0, "bend": 0.25}}


@pytest.mark.parametrize(("period", "active"), [(1.0, 200), (8.0, 25)])
def test_the_cost_of_a_genome_is_what_looking_costs_less_survival(period, active):
    """All at the same period, and nobody dies within 200 cycles: 0.5 of the share of active cycles, less 1."""
    from attnlab.learners.evolution import candidate, cost
    from attnlab.robot.plan import RunPlan
    from attnlab.robot.rehearsal import Rehearsal
    setting = {"name": "evolution", "episodes": 2, "look_cost": 0.5}
    with Rehearsal(RunPlan(config(learner=setting, max_cycles=200, curiosity="none")), None) as play:
        outcomes, = play([candidate([period, period, 0.0] * 3, play.behaviours)], 2, "journal")
    assert cost(outcomes, 0.5, 3) == pytest.approx(0.5 * active / 200 - 1.0)
