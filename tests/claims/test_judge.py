"""Verdicts follow the written rules; measures give the numbers worked out by hand."""

import math
import sys
from pathlib import Path

import pytest
import yaml

sys.path.insert(0, str(Path(__file__).parents[1] / "report"))
from small_study import write_run, write_study

from attnlab import registry
from attnlab.claims.files import Part, load_claims
from attnlab.claims.judge import _decide, judge
from attnlab.loading import load_all
from attnlab.measures.base import CannotMeasure
from attnlab.measures.policies import greedy, in_words, parse_pattern
from attnlab.results import load
from attnlab.results.conditions import Conditions
from attnlab.stats import Interval
from attnlab.stats.levels import level_contrast, level_null


@pytest.fixture(scope="module")
def conditions(tmp_path_factory):
    return Conditions(load(write_study(tmp_path_factory.mktemp("s") / "small", safety=0.3)))


def part(**fields):
    return Part(measure="survival", unit="%", **fields)


@pytest.mark.parametrize(("fields", "interval", "verdict"), [
    ({"direction": "higher"}, (2, 1, 3), "reproduced"),
    ({"direction": "higher"}, (2, -1, 3), "not reproduced"),
    ({"direction": "higher"}, (-2, -3, -1), "contradicted"),
    ({"direction": "higher"}, (0, 0, 0), "not reproduced"),
    ({"direction": "lower"}, (-2, -3, -1), "reproduced"),
    ({"direction": "higher", "number": 2.5, "tolerance": 0.5}, (2, 1, 3), "reproduced"),
    ({"direction": "higher", "number": 9, "tolerance": 0.5}, (2, 1, 3), "direction only"),
    ({"direction": "higher", "number": 9, "tolerance": 0.5}, (-2, -3, -1), "contradicted"),
    ({"direction": "higher", "reference": 5}, (2, 1, 3), "contradicted"),
    ({"direction": "at_least", "reference": 450, "test": "level"}, (450, 450, 450), "reproduced"),
    ({"direction": "at_most", "reference": 450, "test": "level"}, (500, 500, 500), "contradicted"),
    ({"direction": "about", "number": 2, "tolerance": 1}, (2.9, 0, 5), "reproduced"),
    ({"direction": "about", "number": 2, "tolerance": 1}, (3.5, 2.5, 5), "not reproduced"),
    ({"direction": "about", "number": 2, "tolerance": 1}, (5, 4, 6), "contradicted"),
    ({"test": "not_lower", "margin": 1.0}, (-0.5, -0.9, 1), "reproduced"),
    ({"test": "not_lower", "margin": 1.0}, (-0.5, -1.1, 1), "not reproduced"),
    ({"test": "not_lower", "margin": 1.0}, (-3, -4, -2), "contradicted"),
])
def test_rules(fields, interval, verdict):
    assert _decide(part(**fields), Interval(*map(float, interval)))[0] == verdict


def by_id(conditions, name="dinocera2014", **stratum):
    return {v.id: v for v in judge(load_claims(name), conditions, stratum)}


def test_known_study(conditions):
    found = by_id(conditions)
    assert found["C18"].verdict == "direction only" and found["C18"].holds
    assert found["C18"].lead.value.value == pytest.approx(0.3, abs=0.01) and found["C18"].lead.seeds == 3
    assert found["C18"].p == 0.25  # all three seeds agree: 2 of 8 sign patterns
    assert found["C9"].verdict == "reproduced" and "100 %" in found["C9"].reason
    assert found["C11"].verdict == "contradicted"  # 1 or 4 in two of six bins, guessing gives half
    assert found["C19"].verdict == "not reproduced"  # no difference at all
    assert found["C1"].verdict == "untestable" and "needs 250" in found["C1"].reason and math.isnan(found["C1"].p)
    assert all(v.p_holm >= v.p for v in found.values() if not math.isnan(v.p))


def test_too_few_seeds_are_untestable(tmp_path):
    found = by_id(Conditions(load(write_study(tmp_path / "two", seeds=2, safety=0.3))))
    assert {v.verdict for v in found.values()} == {"untestable"}
    assert "2 paired seeds, 3 are needed" in found["C18"].reason


def test_pairs_are_by_seed(tmp_path):
    for seed in (0, 1, 2, 3):
        write_run(tmp_path / "s", "litman", seed)
    for seed in (1, 2, 3, 9):
        write_run(tmp_path / "s", "none", seed)
    assert by_id(Conditions(load(tmp_path / "s")))["C18"].lead.seeds == 3


def test_own_claims_on_a_swept_setting_and_a_plugin_measure(tmp_path):
    from attnlab.measures.base import Measure

    class Fives(Measure):
        """Five for every seed."""
        unit = "fives"

        def of(self, runs):
            return dict.fromkeys(runs.runs, 5.0)
    registry.register("measure", "fives_for_a_test")(Fives)
    try:
        for learner in ("fast", "slow"):
            write_study(tmp_path / "s", curiosities=("none",), swept={"learner": learner})
        rules = {"roles": {r: {"where": {"learner": v}} for r, v in (("treatment", "fast"), ("control", "slow"))},
                 "claims": {"mine": {"title": "t", "where": "w", "says": "s", "parts": [
                     {"measure": "fives_for_a_test", "test": "level", "role": "control", "direction": "about",
                      "number": 5, "tolerance": 0, "unit": "fives"}]}}}
        file = tmp_path / "mine.yaml"
        file.write_text(yaml.safe_dump(rules))
        found = by_id(Conditions(load(tmp_path / "s")), str(file))
        assert found["mine"].verdict == "reproduced" and "control 5 fives" in found["mine"].reason
    finally:
        del registry.parts["measure", "fives_for_a_test"]


def test_policies(conditions):
    runs = conditions.runs("none")
    assert greedy(runs, "drink")[0] == {1: 12, 2: 12, 3: 12, 4: 12, 5: 1, 6: 1}
    assert in_words({1: 12, 2: 12, 3: 12, 4: 12, 5: 1, 6: 1}) == "12 in bins 1-4, 1 in bins 5-6"
    assert in_words({2: 8, 4: 8}) == "8 in bin 2, 8 in bin 4" and in_words({}) == "never visited"
    assert parse_pattern({"1-2": 12, 3: [1, 4]}) == {1: (12,), 2: (12,), 3: (1, 4)}
    with pytest.raises(CannotMeasure, match="no curiosity level 'HH'"):
        greedy(runs, "drink", "HH")
    with pytest.raises(CannotMeasure, match="sleep"):
        greedy(runs, "sleep")


def test_a_learner_that_does_not_learn_has_no_policy(tmp_path):
    import pyarrow as pa
    import pyarrow.parquet as pq
    file = write_run(tmp_path / "s", "none", 0) / "policy.parquet"
    table = pq.read_table(file)
    flat = pa.array([0.0] * len(table))
    pq.write_table(table.set_column(table.schema.get_field_index("q"), "q", flat), file)
    assert greedy(Conditions(load(tmp_path / "s")).runs("none"), "drink") == {0: {}}


def test_levels_that_matter_and_levels_that_do_not():
    import numpy as np
    rng = np.random.default_rng(0)
    differ = np.stack([np.stack([np.full(12, 1), np.full(12, 4), np.full(12, 12)])] * 4)
    assert level_contrast(differ).tolist() == [1.0] * 4
    assert (level_null(differ, 500).mean() < 0.4) and (level_null(differ, 500) >= 1.0).mean() < 0.03
    alike = rng.choice([1, 4, 8, 12], (6, 3, 12))
    null = level_null(alike, 500)
    assert (null >= level_contrast(alike).mean()).mean() > 0.02


@pytest.mark.parametrize(("node", "value"), [
    ({"name": "coverage"}, 100 * 100 / 1600),  # 10 x 10 cells of 40 x 40 in seed 0
    ({"name": "energy_margin", "of": "max"}, 4600 - 3067), ({"name": "alternation"}, 100 / 3),
    ({"name": "activations", "behaviour": "avoid", "minus": "avoid"}, 0.0),
    ({"name": "episode", "column": "active_cycles"}, 40.0), ({"name": "curvature"}, 1.0),
])
def test_measures_by_hand(conditions, node, value):
    load_all()
    # alternation: drinks at 30 and 90, a meal at 60: both neighbours differ, 2 * 1 * 2 / (3 * 2) expected
    measured = registry.make("measure", node, None).of(conditions.runs("litman"))
    assert measured[0] == pytest.approx(value, rel=0.03)


def test_overlap(conditions):
    load_all()
    overlap = registry.make("measure", {"name": "overlap"}, None).of(conditions.runs("none"))
    assert 20 < overlap[0] < 45  # 54 to 69 activations in 40 cycles
    excess = registry.make("measure", {"name": "overlap_excess"}, None).of(conditions.runs("none"))
    assert excess[0] < 0  # the three clocks never meet
