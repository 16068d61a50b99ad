"""Every measure on a tiny study, against a value worked out by hand."""

import math

import pytest
from planted import cells, clocks, cycles, episodes, falling, plant, policy, runs_of

from attnlab import registry
from attnlab.errors import ConfigError
from attnlab.measures.base import CannotMeasure
from attnlab.paths import PACKAGE
from attnlab.testing import make

SINE = [300.0 + 20 * math.sin(2 * math.pi * t / 100) for t in range(1000)]
EVERY_FOURTH = [i % 4 == 0 for i in range(400)]

CASES = [  # measure, its settings, the tables, the value by hand
    ("survival", {}, {"episodes": episodes("validation", survival=[0.5, 1.0])}, 75.0),
    ("survival", {"phase": "train", "episodes": [1, 3]},
     {"episodes": episodes("train", survival=[0.0, 0.6, 0.8, 1.0])}, 70.0),
    # blocks of two: 50 %, 100 %, 100 %; the first one from which all are at 99.5 % begins after two episodes
    ("survival_convergence", {"block": 2, "episodes": [0, 6]},
     {"episodes": episodes("train", survival=[0.4, 0.6, 1.0, 1.0, 1.0, 1.0])}, 2.0),
    ("survival_convergence", {"block": 2, "episodes": [0, 4]},
     {"episodes": episodes("train", survival=[1.0, 1.0, 1.0, 0.9])}, 4.0),  # never: the whole window
    ("episode", {"column": "hunger_max", "phase": "train"},
     {"episodes": episodes("train", hunger_max=[600.0, 800.0])}, 700.0),
    ("energy_margin", {"of": "min"}, {"episodes": episodes("validation", energy_min=[3167.0, 3017.0])}, 25.0),
    ("energy_margin", {"of": "max"}, {"episodes": episodes("validation", energy_max=[3067.0])}, 0.0),
    # meal, drink, meal: both neighbours differ; in a random order 2 * 2 * 1 / (3 * 2) of them would
    ("alternation", {}, {"cycles": cycles(hunger=falling(9, 2, 6), thirst=falling(9, 4))}, 100 * (1 - 2 / 3)),
    # two meals, then two drinks: one neighbour of three differs; by chance 2 * 2 * 2 / (4 * 3)
    ("alternation", {}, {"cycles": cycles(hunger=falling(9, 1, 2), thirst=falling(9, 5, 7))}, 100 * (1 / 3 - 2 / 3)),
    ("rhythm", {}, {"cycles": cycles(hunger=SINE, thirst=[300.0] * 1000)}, pytest.approx(100.0, abs=1.0)),
    # gaps of 10 and 20 (mean 15, deviation sqrt 50) and of 10 and 10
    ("meal_variation", {}, {"cycles": cycles(hunger=falling(50, 10, 20, 40), thirst=falling(50, 5, 15, 25))},
     100 * (math.sqrt(50) / 15 + 0) / 2),
    ("activations", {}, {"behaviours": clocks("validation", "activations", avoid=[20, 22], eat=[10, 8])}, 30.0),
    ("activations", {"behaviour": "avoid", "minus": "eat"},
     {"behaviours": clocks("validation", "activations", avoid=[20, 22], eat=[10, 8])}, 12.0),
    ("activation_saving", {"behaviour": "avoid"},
     {"behaviours": clocks("validation", "activations", avoid=[20], eat=[10]),
      "episodes": episodes("validation", cycles=[100])}, 80.0),
    ("activation_saving", {}, {"behaviours": clocks("validation", "activations", avoid=[20], eat=[10]),
                               "episodes": episodes("validation", cycles=[100])}, 85.0),  # 30 of 2 * 100
    ("overlap", {}, {"behaviours": clocks("validation", "activations", avoid=[20], eat=[15]),
                     "episodes": episodes("validation", active_cycles=[28])}, 20.0),
    # both every fourth cycle, together: half of the activations coincide; at random phases one time in four they do
    ("overlap_excess", {}, {"cycles": cycles(avoid_active=EVERY_FOURTH, eat_active=EVERY_FOURTH)},
     pytest.approx(50.0 - 12.5, abs=5.0)),
    ("policy_match", {"pattern": {"1-4": 12, "5-6": 1}},
     {"policy": policy("drink", "none", {1: 12, 2: 12, 3: 12, 4: 12, 5: 1, 6: 1})}, 100.0),
    ("policy_match", {"pattern": {"1-6": [1, 4]}, "level": "low"},
     {"policy": policy("drink", "low", {1: 12, 2: 4, 3: 12, 4: 1}) + policy("drink", "HH", {1: 1, 2: 1, 3: 1, 4: 1})},
     50.0),
    ("reward", {}, {"behaviours": clocks("validation", "reward", avoid=[10.0, 20.0], eat=[5.0, 5.0])}, 20.0),
    ("reward", {"behaviour": "eat", "extrinsic": True, "phase": "train", "episodes": [1, 2]},
     {"behaviours": clocks("train", "reward_extrinsic", avoid=[10.0, 20.0], eat=[5.0, 7.0])}, 7.0),
    ("reward_rise", {"early": [0, 2], "late": [2, 3]},
     {"behaviours": clocks("train", "reward", avoid=[10.0, 20.0, 40.0], eat=[1.0, 1.0, 1.0])}, 25.0),
    # end level 10; blocks of two: 1, 9.5, 10, and 90 % of the end level is 9
    ("reward_convergence", {"block": 2, "end": 2, "episodes": [0, 6]},
     {"behaviours": clocks("train", "reward", avoid=[0.0, 2.0, 9.0, 10.0, 10.0, 10.0])}, 2.0),
    ("coverage", {}, {"coverage": cells("train", *((x, 3, 1) for x in range(16)))}, 1.0),  # 16 of 40 x 40 cells
    # a body of 0.25 m in the middle of a cell touches 5 x 5 cells without the corners
    ("coverage", {"footprint": True}, {"coverage": cells("train", (20, 20, 9))}, 100 * 21 / 1600),
    ("visit_entropy", {}, {"coverage": cells("train", (1, 1, 5), (2, 1, 5), (3, 1, 5), (4, 1, 5))}, 2.0),
    ("visit_gini", {"phase": "validation"}, {"coverage": cells("validation", (7, 7, 3))}, 1 - 1 / 1600),
    # 0.2 m, a right angle, 0.2 m
    ("curvature", {}, {"cycles": cycles(x_m=[1.0, 1.2, 1.2], y_m=[1.0, 1.0, 1.2])}, math.pi / 2 / 0.2),
]


@pytest.mark.parametrize(("name", "settings", "tables", "value"), CASES,
                         ids=[f"{case[0]}-{i}" for i, case in enumerate(CASES)])
def test_the_value_by_hand(tmp_path, name, settings, tables, value):
    plant(tmp_path / "study", **tables)
    expected = value if isinstance(value, type(pytest.approx(1))) else pytest.approx(value)
    assert make("measure", name, **settings).of(runs_of(tmp_path / "study")) == {0: expected}


def test_levels_that_differ_more_than_seeds(tmp_path):
    """Both seeds learned 12 at low and 1 at high curiosity: all cells differ between levels, none within one. With
    exchanged levels, a seed's tables agree with the other's as often as not."""
    for seed in range(2):
        plant(tmp_path / "study", seed, policy=policy("drink", "low", dict.fromkeys(range(1, 7), 12))
              + policy("drink", "HH", dict.fromkeys(range(1, 7), 1)))
    measure = make("measure", "policy_levels", levels=["low", "HH"])
    runs = runs_of(tmp_path / "study")
    assert measure.of(runs) == {0: 100.0, 1: 100.0}
    null = measure.null(runs, 200, 0)
    assert set(null.tolist()) == {-100.0, 100.0}


def test_levels_of_which_a_seed_learned_half(tmp_path):
    """Seed 0: 12 | 1, seed 1: 12 | 12. Distances between the seeds: low-low 0, low-HH 0, HH-low 1, HH-HH 1. Of seed 0,
    other levels are (0 + 1) / 2 apart, the same ones (0 + 1) / 2: nothing; the same of seed 1."""
    for seed, high in enumerate((1, 12)):
        plant(tmp_path / "study", seed, policy=policy("drink", "low", dict.fromkeys(range(1, 7), 12))
              + policy("drink", "HH", dict.fromkeys(range(1, 7), high)))
    assert make("measure", "policy_levels", levels=["low", "HH"]).of(runs_of(tmp_path / "study")) == {0: 0.0, 1: 0.0}


def test_no_measure_is_without_a_value_by_hand():
    built_in = {spec.name for spec in registry.parts.values() if spec.group == "measure"
                and spec.origin.startswith(str(PACKAGE))}
    assert built_in == {case[0] for case in CASES} | {"policy_levels"}


def test_each_seed_and_each_condition_has_its_own(tmp_path):
    for seed in (3, 1):
        plant(tmp_path / "study", seed, episodes=episodes("validation", survival=[0.1 * seed]))
        plant(tmp_path / "study", seed, "litman", episodes=episodes("validation", survival=[1.0]))
    found = make("measure", "survival").of(runs_of(tmp_path / "study"))
    assert found == {1: pytest.approx(10.0), 3: pytest.approx(30.0)} and list(found) == [1, 3]


def test_a_seed_without_what_others_have(tmp_path):
    """A seed that never ate has no value; if nobody has one, that is said."""
    plant(tmp_path / "study", 0, cycles=cycles(hunger=falling(9, 2, 6), thirst=falling(9, 4)))
    plant(tmp_path / "study", 1, cycles=cycles(hunger=falling(9), thirst=falling(9)))
    found = make("measure", "alternation").of(runs_of(tmp_path / "study"))
    assert found[0] == pytest.approx(100 / 3) and math.isnan(found[1])
    plant(tmp_path / "hungry", 0, cycles=cycles(hunger=falling(9), thirst=falling(9)))
    with pytest.raises(CannotMeasure, match="no recorded episode has both"):
        make("measure", "alternation").of(runs_of(tmp_path / "hungry"))


@pytest.mark.parametrize(("name", "settings", "reason"), [
    ("survival", {"phase": "train"}, "there are no train episodes"),
    ("survival", {"episodes": [0, 5]}, "needs 5 validation episodes, the study has 2"),
    ("reward", {"behaviour": "eat+nap"}, "there is no behaviour nap"),
    ("policy_match", {"behaviour": "nap"}, "there is no table of a behaviour nap"),
    ("policy_match", {"behaviour": "drink", "level": "LH"}, "no curiosity level 'LH' .there are none"),
    ("coverage", {"phase": "validation"}, "no validation episodes left a coverage map"),
    ("rhythm", {}, "no cycles were recorded"),
])
def test_what_cannot_be_measured_is_said(tmp_path, name, settings, reason):
    plant(tmp_path / "study", episodes=episodes("validation", survival=[0.5, 1.0]),
          behaviours=clocks("validation", "reward", eat=[5.0, 5.0]), policy=policy("drink", "none", {1: 12}),
          coverage=cells("train", (1, 1, 1)))
    with pytest.raises(CannotMeasure, match=reason):
        make("measure", name, **settings).of(runs_of(tmp_path / "study"))


def test_a_column_that_is_not_there_gets_a_hint(tmp_path):
    plant(tmp_path / "study", episodes=episodes("validation", survival=[1.0]))
    with pytest.raises(ConfigError, match="Did you mean 'hunger_max'"):
        make("measure", "episode", column="hunger_mx").of(runs_of(tmp_path / "study"))


@pytest.mark.parametrize(("column", "unit"), [
    ("hunger_max", "UoE"), ("fatigue_mean", "UoE"), ("fatigue_max", "UoE"), ("energy_min", "UoE"), ("safety_mean", "1"),
    ("path_m", "m"), ("wanting_mean", "1"), ("cycles", "mc")])
def test_a_column_has_its_unit(column, unit):
    assert make("measure", "episode", column=column).unit == unit
