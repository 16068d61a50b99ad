"""A sensor is read once a cycle, and anew in every episode; GIVE's hand by hand."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from attnlab.behaviours.base import RobotSenses
from attnlab.behaviours.give import giving_period, salience
from attnlab.testing import make


class Counting:
    """A simulator that counts how often it is read; nothing is ever nearer than 1 m to a sonar."""
    def __init__(self): self.sonars, self.images = [], 0
    def pose(self): return 1.0, 2.0, 0.5

    def echoes(self, n=16):
        self.sonars.append(n)
        return [1.0] * n

    def blobs(self):
        self.images += 1
        return [SimpleNamespace(kind="food", solid=4), SimpleNamespace(kind="water", solid=5)]


def senses(**how):
    return RobotSenses(Counting(), make("needs", "survival", how=how).body([]))


@pytest.mark.parametrize("cycles", [(0, 1, 2), (1, 2, 3), (2, 1, 0)])
def test_each_sensor_is_read_once_a_cycle(cycles):
    now = senses()
    for cycle in cycles:
        now.cycle = cycle
        for _ in range(2):
            assert len(now.front_distances()) == 8 and len(now.ring()) == 16
            assert [blob.solid for blob in now.blobs("food")] == [4]
            assert [blob.solid for blob in now.blobs("water")] == [5]
    assert now.simulator.sonars == [8, 16] * 3 and now.simulator.images == 3


@pytest.mark.parametrize("cycle", [0, 1, 2])
def test_nothing_of_the_last_episode_is_sensed(cycle):
    now = senses()
    for _ in range(2):
        now.start()
        assert now.cycle == 0
        now.cycle = cycle
        now.front_distances(), now.ring(), now.blobs("food")
    assert now.simulator.sonars == [8, 16] * 2 and now.simulator.images == 2


def test_an_empty_source_is_not_seen():
    now = senses(food_supply="respawn", food_portions=1, food_respawn_cycles=10)
    now.body.larder.take(4, 0)
    for now.cycle, left in ((9, []), (10, [4])):
        assert [blob.solid for blob in now.blobs("food")] == left


def test_heading_and_needs():
    now = senses(need_start=321.0)
    now.body.consume("thirst", 21.0)
    now.body.live(1, 1)
    assert (now.heading(), now.need("hunger"), now.need("thirst")) == (0.5, 322.0, 301.0)


def test_salience_of_a_hand():
    """1.5 m and 1 m/s are the ends of it; the greater of near and fast."""
    give = make("behaviours", "give")
    assert (give.sigma_low, give.sigma_high) == (0.0, 1.0)
    for distance, speed, sigma in ((1.5, 0.25, 0.25), (0.75, 0.25, 0.5), (3.0, 0.0, 0.0), (0.0, 0.0, 1.0),
                                   (0.3, 2.0, 1.0)):
        assert give.percept(SimpleNamespace(hand=lambda d=distance, v=speed: (d, v))) \
            == salience(distance, speed, 1.5, 1.0) == pytest.approx(sigma)
    assert salience(1.0, 0.5, 4.0, 2.0) == 0.75
    assert [giving_period(s, 1, 12) for s in (0.0, 0.5, 1.0)] == [12, 6, 1]  # 6.5 is rounded to the even one
    assert give.reward(0.25, 3 / 11) == pytest.approx(0.5 * (3 / 11 + 0.75))
