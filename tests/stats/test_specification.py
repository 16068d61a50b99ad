"""The joint test of a specification curve, by hand, on planted multiverses, and in its uniformity."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from attnlab.stats.specification import joint_test, standardised, variance_shares


def test_two_readings_by_hand():
    """Three seeds that agree everywhere: of 8 patterns only all plus and all minus are as large."""
    x = np.array([[[1.0, 2.0, 3.0]], [[2.0, 2.5, 3.0]]])
    found = joint_test(x)
    assert found.patterns == 8 and found.exact
    assert found.median[0] == pytest.approx((2 / 1 + 2.5 / 0.5) / 2)
    assert found.p[0] == 0.25 and found.p_family[0] == 0.25
    assert found.clear[0] == 1 and found.opposite[0] == 0  # t 3.46 and 8.66 against 4.30
    assert standardised(x)[:, 0] == pytest.approx([2.0, 5.0])


def test_readings_that_say_the_opposite_cancel():
    x = np.stack([[[1.0, 2.0, 3.0, 4.0]], [[-1.0, -2.0, -3.0, -4.0]]])
    found = joint_test(x)
    assert found.median[0] == 0.0 and found.p[0] == 1.0


def planted(rng, readings, seeds, effect=0.0, share=1.0, measures=1):
    """Readings that share their seeds' luck: correlation 0.7 between them; an effect in the first ``share`` of them."""
    luck = rng.standard_normal((1, measures, seeds))
    x = np.sqrt(0.7) * luck + np.sqrt(0.3) * rng.standard_normal((readings, measures, seeds))
    x[: round(share * readings)] += effect
    return x


def test_with_no_effect_anywhere_p_is_uniform():
    """Exact, however the readings hang together: 200 multiverses of 16 readings and 8 seeds."""
    rng = np.random.default_rng(0)
    p = np.array([joint_test(planted(rng, 16, 8)).p[0] for _ in range(200)])
    from scipy.stats import kstest
    assert kstest(p, "uniform").pvalue > 0.01
    assert (p <= 0.05).mean() < 0.1


def test_families_are_wrong_together_no_more_often_than_one():
    rng = np.random.default_rng(1)
    found = [joint_test(planted(rng, 8, 8, measures=12)) for _ in range(120)]
    assert np.mean([f.p_family.min() <= 0.05 for f in found]) < 0.1
    assert np.mean([f.p.min() <= 0.05 for f in found]) > 0.25  # without the correction
    assert np.mean([f.of_readings[:, 0].min() <= 0.05 for f in found]) < 0.12


def test_an_effect_in_half_of_the_readings_is_found():
    rng = np.random.default_rng(2)
    found = [joint_test(planted(rng, 32, 10, effect=2.0, share=0.5)) for _ in range(40)]
    assert np.mean([f.p[0] <= 0.05 for f in found]) > 0.8
    assert np.mean([f.clear[0] for f in found]) == pytest.approx(16, abs=2)


def test_missing_seeds_are_left_out():
    x = np.array([[[1.0, 2.0, np.nan, 3.0]]])
    assert joint_test(x).median[0] == pytest.approx(2.0)
    assert joint_test(np.full((2, 1, 4), np.nan)).p[0] == 1.0


def test_many_seeds_are_drawn_and_seeded():
    x = planted(np.random.default_rng(3), 4, 20)
    one, two = joint_test(x, draws=500), joint_test(x, draws=500)
    assert not one.exact and one.patterns == 500 and one.p[0] == two.p[0] >= 1 / 500


@settings(max_examples=25, deadline=None)
@given(st.integers(2, 6), st.integers(2, 7), st.integers(0, 1000))
def test_changing_the_labels_turns_the_sign_and_nothing_else(readings, seeds, seed):
    x = np.random.default_rng(seed).standard_normal((readings, 2, seeds))
    one, two = joint_test(x), joint_test(-x)
    assert one.median == pytest.approx(-two.median) and one.p == pytest.approx(two.p)
    assert (one.clear == two.opposite).all() and one.p_family == pytest.approx(two.p_family)
    assert (one.p_family >= one.p - 1e-12).all()


def test_variance_by_factor_by_hand():
    """Effects 0, 2, 4, 6 over two factors: squares about the mean 3 sum to 20, 16 between the levels of a, 4 of b."""
    found = variance_shares([0, 2, 4, 6], {"a": ["x", "x", "y", "y"], "b": ["u", "v", "u", "v"]})
    assert found == pytest.approx({"a": 0.8, "b": 0.2, "other": 0.0})
    assert variance_shares([1, 1], {"a": ["x", "y"]}) == {"a": 0.0, "other": 1.0}
