"""Sources that run out and fill again; who is punished for a death; needs that a behaviour brings."""

import pytest

from attnlab.errors import ConfigError
from attnlab.needs.base import Larder
from attnlab.robot.plan import RunPlan
from attnlab.testing import config, run
from attnlab.testing.build import reading

EASY = {"train_episodes": 4, "max_cycles": 1150, "learner": "fixed_4", "curiosity": "none"}


def test_larder_by_hand():
    endless = Larder(reading())
    for cycle in range(100):
        endless.take(7, cycle)
    assert endless.has(7, 100)
    once = Larder(reading(food_supply="depletion", food_portions=2))
    once.take(7, 10)
    assert once.has(7, 11)
    once.take(7, 20)
    assert not once.has(7, 21) and not once.has(7, 1149) and once.has(8, 21)
    again = Larder(reading(food_supply="respawn", food_portions=2, food_respawn_cycles=30))
    again.take(7, 10)
    again.take(7, 20)
    assert [again.has(7, c) for c in (21, 49, 50)] == [False, False, True]
    again.take(7, 60)
    assert again.has(7, 61)  # full: two portions again


def test_a_source_wanders_from_cube_to_cube():
    """Two portions each: food goes 1 -> 3 -> 4 -> 1, water, which has one cube, comes back to where it was."""
    larder = Larder(reading(food_supply="wandering", food_portions=2))
    larder.wander(["wall", "food", "water", "food", "food"])

    def full(cycle):
        return [solid for solid in range(5) if larder.has(solid, cycle)]
    assert full(0) == [0, 1, 2]
    for now, (place, after) in enumerate(((1, 3), (3, 4), (4, 1), (1, 3))):
        larder.take(place, 10 * now)
        assert full(10 * now) == [0, *sorted((2, place))]
        larder.take(place, 10 * now + 5)
        assert full(10 * now + 5) == [0, *sorted((2, after))]
    larder.take(2, 50)
    larder.take(2, 51)
    assert 2 in full(51)
    larder.start()
    assert full(0) == [0, 1, 2]
    still = Larder(reading(food_supply="depletion", food_portions=1))
    still.wander(["food", "food"])
    assert still.has(0, 0) and still.has(1, 0)


@pytest.mark.parametrize("simulator", ["planar", "pybullet"])
def test_the_wandering_world_makes_the_robot_move_on(simulator):
    """In either simulator: with one portion a cube it must find the next one, and eats less often."""
    boxes = [{"kind": "food", "x_m": 0.25, "y_m": 1.0}, {"kind": "water", "x_m": 3.75, "y_m": 3.0},
             {"kind": "food", "x_m": 3.0, "y_m": 0.25}, {"kind": "water", "x_m": 1.0, "y_m": 3.75}]
    base = {"name": "layout", "boxes": boxes}
    counts = {}
    for supply in ("endless", "wandering"):
        tables = run(**EASY, simulator=simulator, world={**base, "sources": {"supply": supply, "portions": 1}})
        counts[supply] = sum(tables["episodes"]["meals"]), sum(tables["episodes"]["path_m"])
    assert 0 < counts["wandering"][0] < counts["endless"][0]
    assert counts["wandering"][1] != counts["endless"][1]


def test_depleting_food_caps_the_meals_of_an_episode():
    plenty = run(**EASY)["episodes"]
    scarce = run(**EASY, how={"food_supply": "depletion", "food_portions": 1})["episodes"]
    assert max(plenty["meals"]) > 1 and max(scarce["meals"]) == 1  # one cube of food in this world
    assert max(plenty["drinks"]) > 1 and max(scarce["drinks"]) == 1
    respawn = run(**EASY, how={"food_supply": "respawn", "food_portions": 1, "food_respawn_cycles": 150})["episodes"]
    assert sum(scarce["meals"]) < sum(respawn["meals"]) < sum(plenty["meals"])


def penalties(penalised):
    """Penalty by behaviour and death of the training episodes of a robot that starves."""
    tables = run(how={"penalised": penalised, "need_start": 1450.0, "food_reach_m": 0.01}, max_cycles=200,
                 learner="fixed_1", curiosity="none", train_episodes=1, validation_episodes=0)
    return tables["episodes"]["death"], dict(zip(tables["behaviours"]["behaviour"], tables["behaviours"]["penalty"],
                                                 strict=True))


def test_the_responsible_one_is_punished_or_all_are():
    death, punished = penalties("responsible")
    assert death == ["hunger"] and punished == {"avoid": 0.0, "eat": -1500.0, "drink": 0.0}
    death, punished = penalties("all")
    assert death == ["hunger"] and punished == dict.fromkeys(("avoid", "eat", "drink"), -1500.0)


def test_rest_brings_a_need_and_a_way_to_die():
    tables = run(behaviours=("avoid", "eat", "drink", "rest"), learner="fixed_12", curiosity="none", max_cycles=1150,
                 train_episodes=1)
    assert max(tables["cycles"]["fatigue"]) > 600.0 and "fatigue" not in tables["episodes"]["death"]
    releases = dict(zip(tables["behaviours"]["behaviour"], tables["behaviours"]["releases"], strict=True))
    assert releases["rest"] > 0
    chosen = config(behaviours=("avoid", "rest"), learner="fixed_4", curiosity="none", max_cycles=1150,
                    train_episodes=1, validation_episodes=0, needs="energy_only")
    chosen["behaviours"]["rest"].update(recovery=0.001, deadly=700.0)
    from attnlab.robot.episodes import play_run
    tables, _ = play_run(RunPlan(chosen))
    assert tables["episodes"]["death"] == ["fatigue"]
    paid = dict(zip(tables["behaviours"]["behaviour"], tables["behaviours"]["penalty"], strict=True))
    assert paid == {"avoid": 0.0, "rest": -1500.0}


def test_a_need_that_nobody_brings_is_named():
    with pytest.raises(ConfigError, match="nobody brings a need called 'hunger'"):
        run(needs="energy_only")


@pytest.mark.parametrize(("name", "lines"), [("rest", 40), ("wander", 40)])
def test_a_new_behaviour_is_short(name, lines):
    from pathlib import Path

    from attnlab import registry
    assert len(Path(registry.find("behaviours", name).origin).read_text().splitlines()) <= lines


def test_a_router_that_gives_nonsense_is_named():
    from attnlab.errors import PartError
    from attnlab.penalty.all import All
    from attnlab.penalty.base import check_shares
    from attnlab.testing import make

    class Odd(All):
        name = "odd"

        def shares(self, cause, behaviours):
            return [float("nan")] * len(behaviours)
    avoid = make("behaviours", "avoid")
    with pytest.raises(PartError, match="'odd' gave the shares"):
        check_shares(Odd(None, None), "crash", [avoid])
    assert check_shares(make("penalty", "all"), "crash", [avoid]) == [1.0]


def test_a_world_may_say_how_much_its_sources_give():
    from attnlab.testing.build import BOXES, node
    world = node("world", "layout", boxes=BOXES, sources={"supply": "depletion", "portions": 1})
    experiment = RunPlan(config(world=world, how={"food_respawn_cycles": 77}))
    r = experiment.reading
    assert (r.food_supply, r.food_portions, r.food_respawn_cycles) == ("depletion", 1, 77)
    by_reading = run(**EASY, how={"food_supply": "depletion", "food_portions": 1})
    by_world = run(**EASY, world=world)
    assert by_world == by_reading
    with pytest.raises(ConfigError, match="world.sources.supply: 'deplete' is not one of its values"):
        RunPlan(config(world=node("world", "layout", boxes=BOXES, sources={"supply": "deplete"})))
