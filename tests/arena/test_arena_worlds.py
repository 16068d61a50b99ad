"""What is typed for the study of ways x worlds, and what its runs are called."""

import pytest

from attnlab.arena.summary import STEADY
from attnlab.arena.ways import DEFAULT
from attnlab.arena.worlds import PERIODS, checked, commands, name_of, place_of
from attnlab.testing import run


def typed(**more):
    given = {"names": ["fixed_4", "q_learning", "tempo_rl(all)"], "worlds": ["paper", "open"], "seeds": 10,
             "study": "s", "cap": None, "look_costs": [], "more": []} | more
    return commands(**given)


def test_everybody_is_given_the_same():
    """Worlds, seeds, episodes and simulator are those of all; who asks for the percepts between looks is left out."""
    ways, steady, blind, curious = typed()
    assert ways[0] == "learner=fixed_4,q_learning" and curious[0] == "learner=q_learning"
    assert steady[:2] == ["learner=steady", "learner.period=11,10,9,6,3,1.5"]
    assert blind[:3] == ["learner=fixed", "learner.period=12", "+learner.periods.avoid=8,4"]
    rest = {frozenset(word for word in of if word.partition("=")[0].strip("+").partition(".")[0]
                      not in ("learner", "curiosity")) for of in (ways, steady, blind, curious)}
    assert rest == {frozenset(["world=paper,open", "seed=0-9", "study=s", "picture=false", "report=false",
                               "simulator=planar", "record=last", "cluster=threads", "train_episodes=300",
                               "validation_episodes=100"])}
    assert "curiosity=none" in ways and "curiosity=litman" in curious


def test_what_is_given_goes_before_what_is_usual():
    found = typed(more=["train_episodes=5", "simulator=pybullet", "curiosity=litman"], seeds=1, names=["fixed_4"])
    assert len(found) == 3 and all(of[-3:] == ["train_episodes=5", "simulator=pybullet", "curiosity=litman"] and
                                   "seed=0" in of and "simulator=planar" not in of for of in found)


@pytest.mark.parametrize("more", [["simulator=pybullet", "cluster=serial"], ["train_episodes=5", "fresh=true"]])
def test_what_can_be_is_let_through(more):
    checked(["fixed_4"], ["wandering"], more)


def test_a_cap_and_the_cost_of_a_look():
    ways, steady = typed(cap=4.0, look_costs=[2.0, 8.0])
    assert ways[:3] == ["learner=capped", "learner.of=fixed_4,q_learning", "learner.looks_per_s=4"]
    assert "needs.activation_energy=2,8" in ways and "needs.activation_energy=2,8" in steady


def config(learner, curiosity="none", simulator="planar"):
    return {"learner": learner, "curiosity": {"name": curiosity}, "simulator": {"name": simulator},
            "world": {"name": "paper"}}


@pytest.mark.parametrize(("learner", "curiosity", "apart", "name"), [
    ({"name": "q_learning", "alpha": 0.8}, "none", {"learner": "q_learning", "world": "paper"}, "q_learning"),
    ({"name": "q_learning"}, "litman", {"learner.period": None}, "q_learning+litman"),
    ({"name": "q_learning", "alpha": 0.1}, "none", {"learner.alpha": 0.1}, "q_learning alpha=0.1"),
    ({"name": "steady", "period": 9.0}, "none", {"learner.period": 9.0}, f"{STEADY}9)"),
    ({"name": "fixed", "period": 4, "periods": {}}, "none", {"learner.period": 4}, "fixed_4"),
    ({"name": "fixed_8", "period": 8, "periods": {}}, "none", {"learner": "fixed_8", "learner.period": 8}, "fixed_8"),
    ({"name": "fixed", "period": 12, "periods": {"avoid": 8}}, "none", {}, "fixed_12 avoid=8"),
    ({"name": "capped", "of": "tempo_rl", "looks_per_s": 4.0}, "none", {"learner.of": "tempo_rl"}, "tempo_rl"),
    ({"name": "capped", "of": {"name": "amrl"}}, "none", {"learner.looks_per_s": 2}, "amrl looks_per_s=2")])
def test_names(learner, curiosity, apart, name):
    assert name_of(config(learner, curiosity), apart) == name


def test_another_price_is_another_place():
    apart = {"needs.activation_energy": 2.0, "learner": "q_learning", "learner.alpha": 0.1, "world": "paper"}
    assert place_of(config({}), apart) == "world paper, activation_energy=2.0"
    assert place_of(config({}, simulator="pybullet"), {}) == "world paper (pybullet)"
    assert len(set(PERIODS)) == len(PERIODS)


def test_no_two_ways_give_equal_tables():
    """What the robot did, by episode and behaviour, whatever the way is called."""
    ways: dict[str, str] = {}
    for name in DEFAULT:
        tables = run(learner=name, curiosity="none", train_episodes=4, validation_episodes=2, max_cycles=400)
        did = repr([tables["episodes"][column] for column in ("cycles", "path_m", "safety_mean", "energy_mean")]
                   + [tables["behaviours"]["activations"]])
        assert did not in ways, f"{name} does what {ways[did]} does"
        ways[did] = name
    assert len(ways) >= 12
