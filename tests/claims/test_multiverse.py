"""The design of readings is valid, balanced and seeded; its report finds an effect that was put in."""

import sys
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "report"))
import attnlab
from attnlab.claims.files import load_claims
from attnlab.claims.judge import judge
from attnlab.claims.roles import strata
from attnlab.errors import ConfigError
from attnlab.launch.multiverse import balanced, design, imbalance, load_factors
from attnlab.launch.variants import read_variants
from attnlab.reading import Reading
from attnlab.report import curve, curve_tables, multiverse, spread, told
from attnlab.results import load
from attnlab.results.conditions import Conditions
from attnlab.tables.flat import dig
from tests.report.small_study import write_run, write_study


def test_64_readings_are_valid_and_balanced():
    readings, factors = design(64, seed=0), load_factors()
    assert len(readings) == 64 and len(factors) >= 12
    for overrides in readings:
        Reading(**{name.removeprefix("reading."): value for name, value in overrides.items()
                   if name.startswith("reading.")})
    for levels in factors.values():
        names = next(iter(levels.values()))
        counts = Counter(tuple(reading[name] for name in names) for reading in readings)
        assert len(counts) == len(levels) and max(counts.values()) - min(counts.values()) <= 1
    assert len({tuple(reading.items()) for reading in readings}) == 64


def test_seeded():
    assert design(20, seed=3) == design(20, seed=3) != design(20, seed=4)


def test_pairs_are_evener_than_by_chance():
    levels = [2] * 12 + [3] * 3
    rng = np.random.default_rng(1)
    random = np.column_stack([rng.permutation(np.arange(64) % n) for n in levels])
    assert imbalance(balanced(levels, 64, 0)) <= 0.5 * imbalance(random)


def test_first_level_is_the_default_reading():
    config = attnlab.compose()
    for levels in load_factors().values():
        for name, value in next(iter(levels.values())).items():
            default = dig(config, name)
            assert (default["name"] if isinstance(default, dict) else default) == value


@pytest.mark.parametrize(("text", "words"), [
    ("a: {x: {reading.crash: contact}}", "two levels"), ("[]", "open points"), ("a: [", "cannot be read"),
    ("a: {x: {reading.krash: contact}, y: {reading.krash: contact}}", "reading.crash"),
    ("a: {x: {reading.crash: contact}, y: {reading.q_update: smdp}}", "same settings"),
    ("a: {x: {reading.crash: contact}, y: {reading.crash: sometimes}}", "not one of its values"),
    ("a: {x: {reading.need_k: 1}, y: {reading.need_k: 2}}\nb: {x: {reading.need_k: 1}, y: {reading.need_k: 3}}",
     "b: sets reading.need_k, and so does a"),
])
def test_bad_factors(tmp_path, text, words):
    path = tmp_path / "points.yaml"
    path.write_text(text)
    with pytest.raises(ConfigError, match=words):
        design(4, factors=path)


def test_readings_under_several_conditions():
    conditions = {"cr": {"curiosity": "litman"}, "ncr": {"curiosity": "none", "reading.non_curious": "plain"}}
    found = read_variants({"design": "multiverse", "size": 4, "conditions": conditions})
    assert list(found)[:3] == ["r0 cr", "r0 ncr", "r1 cr"] and len(found) == 8
    assert found["r2 ncr"] == {**design(4)[2], **conditions["ncr"]}
    with pytest.raises(ConfigError, match=r"conditions.cr.reading.crash: is set by a factor of the design, too"):
        read_variants({"design": "multiverse", "size": 4, "conditions": {
            "cr": {"reading.crash": "contact"}, "ncr": {"curiosity": "none"}}})
    with pytest.raises(ConfigError, match="expected two"):
        read_variants({"design": "multiverse", "size": 4, "conditions": {"cr": {}}})


def test_conditions_of_a_reading_are_one_combination(tmp_path):
    """Variants that differ in settings of the roles alone: named by what they share."""
    for reading, k in (("r0", 1), ("r1", 2)):
        for name, curiosity, states in (("cr", "litman", "plain"), ("plain", "none", "plain"),
                                        ("same", "none", "same_states")):
            write_study(tmp_path / "s", 1, (curiosity,), swept={
                "variant": f"{reading} {name}", "reading.need_k": k, "reading.non_curious": states})
    found = strata(load_claims("dinocera2014"), Conditions(load(tmp_path / "s")))
    assert found == {"r0": {"reading.need_k": "1"}, "r1": {"reading.need_k": "2"}}


@pytest.fixture(scope="module")
def twelve(tmp_path_factory):
    """Twelve readings; CR is safer by 0.3 with crash=safety_distance and less safe by 0.3 with contact."""
    study = tmp_path_factory.mktemp("twelve") / "study"
    for i in range(12):
        swept = {"reading.crash": ("contact", "safety_distance")[i % 2], "reading.need_k": (1, 2, 3)[i % 3],
                 "reading.energy_start": (4600, 4500)[i // 6], "reading.energy_max": (4600, 6000)[i // 6]}
        for seed in range(6):
            for curiosity in ("litman", "none"):
                write_run(study, curiosity, seed, train=2, validation=2, cycles=24, swept=swept,
                          safety=0.3 if i % 2 else -0.3, name=f"{curiosity}-{i}-{seed}")
    conditions, claims = Conditions(load(study)), load_claims("dinocera2014")
    claims.claims = {key: claims.claims[key] for key in ("C1", "C18")}
    combinations = strata(claims, conditions)
    measured = {name: {} for name in combinations}
    judged = {name: judge(claims, conditions, settings, measured[name]) for name, settings in combinations.items()}
    return combinations, judged, multiverse.analyse(claims, conditions, combinations, judged, measured)


def test_an_effect_that_was_put_in_is_found(twelve):
    combinations, judged, found = twelve
    assert len(found.names) == 12
    assert set(found.levels) == {"crash", "need_k", "energy_start + energy_max"}
    moved = {(e.factor, e.level): e for e in found.moved if e.claim == "C18"}
    put_in = moved["crash", "safety_distance"]
    assert put_in.difference == 1.0 and put_in.default == "contact"
    assert moved["need_k", "2"].difference == 0.0
    assert found.share(list(found.claims).index("C18")) == (0.5, 12)
    assert found.share(list(found.claims).index("C1"))[1] == 0
    (comparisons, moves), claims = told.sections(found), spread.section(found)
    assert "crash=safety_distance +100" in claims.html and "crash 100 %" in moves.html
    assert "hangs on crash" in comparisons.html and "all 64 exchanges of 6 seeds" in comparisons.html
    screen = told.first_screen(found)
    assert "safety mean</b> [C18], CR against NCR, hangs on crash: higher, as claimed, with safety_distance 6 of 6; " \
        "with contact 0 of 6." in screen
    assert len(curve_tables.combinations_csv(combinations, judged).decode().splitlines()) == 13


def test_signed_effects_and_their_joint_test(twelve):
    found = twelve[2].curves
    assert [(of.claim, of.whom) for of in found.contrasts] == [("C18", "NCR")]  # C1 has no values in so few episodes
    safety = 0
    assert found.differences.shape == (12, 1, 6)
    # half of the readings say so clearly, half the opposite: the median is between, and the curve says nothing together
    assert found.joint.clear[safety] == 6 and found.joint.opposite[safety] == 6
    assert found.mover(safety) == ("crash", pytest.approx(1.0, abs=0.1))
    assert (found.low[:, safety] < found.effects[:, safety]).all()
    rows = curve_tables.curve_csv(twelve[2], found).decode().splitlines()
    assert rows[0].startswith("measure,claim,role,against,reading,effect_d") and len(rows) == 1 + 12
    assert curve_tables.joint_csv(twelve[2], found).decode().count("\n") == 2


def test_its_figures_are_drawn(twelve):
    from attnlab.figures.style import drawing
    with drawing():
        found = twelve[2]
        for figure in (curve.curves(found.curves), curve.dashboard(found, found.curves, 0), curve.shares(found)):
            assert figure.axes
