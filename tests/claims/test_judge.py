"""Verdicts follow the written rules, on studies whose numbers are known."""

import math
import sys
from pathlib import Path

import numpy as np
import pytest
import yaml

sys.path.insert(0, str(Path(__file__).parents[1] / "report"))
from attnlab import registry
from attnlab.claims import rules as decide
from attnlab.claims.files import load_claims
from attnlab.claims.findings import RANK, WORST_FIRST, Finding
from attnlab.claims.judge import judge
from attnlab.claims.parts import Part, Rules
from attnlab.claims.roles import strata
from attnlab.measures.base import CannotMeasure
from attnlab.measures.policies import greedy, in_words, parse_pattern
from attnlab.results import load
from attnlab.results.conditions import Conditions
from attnlab.stats import Ends
from attnlab.stats.levels import level_contrast, level_null
from attnlab.tables.files import read_json, write_json
from tests.report.small_study import write_run, write_study


@pytest.fixture(scope="module")
def conditions(tmp_path_factory):
    return Conditions(load(write_study(tmp_path_factory.mktemp("s") / "small", safety=0.3)))


def part(**fields):
    return Part(measure="survival", unit="%", **fields)


HIGHER = {"direction": "higher"}


@pytest.mark.parametrize(("fields", "interval", "finding"), [
    (HIGHER, (2, 1, 3), "direction only"),
    (HIGHER, (2, -1, 3), "not reproduced"),
    (HIGHER, (-2, -3, -1), "contradicted"),
    (HIGHER, (0, 0, 0), "not reproduced"),
    ({"direction": "lower"}, (-2, -3, -1), "direction only"),
    # the whole interval within 2.5 +- 1.6; touching 2.5 +- 0.5; away from 9 +- 0.5; precision not known
    ({**HIGHER, "number": 2.5, "tolerance": 1.6}, (2, 1, 3), "reproduced"),
    ({**HIGHER, "number": 2.5, "tolerance": 0.5}, (2, 1, 3), "direction, number compatible"),
    ({**HIGHER, "number": 9, "tolerance": 0.5}, (2, 1, 3), "direction only"),
    ({**HIGHER, "number": 2}, (2, 1, 3), "direction only"),
    # the mean is on the number, but the interval allows no effect
    ({**HIGHER, "number": 2, "tolerance": 9}, (2, -1, 5), "not reproduced"),
    ({**HIGHER, "number": 9, "tolerance": 0.5}, (-2, -3, -1), "contradicted"),
    ({**HIGHER, "reference": 5}, (2, 1, 3), "contradicted"),
    ({"direction": "at_least", "reference": 450, "test": "level"}, (450, 450, 450), "direction only"),
    ({"direction": "at_most", "reference": 450, "test": "median"}, (500, 500, math.inf), "contradicted"),
    ({"direction": "at_most", "reference": 450, "test": "median"}, (400, 300, math.inf), "not reproduced"),
    ({"number": 300, "tolerance": 50, "test": "median"}, (300, 250, 350), "reproduced"),
    ({"number": 2, "tolerance": 1}, (2.9, 0, 5), "not reproduced"),
    ({"number": 2, "tolerance": 1}, (2.5, 1.5, 3), "reproduced"),
    ({"number": 2, "tolerance": 1}, (5, 4, 6), "contradicted"),
    ({"test": "not_lower", "margin": 1.0}, (-0.5, -0.9, 1), "reproduced"),
    ({"test": "not_lower", "margin": 1.0}, (-0.5, -1.1, 1), "not reproduced"),
    ({"test": "not_lower", "margin": 1.0}, (-3, -4, -2), "contradicted"),
])
def test_the_finding_of_an_interval(fields, interval, finding):
    ends = Ends(*(np.array(float(x)) for x in interval), np.array(0.0))
    assert WORST_FIRST[int(decide.grade(part(**fields), ends)[0])] == finding


def fare(parts, findings, p, seeds=20):
    code, each = decide.together(parts, [np.array([RANK[f]]) for f in findings], [np.array([x]) for x in p], seeds,
                                 Rules())
    return WORST_FIRST[int(code[0])], [WORST_FIRST[int(one[0])] for one in each]


def test_a_claim_fares_as_its_worst_comparison():
    plain, sized = part(**HIGHER), part(**HIGHER, number=2, tolerance=1)
    f = Finding
    assert fare([plain, sized], [f.DIRECTION, f.REPRODUCED], [0.01, 0.01])[0] is f.REPRODUCED
    assert fare([plain, sized], [f.DIRECTION, f.COMPATIBLE], [0.01, 0.01])[0] is f.COMPATIBLE
    assert fare([plain, sized], [f.DIRECTION, f.DIRECTION], [0.01, 0.01])[0] is f.DIRECTION
    assert fare([plain, plain], [f.DIRECTION, f.DIRECTION], [0.01, 0.01])[0] is f.DIRECTION
    assert fare([plain, sized], [f.NOT, f.REPRODUCED], [0.5, 0.01])[0] is f.NOT
    assert fare([plain, plain], [f.UNTESTABLE, f.NOT], [math.nan, 0.5])[0] is f.UNTESTABLE


def test_a_comparison_contradicts_only_after_holm_and_with_enough_seeds():
    one, f = part(**HIGHER), Finding
    assert fare([one], [f.CONTRADICTED], [0.03])[0] is f.CONTRADICTED
    # two comparisons: 2 * 0.03 is not below 0.05, 2 * 0.02 is
    assert fare([one, one], [f.CONTRADICTED, f.DIRECTION], [0.03, 0.2]) == (f.NOT, [f.NOT, f.DIRECTION])
    assert fare([one, one], [f.CONTRADICTED, f.DIRECTION], [0.02, 0.2])[0] is f.CONTRADICTED
    # 0.01 * 2, and then the other on its own
    assert fare([one, one], [f.CONTRADICTED, f.CONTRADICTED], [0.01, 0.04])[1] == [f.CONTRADICTED] * 2
    assert fare([one, one], [f.CONTRADICTED, f.DIRECTION], [0.001, 0.2], seeds=7)[0] is f.NOT
    assert fare([one], [f.CONTRADICTED], [0.001], seeds=7)[0] is f.CONTRADICTED


def by_id(conditions, name="dinocera2014", **stratum):
    return {v.id: v for v in judge(load_claims(name), conditions, stratum)}


def test_known_study(conditions):
    found = by_id(conditions)
    # 0.3 is not 0.23, but within 0.115 of it
    assert found["C18"].verdict is Finding.REPRODUCED and found["C18"].holds
    lead = found["C18"].lead
    assert lead.value.value == pytest.approx(0.3, abs=0.01) and lead.seeds == 6
    assert lead.bca[0] == pytest.approx(lead.value.low, abs=0.002)
    assert lead.p_flip == 2 / 64  # all six seeds agree: 2 of 64 sign patterns
    # a claim's p is that of the comparison that decided
    assert all(v.p == v.lead.p for v in found.values() if v.verdict is not Finding.UNTESTABLE)
    assert lead.forms == {"from AVOID's last percept": Finding.NOT} and "hangs on the form" in found["C18"].reason
    assert found["C9"].verdict is Finding.REPRODUCED and "100 %" in found["C9"].reason
    assert found["C11"].verdict is Finding.NOT  # 1 or 4 in two of six bins, guessing gives half; six seeds only
    assert found["C19"].verdict is Finding.NOT  # no difference at all
    assert found["C1"].verdict is Finding.UNTESTABLE and "needs 250" in found["C1"].reason
    assert math.isnan(found["C1"].p)
    assert found["C27"].verdict is Finding.UNTESTABLE and "NCR with CR's states" in found["C27"].reason
    assert all(v.p_holm >= v.p for v in found.values() if not math.isnan(v.p))
    assert all(v.worst is None for v in found.values())


def test_too_few_seeds_are_untestable(tmp_path):
    found = by_id(Conditions(load(write_study(tmp_path / "five", seeds=5, safety=0.3))))
    assert {v.verdict for v in found.values()} == {"untestable"}
    assert "5 paired seeds, 6 are needed" in found["C18"].reason


def test_pairs_are_by_seed(tmp_path):
    for seed in range(7):
        write_run(tmp_path / "s", "litman", seed)
    for seed in (1, 2, 3, 4, 5, 6, 9):
        write_run(tmp_path / "s", "none", seed)
    assert by_id(Conditions(load(tmp_path / "s")))["C18"].lead.seeds == 6


def test_runs_that_failed_count_as_the_least_favourable_ones(tmp_path):
    """Six seeds by 0.25 and one by 0.02, ten more failed: with 0.02 for each of these the mean is 0.10 +- 0.06, which
    0.23 +- 0.115 still touches."""
    study = tmp_path / "s"
    for seed in range(17):
        write_run(study, "none", seed)
        folder = write_run(study, "litman", seed, safety=0.02 if seed == 0 else 0.25)
        if seed >= 7:
            about = read_json(folder / "run.json")
            write_json(folder / "run.json", {**about, "status": "failed", "error": "broken"})
    found = by_id(Conditions(load(study)))["C18"]
    assert found.lead.seeds == 7 and found.verdict is Finding.REPRODUCED
    assert found.worst is Finding.COMPATIBLE


def test_a_study_of_another_world_gets_no_verdicts(tmp_path):
    study = tmp_path / "s"
    for seed in range(6):
        for curiosity in ("litman", "none"):
            write_run(study, curiosity, seed, world={"name": "open"}, safety=0.3)
    found = by_id(Conditions(load(study)))
    assert {v.verdict for v in found.values()} == {"untestable"}
    assert {v.reason for v in found.values()} == {"these claims are about world=paper, these runs have world=open"}


def test_roles_told_apart_by_two_settings_are_one_combination(tmp_path):
    """CR, NCR and NCR with CR's states in one study: settings of the roles split nothing."""
    study = tmp_path / "s"
    write_study(study, safety=0.3, swept={"reading.non_curious": "plain"})
    write_study(study, curiosities=("none",), swept={"reading.non_curious": "same_states"})
    conditions = Conditions(load(study))
    claims = load_claims("dinocera2014")
    assert strata(claims, conditions) == {"": {}}
    found = by_id(conditions)
    assert found["C18"].verdict is Finding.REPRODUCED
    assert "no complete run" not in found["C27"].reason


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
            write_study(tmp_path / "s", curiosities=("none",), swept={"learner.alpha": learner})
        rules = {"roles": {"slowly": {"label": "slowcoach", "where": {"learner.alpha": "slow"}}},
                 "claims": {"mine": {"title": "t", "where": "w", "says": "s", "parts": [
                     {"measure": "fives_for_a_test", "test": "level", "role": "slowly", "number": 5,
                      "tolerance": 0, "unit": "fives"}]}}}
        file = tmp_path / "mine.yaml"
        file.write_text(yaml.safe_dump(rules))
        found = by_id(Conditions(load(tmp_path / "s")), str(file))
        assert found["mine"].verdict is Finding.REPRODUCED and "slowcoach 5 fives" in found["mine"].reason
    finally:
        del registry.parts["measure", "fives_for_a_test"]


def test_policies(conditions):
    runs = conditions.runs("none")
    assert greedy(runs, "drink")[0] == {1: 12, 2: 12, 3: 12, 4: 12, 5: 1, 6: 1}
    assert greedy(runs, "drink", least_visits=21)[0] == {}  # 2 periods of 2 actions with 5 visits each
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
    rng = np.random.default_rng(0)
    differ = np.stack([np.stack([np.full(12, 1), np.full(12, 4), np.full(12, 12)])] * 4)
    assert level_contrast(differ).tolist() == [1.0] * 4
    assert (level_null(differ, 500).mean() < 0.4) and (level_null(differ, 500) >= 1.0).mean() < 0.03
    alike = rng.choice([1, 4, 8, 12], (6, 3, 12))
    null = level_null(alike, 500)
    assert (null >= level_contrast(alike).mean()).mean() > 0.02
