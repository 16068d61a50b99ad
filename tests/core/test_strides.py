"""The body by hand: eqs 5, 6 and 10 over many cycles at once, when it dies, and what is left in the sources."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from attnlab.needs.base import Body, Larder, Need
from attnlab.testing import make
from attnlab.testing.build import reading


def survivor(**how):
    return make("needs", "survival", how=how).body([])


def body(*needs, energy=1000.0, e_u=1.0, e_nb=1.0, **how):
    return Body(list(needs), energy, e_u, e_nb, reading(**how))


def test_ten_cycles_with_three_looks():
    """Looking is paid for in the first cycle, energy in all ten: 300 + 3, 4600 - 10 - 3."""
    b = survivor()
    assert b.live(3, 10) is None
    assert (b.values, b.energy) == ([303.0, 303.0], 4587.0)
    b = make("needs", "survival", how={"need_k": 2.0}, cycle_energy=0.5, activation_energy=4.0).body([])
    b.live(2, 6)
    assert (b.values, b.energy) == ([304.0, 304.0], 4600.0 - 3.0 - 8.0)


def test_a_meal_counts_once_and_is_energy_too():
    b = survivor()
    b.consume("thirst", 150.0)
    b.consume("thirst", 100.0)
    b.consume("hunger", 30.0)
    b.live(1, 4)
    assert (b.values, b.energy, b.meals) == ([271.0, 51.0], 4600.0 - 4 - 1 + 280, [1, 2])
    b.live(1, 1)  # nothing is eaten twice
    assert (b.values, b.energy, b.meals) == ([272.0, 52.0], 4873.0, [1, 2])


def test_a_need_of_its_own():
    """Fatigue grows each cycle as well, and rest is no energy."""
    b = body(Need("fatigue", 100.0, 2.0, 0.5))
    b.consume("fatigue", 30.0)
    b.live(3, 8)
    assert (b.values, b.energy) == ([100.0 + 2 * 3 - 30.0 + 0.5 * 8], 1000.0 - 8 - 3)


def test_dying_of_a_need_at_its_limit():
    assert body(Need("hunger", 10.0, 1.0, death_at=13.0)).live(2, 5) is None
    assert body(Need("hunger", 10.0, 1.0, death_at=13.0)).live(3, 5) == "hunger"
    assert body(Need("hunger", 10.0, 1.0)).live(99, 5) is None
    both = body(Need("fatigue", 0.0, 1.0, death_at=9.0), Need("hunger", 8.0, 1.0, death_at=9.0))
    assert both.live(1, 1) == "hunger"
    assert survivor(need_start=1499.0).live(1, 1) == "hunger"
    assert survivor(need_start=1499.0, need_death=False).live(3, 1) is None


def test_dying_of_energy_below_its_limit():
    def end(energy, **how):
        return body(energy=energy, energy_min=300.0, **{"energy_death": True, **how}).live(2, 8)
    assert [end(310.0), end(309.9), end(309.9, energy_death=False)] == [None, "energy", None]


@pytest.mark.parametrize(("value", "active", "cycles", "lives"), [
    (890.0, 0, 100, 20),  # ten to go at half a UoE a cycle
    (890.0, 0, 20, 20), (890.0, 0, 15, 15),
    (890.0, 2, 100, 16),  # two of them for the looks
    (890.25, 0, 100, 20),  # 19.5
    (899.5, 0, 100, 1), (899.0, 0, 100, 2), (898.0, 2, 100, 1), (950.0, 0, 100, 1)])
def test_until_a_need_kills(value, active, cycles, lives):
    assert body(Need("fatigue", value, 1.0, 0.5, 900.0)).until_death(active, cycles) == lives


def test_a_need_that_grows_by_looking_kills_at_once_or_not_at_all():
    for start, lives in ((1497.0, 1), (1496.0, 50), (1400.0, 50)):
        assert body(Need("hunger", start, 1.0, death_at=1500.0)).until_death(3, 50) == lives
    b = body(Need("hunger", 1499.0, 1.0, death_at=1500.0))
    b.consume("hunger", 10.0)
    assert b.until_death(3, 50) == 50  # it eats in time
    assert survivor(need_start=1497.0).until_death(3, 50) == 1


def test_the_first_of_two_needs_to_kill():
    slow, fast = Need("slow", 0.0, 0.0, 1.0, 30.0), Need("fast", 0.0, 0.0, 2.0, 30.0)
    assert [body(*needs).until_death(0, 99) for needs in ((slow, fast), (fast, slow))] == [15, 15]


@pytest.mark.parametrize(("energy", "e_u", "active", "cycles", "lives"), [
    (310.0, 1.0, 3, 100, 8),  # 307, and 299 after eight cycles
    (310.0, 1.0, 3, 7, 7), (310.0, 2.0, 3, 100, 4), (307.0, 3.0, 1, 100, 3),
    (301.0, 1.0, 0, 100, 2), (300.5, 1.0, 0, 100, 1), (302.0, 1.0, 3, 100, 1), (305.0, 0.0, 3, 100, 100),
    (302.0, 0.0, 3, 100, 1), (302.0, 0.0, 2, 100, 100)])
def test_until_energy_is_below_its_limit(energy, e_u, active, cycles, lives):
    hungry = Need("hunger", 0.0, 1.0)
    assert body(hungry, energy=energy, e_u=e_u, energy_death=True).until_death(active, cycles) == lives
    assert body(hungry, energy=energy, e_u=e_u).until_death(active, cycles) == cycles


def test_a_meal_puts_death_off_if_it_feeds():
    for feeds, lives in ((True, 15), (False, 5)):  # 304 after the look, or 314; below 300 one cycle after it is there
        b = body(Need("hunger", 50.0, 1.0, feeds_energy=feeds), energy=305.0, energy_death=True)
        b.consume("hunger", 10.0)
        assert b.until_death(1, 100) == lives


def test_energy_is_carried_over_but_not_from_the_dead():
    for carry, dead, energy in ((False, False, 1000.0), (True, False, 988.0), (True, True, 1000.0)):
        b = body(Need("hunger", 5.0, 1.0), energy_carry_over=carry)
        b.consume("hunger", 3.0)
        b.live(2, 10)
        b.dead = dead
        b.start()
        assert (b.energy, b.values, b.meals, b.dead) == (energy, [5.0], [0], False)
        b.consume("hunger", 1.0)
        b.start()
        b.live(0, 1)
        assert b.values == [5.0]  # a meal of an episode that ended is not eaten in the next


AMOUNTS = st.integers(0, 64).map(lambda n: n / 4)  # exact in binary: at once and in steps it must be the same number


@given(st.lists(st.tuples(st.integers(0, 4), st.integers(1, 30), AMOUNTS), min_size=1, max_size=12), AMOUNTS, AMOUNTS)
@settings(max_examples=60, deadline=None)
def test_at_once_as_step_by_step(strides, per_cycle, e_u):
    def build():
        return body(Need("hunger", 20.0, 0.5, per_cycle, 90.0, feeds_energy=True), Need("thirst", 30.0, 1.5, 0.0, 80.0),
                    energy=300.0, e_u=e_u, e_nb=0.25, energy_death=True, energy_min=100.0)
    stride, step = build(), build()
    for active, wanted, meal in strides:
        for b in (stride, step):
            b.consume("hunger", meal)
        cycles = stride.until_death(active, wanted)
        assert 1 <= cycles <= wanted
        cause = stride.live(active, cycles)
        stepped = [step.live(0 if i else active, 1) for i in range(cycles)]
        assert stepped == [None] * (cycles - 1) + [cause]
        assert (stride.values, stride.energy) == (step.values, step.energy)
        if cause:
            break
        assert cycles == wanted


@given(st.lists(st.tuples(st.integers(0, 3), st.integers(1, 12), AMOUNTS, AMOUNTS), max_size=20))
@settings(max_examples=60, deadline=None)
def test_what_is_eaten_leaves_hunger_for_energy(strides):
    """E + H + T changes by -e_u a cycle and 2 k - e_nb = 1 a look, whatever is eaten."""
    b, expected = survivor(), 4600.0 + 300.0 + 300.0
    for active, cycles, food, water in strides:
        b.consume("hunger", food)
        b.consume("thirst", water)
        b.live(active, cycles)
        expected += active - cycles
        assert sum(b.values) + b.energy == expected


def left(larder, solid, *cycles):
    return [larder.has(solid, cycle) for cycle in cycles]


def test_sources_are_endless_at_first():
    for supply in ("endless", "depletion", "respawn"):
        assert left(Larder(reading(food_supply=supply)), 7, 0, 1) == [True, True]
    endless = Larder(reading())
    for cycle in range(20):
        endless.take(7, cycle)
    assert left(endless, 7, 20) == [True]


def test_a_source_is_empty_after_its_portions():
    once = Larder(reading(food_supply="depletion", food_portions=3, max_cycles=1150))
    for cycle in (4, 5):
        once.take(7, cycle)
    assert left(once, 7, 5) == [True]
    once.take(7, 6)
    assert left(once, 7, 6, 7, 1149, 1150) == [False] * 4  # for the whole episode
    assert left(once, 8, 7) == [True]


def test_a_source_fills_again():
    again = Larder(reading(food_supply="respawn", food_portions=2, food_respawn_cycles=30))
    again.take(7, 10)
    again.take(7, 20)
    assert left(again, 7, 20, 49, 50) == [False, False, True]
    again.take(7, 50)
    assert left(again, 7, 50) == [True]
    again.take(7, 51)
    assert left(again, 7, 80, 81) == [False, True]
