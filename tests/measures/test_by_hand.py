"""Every measure on a tiny study, against a value worked out by hand."""

import math

import pytest
from planted import cells, clocks, episodes, plant, policy, runs_of

from attnlab import registry
from attnlab.errors import ConfigError
from attnlab.measures.base import CannotMeasure
from attnlab.paths import PACKAGE
from attnlab.testing import make


def paid(phase: str, penalty: list | None = None, **behaviours: list) -> list:
    """Rows of ``behaviours``: a reward an episode, half a point of it intrinsic, the first one with the penalty."""
    rows = clocks(phase, "reward", **behaviours)
    first = next(iter(behaviours))
    return [{**row, "reward_extrinsic": row["reward"] - 0.5,
             "penalty": penalty[row["episode"]] if penalty and row["behaviour"] == first else 0.0} for row in rows]


def near(x: int, y: int) -> bool:
    """Is the middle of a cell within 0.25 m of the obstacle at (1.2, 2.8) or of the food at (0.25, 1.0)?"""
    for cx, cy in ((1.2, 2.8), (0.25, 1.0)):
        dx, dy = (max(abs((i + 0.5) * 0.1 - c) - 0.25, 0.0) for i, c in ((x, cx), (y, cy)))
        if math.hypot(dx, dy) <= 0.25 + 1e-9:
            return True
    return False


PENALISED = {"behaviours": paid("validation", avoid=[10.0, 20.0], eat=[10.0, 10.0], penalty=[0.0, -1500.0]),
             "episodes": episodes("validation", death=["none", "crash"])}
# 40 cells of 0.1 m a side; a centre in the middle of a cell is 0.05, 0.15, 0.25 ... m from a wall, so the three nearest
# are too near (0.25 touches): 34 x 34. A cube of 0.5 m at (1.2, 2.8) keeps off centres within 0.25 m of it.
REACHABLE = 34 ** 2 - sum(near(x, y) for x in range(3, 37) for y in range(3, 37))

CASES = [  # measure, its settings, the tables, the value by hand
    ("survival", {}, {"episodes": episodes("validation", survival=[0.5, 1.0])}, 75.0),
    ("survival", {"phase": "train", "episodes": [1, 3]},
     {"episodes": episodes("train", survival=[0.0, 0.6, 0.8, 1.0])}, 70.0),
    # blocks of two: 50 %, 100 %, 100 %; the first one from which all are at 99.5 % begins after two episodes
    ("survival_convergence", {"block": 2, "episodes": [0, 6]},
     {"episodes": episodes("train", survival=[0.4, 0.6, 1.0, 1.0, 1.0, 1.0])}, 2.0),
    ("survival_convergence", {"block": 2, "episodes": [0, 4]},
     {"episodes": episodes("train", survival=[1.0, 1.0, 1.0, 0.9])}, math.inf),  # never
    ("episode", {"column": "hunger_max", "phase": "train"},
     {"episodes": episodes("train", hunger_max=[600.0, 800.0])}, 700.0),
    ("energy_margin", {"of": "min"}, {"episodes": episodes("validation", energy_min=[3167.0, 3017.0])}, 25.0),
    ("energy_margin", {"of": "max"}, {"episodes": episodes("validation", energy_max=[3067.0])}, 0.0),
    # E_well is 3067
    ("above_well", {}, {"episodes": episodes("validation", energy_min=[3067.0, 3066.0, 4000.0, 100.0])}, 50.0),
    # seven bouts, each after one of the other kind: 6 of 6, at most 7 / 12 by chance; four bouts do not count
    ("alternation", {}, {"episodes": episodes("validation", bouts=[7, 4], bout_switches=[6, 0])}, 100 * (1 - 7 / 12)),
    ("alternation", {"least": 4}, {"episodes": episodes("validation", bouts=[5, 4], bout_switches=[2, 3])},
     100 * ((2 / 4 - 5 / 8) + (1 - 4 / 6)) / 2),
    ("bout_variation", {}, {"episodes": episodes("validation", bouts=[7, 6, 3], bout_interval_mean=[100.0, 50.0, 1.0],
                                                 bout_interval_sd=[10.0, 15.0, 9.0])}, 20.0),
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
    ("overlap_excess", {}, {"behaviours": clocks("validation", "activations", avoid=[100], eat=[100]),
                            "episodes": episodes("validation", active_cycles=[100], cycles=[400])}, 50.0 - 12.5),
    # and never together in a second episode: 0 - 12.5
    ("overlap_excess", {}, {"behaviours": clocks("validation", "activations", avoid=[100, 100], eat=[100, 100]),
                            "episodes": episodes("validation", active_cycles=[100, 200], cycles=[400, 400])}, 12.5),
    ("policy_match", {"pattern": {"1-4": 12, "5-6": 1}},
     {"policy": policy("drink", "none", {1: 12, 2: 12, 3: 12, 4: 12, 5: 1, 6: 1})}, 100.0),
    ("policy_match", {"pattern": {"1-6": [1, 4]}, "level": "low"},
     {"policy": policy("drink", "low", {1: 12, 2: 4, 3: 12, 4: 1, 5: 1, 6: 12})
      + policy("drink", "HH", dict.fromkeys(range(1, 7), 1))}, 50.0),
    # who always takes 12 agrees in four bins of six
    ("policy_match", {"pattern": {"1-4": 12, "5-6": 1}},
     {"policy": policy("drink", "none", dict.fromkeys(range(1, 7), 12))}, 100 * 4 / 6),
    ("reward", {}, {"behaviours": paid("validation", avoid=[10.0, 20.0], eat=[5.0, 5.0])}, 20.0),
    # a death in the second episode: 30 - 1500 with its penalty, 30 without it, and one episode survived
    ("reward", {}, PENALISED, (20.0 + 30.0 - 1500.0) / 2),
    ("reward", {"penalties": False}, PENALISED, 25.0),
    ("reward", {"survived": True}, PENALISED, 20.0),
    ("reward", {"behaviour": "eat", "extrinsic": True, "phase": "train", "episodes": [1, 2]},
     {"behaviours": paid("train", avoid=[10.0, 20.0], eat=[5.0, 7.0])}, 7.0 - 0.5),
    ("reward_rise", {"early": [0, 2], "late": [2, 3]},
     {"behaviours": paid("train", avoid=[10.0, 20.0, 40.0], eat=[1.0, 1.0, 1.0])}, 25.0),
    # end level 10; blocks of two: 1, 9.5, 10, and 90 % of the end level is 9
    ("reward_convergence", {"block": 2, "end": 2, "episodes": [0, 6]},
     {"behaviours": paid("train", avoid=[0.0, 2.0, 9.0, 10.0, 10.0, 10.0])}, 2.0),
    # the last block is below 90 % of the end level 8: never
    ("reward_convergence", {"block": 2, "end": 4, "episodes": [0, 6]},
     {"behaviours": paid("train", avoid=[9.0, 9.0, 10.0, 10.0, 6.0, 6.0])}, math.inf),
    ("coverage", {}, {"coverage": cells("train", *((x, 3, 1) for x in range(16)))}, 1.0),  # 16 of 40 x 40 cells
    # a body of 0.25 m in the middle of a cell touches 5 x 5 cells without the corners
    ("coverage", {"footprint": True}, {"coverage": cells("train", (20, 20, 9))}, 100 * 21 / 1600),
    ("visit_entropy", {}, {"coverage": cells("train", (1, 1, 5), (2, 1, 5), (3, 1, 5), (4, 1, 5))}, 2.0),
    ("visit_gini", {"phase": "validation"}, {"coverage": cells("validation", (7, 7, 3))}, 1 - 1 / 1600),
    # all 1600 cells but those within 0.25 m of the walls and of two cubes: see test_the_floor_that_can_be_reached
    ("coverage", {"of": "reachable"}, {"coverage": cells("train", (20, 20, 9), (25, 20, 1))}, 100 * 2 / REACHABLE),
    ("curvature", {}, {"episodes": episodes("validation", turn_rad=[30.0, 20.0, 5.0], path_m=[20.0, 10.0, 0.0])}, 1.75),
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
    few = make("measure", "policy_levels", levels=["low", "HH"], least_visits=16)  # three periods of five visits each
    assert all(math.isnan(value) for value in few.of(runs_of(tmp_path / "study")).values())
    measure = make("measure", "policy_levels", levels=["low", "HH"], least_visits=5)
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
    measure = make("measure", "policy_levels", levels=["low", "HH"], least_visits=5)
    assert measure.of(runs_of(tmp_path / "study")) == {0: 0.0, 1: 0.0}


def test_no_measure_is_without_a_value_by_hand():
    built_in = {spec.name for spec in registry.parts.values() if spec.group == "measure"
                and spec.origin.startswith(str(PACKAGE))}
    assert built_in == {case[0] for case in CASES} | {"policy_levels", "toy"}  # of tables of toys: tests/toys


def test_each_seed_and_each_condition_has_its_own(tmp_path):
    for seed in (3, 1):
        plant(tmp_path / "study", seed, episodes=episodes("validation", survival=[0.1 * seed]))
        plant(tmp_path / "study", seed, "litman", episodes=episodes("validation", survival=[1.0]))
    found = make("measure", "survival").of(runs_of(tmp_path / "study"))
    assert found == {1: pytest.approx(10.0), 3: pytest.approx(30.0)} and list(found) == [1, 3]


def test_a_seed_without_what_others_have(tmp_path):
    """A seed with too few bouts has no value; if nobody has one, that is said."""
    for seed, bouts in enumerate((6, 5)):
        plant(tmp_path / "study", seed, episodes=episodes("validation", bouts=[bouts], bout_switches=[5]))
    found = make("measure", "alternation").of(runs_of(tmp_path / "study"))
    assert found[0] == pytest.approx(40.0) and math.isnan(found[1])
    plant(tmp_path / "hungry", 0, episodes=episodes("validation", bouts=[1], bout_switches=[0]))
    with pytest.raises(CannotMeasure, match="no validation episode has 6 bouts"):
        make("measure", "alternation").of(runs_of(tmp_path / "hungry"))


def test_a_bin_that_was_never_visited_has_no_period(tmp_path):
    plant(tmp_path / "study", policy=policy("drink", "none", {1: 12, 2: 12, 3: 12, 4: 12, 5: 1}))
    with pytest.raises(CannotMeasure, match="no seed visited all 6 bins"):
        make("measure", "policy_match", pattern={"1-4": 12, "5-6": 1}).of(runs_of(tmp_path / "study"))


@pytest.mark.parametrize(("name", "settings", "reason"), [
    ("survival", {"phase": "train"}, "there are no train episodes"),
    ("survival", {"episodes": [0, 5]}, "needs 5 validation episodes, the study has 2"),
    ("reward", {"behaviour": "eat+nap"}, "there is no behaviour nap"),
    ("policy_match", {"behaviour": "nap"}, "there is no table of a behaviour nap"),
    ("policy_match", {"behaviour": "drink", "level": "LH"}, "no curiosity level 'LH' .there are none"),
    ("coverage", {"phase": "validation"}, "no validation episodes left a coverage map"),
    ("bout_variation", {}, "no validation episode has 6 bouts"),
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
        make("measure", "episode", column="hunger_mx")
    with pytest.raises(ConfigError, match="episodes has no number column 'fatigue_max'"):
        make("measure", "episode", column="fatigue_max").of(runs_of(tmp_path / "study"))


@pytest.mark.parametrize(("column", "unit"), [
    ("hunger_max", "UoE"), ("fatigue_mean", "UoE"), ("fatigue_max", "UoE"), ("energy_min", "UoE"), ("safety_mean", "1"),
    ("path_m", "m"), ("wanting_mean", "1"), ("cycles", "mc")])
def test_a_column_has_its_unit(column, unit):
    assert make("measure", "episode", column=column).unit == unit
