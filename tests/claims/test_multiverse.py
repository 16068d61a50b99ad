"""The design of readings is valid, balanced and seeded; its report finds an effect that was put in."""

import sys
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "report"))
from attnlab.claims.files import load_claims
from attnlab.claims.judge import judge
from attnlab.claims.roles import strata
from attnlab.errors import ConfigError
from attnlab.launch.multiverse import balanced, design, imbalance, load_factors
from attnlab.reading import Reading
from attnlab.results import load
from attnlab.results.conditions import Conditions
from tests.report.small_study import write_run


def test_64_readings_are_valid_and_balanced():
    readings, factors = design(64, seed=0), load_factors()
    assert len(readings) == 64 and len(factors) >= 12
    for overrides in readings:
        Reading(**{name.partition(".")[2]: value for name, value in overrides.items()})
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
    for levels in load_factors().values():
        for name, value in next(iter(levels.values())).items():
            assert getattr(Reading(), name.partition(".")[2]) == value


@pytest.mark.parametrize(("text", "words"), [
    ("a: {x: {reading.crash: contact}}", "two levels"), ("[]", "open points"), ("a: [", "cannot be read"),
    ("a: {x: {reading.krash: contact}, y: {reading.krash: contact}}", "reading.crash"),
    ("a: {x: {reading.crash: contact}, y: {reading.q_update: smdp}}", "same settings"),
    ("a: {x: {reading.crash: contact}, y: {reading.crash: sometimes}}", "not one of its values"),
])
def test_bad_factors(tmp_path, text, words):
    path = tmp_path / "points.yaml"
    path.write_text(text)
    with pytest.raises(ConfigError, match=words):
        design(4, factors=path)


def test_an_effect_that_was_put_in_is_found(tmp_path):
    from attnlab.report import multiverse
    study = tmp_path / "study"
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
    judged = {name: judge(claims, conditions, settings) for name, settings in combinations.items()}
    found = multiverse.analyse(combinations, judged)
    assert len(found.names) == 12
    assert set(found.levels) == {"crash", "need_k", "energy_start + energy_max"}
    effects = {(e.factor, e.level): e for e in found.effects if e.claim == "C18"}
    moved = effects["crash", "safety_distance"]
    assert moved.difference == 1.0 and moved.clear and moved.default == "contact"
    assert not effects["need_k", "2"].clear
    row = found.ids.index("C18")
    assert found.share(row)[0] == 0.5 and found.share(row)[3] == 12
    assert found.share(found.ids.index("C1"))[3] == 0
    html = multiverse.section(found).html
    assert "crash=safety_distance +100 [100, 100]" in html
    assert len(multiverse.combinations_csv(combinations, judged).decode().splitlines()) == 13
