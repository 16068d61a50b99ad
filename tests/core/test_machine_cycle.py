"""The machine cycle on parts that are told what to do: who looks, how far it goes on idly, what ends it."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from attnlab.cycle import Agent, machine_cycle
from attnlab.testing import make


class Clock:
    """An attention that is due at ``due`` and then every ``period`` cycles; ``held`` is its command."""
    def __init__(self, due, period, held=None, name="avoid"):
        self.due, self.period, self.command, self.deaths, self.starts = due, period, held, [], 0
        self.curiosity = SimpleNamespace(attach=lambda now: None)
        self.behaviour = make("behaviours", name)

    def start(self): self.starts += 1

    def activate(self, now, exploration, learning):
        assert now.cycle == self.due
        self.due += self.period
        return 1

    def died(self, share, learning):
        self.deaths.append((share, learning))
        return -1500.0 * share


class Track:
    """A simulator that goes where it is sent, or crashes after ``crash`` cycles."""
    def __init__(self, cycle=0, crash=None): self.cycle, self.crash, self.sent, self.placed = cycle, crash, [], None
    def place(self, *pose): self.placed = pose

    def advance(self, v, w, cycles):
        self.sent.append((v, w, cycles))
        moved = cycles if self.crash is None else min(cycles, self.crash)
        self.cycle += moved
        return moved, self.crash is not None and self.crash <= cycles


def agent(*clocks, cycle=0, crash=None, max_cycles=100, penalty="responsible", **how):
    return Agent(list(clocks), make("needs", "survival", how=how).body([]), Track(cycle, crash),
                 make("fusion", "min_speed_sum_turn"), make("penalty", penalty), max_cycles)


def test_one_looks_and_all_idle_until_the_next_is_due():
    first, second = Clock(0, 7, (0.3, 0.5)), Clock(5, 4, (0.2, 0.25))
    robot = agent(first, second)
    assert machine_cycle(robot, None, True) == (1, None)
    assert robot.simulator.sent == [(0.2, 0.75, 5)]  # both commands are held, also that of the one that did not look
    assert (robot.body.values, robot.body.energy) == ([301.0, 301.0], 4600.0 - 5 - 1)
    assert machine_cycle(robot, None, True) == (1, None)
    assert robot.simulator.sent[1:] == [(0.2, 0.75, 2)] and (first.due, second.due) == (7, 9)


def test_two_look_at_once_and_the_shorter_clock_decides():
    for clocks in ((Clock(3, 8), Clock(3, 2), Clock(9, 1)), (Clock(3, 2), Clock(9, 1), Clock(3, 8))):
        robot = agent(*clocks, cycle=3)
        assert machine_cycle(robot, None, True) == (2, None)
        assert robot.simulator.sent == [(0.0, 0.0, 2)]  # nothing is held: it stands


def test_the_episode_ends_in_the_last_cycle():
    robot = agent(Clock(95, 12), cycle=95)
    machine_cycle(robot, None, True)
    assert robot.simulator.sent == [(0.0, 0.0, 5)] and robot.simulator.cycle == 100


@pytest.mark.parametrize(("crash", "how", "cause"), [
    (3, {}, "crash"), (None, {"need_start": 1499.0}, "hunger"), (1, {"need_start": 1499.0}, "crash"),
    (None, {"energy_death": True, "energy_start": 305.0}, "energy"), (9, {}, None)])
def test_what_ends_it(crash, how, cause):
    """A crash comes before a need: who has hit something in that cycle was in charge of it."""
    robot = agent(Clock(0, 8), crash=crash, **how)
    assert machine_cycle(robot, None, True) == (1, cause)


def test_who_pays():
    """AVOID for a crash, EAT for hunger, both EAT and DRINK for energy, or all for all."""
    for penalty, cause, shares in (("responsible", "crash", [1, 0, 0]), ("responsible", "hunger", [0, 1, 0]),
                                   ("responsible", "thirst", [0, 0, 1]), ("responsible", "energy", [0, 1, 1]),
                                   ("all", "hunger", [1, 1, 1])):
        clocks = [Clock(0, 1, name=name) for name in ("avoid", "eat", "drink")]
        assert agent(*clocks, penalty=penalty).died(cause, True) == [-1500.0 * share for share in shares]
        assert [clock.deaths for clock in clocks] == [[(share, True)] for share in shares]


def test_an_episode_starts_anew():
    clock = Clock(0, 4)
    robot = agent(clock)
    machine_cycle(robot, None, True)
    robot.start(1.0, 2.0, 0.5)
    assert robot.simulator.placed == (1.0, 2.0, 0.5) and robot.now.cycle == 0 and clock.starts == 1
    assert (robot.body.values, robot.body.energy) == ([300.0, 300.0], 4600.0)
