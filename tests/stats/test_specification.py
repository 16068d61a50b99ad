"""Inference over a specification curve, by hand, on planted multiverses, and in its uniformity."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import kstest

from attnlab.stats.specification import joint_test, levels_test, standardised, variance_shares


def test_two_readings_by_hand():
    """Three seeds that agree everywhere: of 8 patterns only all plus and all minus are as large."""
    x = np.array([[[1.0, 2.0, 3.0]], [[2.0, 2.5, 3.0]]])
    found = joint_test(x)
    assert found.patterns == 8 and found.exact
    assert found.median[0] == pytest.approx((2 / 1 + 2.5 / 0.5) / 2)
    assert found.p[0] == found.p_median[0] == found.p_family[0] == 0.25
    assert found.clear[0] == 1 and found.opposite[0] == 0  # t 3.46 and 8.66 against 4.30
    assert standardised(x)[:, 0] == pytest.approx([2.0, 5.0])


def test_one_seed_against_the_others_by_hand():
    """Scores of seeds 3, 3, -1 (over the root of 19) sum to 5; of 8 patterns ++-, +++, and their reverses, are as
    large: 7, 5."""
    found = joint_test(np.array([[[3.0, 3.0, -1.0]]]))
    assert found.p[0] == found.of_readings[0, 0] == 0.5


def test_readings_that_say_the_opposite_cancel():
    x = np.stack([[[1.0, 2.0, 3.0, 4.0]], [[-1.0, -2.0, -3.0, -4.0]]])
    found = joint_test(x)
    assert found.median[0] == 0.0 and found.p[0] == found.p_median[0] == 1.0
    levels = levels_test(x, {"a": ["x", "y"]})["a"]
    assert levels.names == ["x", "y"] and levels.differs[:, 0].tolist() == levels.p[:, 0].tolist() == [0.125, 0.125]


def planted(rng, readings, seeds, effect=0.0, share=1.0, measures=1):
    """Readings that share their seeds' luck: correlation 0.7 between them; an effect in the first ``share`` of them."""
    luck = rng.standard_normal((1, measures, seeds))
    x = np.sqrt(0.7) * luck + np.sqrt(0.3) * rng.standard_normal((readings, measures, seeds))
    x[: round(share * readings)] += effect
    return x


def test_with_no_effect_anywhere_p_is_uniform():
    """Exact, however the readings hang together: 200 multiverses of 16 readings and 9 seeds. If p is uniform, one set
    of 200 in a thousand fails this bound; the seed is fixed."""
    rng = np.random.default_rng(0)
    found = [joint_test(planted(rng, 16, 9, measures=3)) for _ in range(200)]
    for p in ([f.p[0] for f in found], [f.p_median[1] for f in found], [f.p_family.min() for f in found]):
        assert kstest(p, "uniform").pvalue > 0.001
        assert np.mean(np.array(p) <= 0.05) < 0.05 + 3 * np.sqrt(0.05 * 0.95 / 200)


def test_an_effect_that_is_everywhere_the_same_is_no_difference_of_levels():
    """p of the largest contrast of levels: uniform with no effect; with one in all readings it errs to the safe side,
    for a score saturates."""
    rng = np.random.default_rng(5)
    factors = {"a": list("xy") * 8, "b": list("uvwu") * 4}

    def p(effect):
        return np.array([min(of.differs.min() for of in levels_test(planted(rng, 16, 8, effect), factors).values())
                         for _ in range(150)])
    assert kstest(p(0.0), "uniform").pvalue > 0.001
    assert (p(1.0) <= 0.05).mean() < 0.05


def test_families_are_wrong_together_no_more_often_than_one():
    rng = np.random.default_rng(1)
    found = [joint_test(planted(rng, 8, 8, measures=12)) for _ in range(120)]
    assert np.mean([f.p_family.min() <= 0.05 for f in found]) < 0.1
    assert np.mean([f.p.min() <= 0.05 for f in found]) > 0.25  # without the correction
    assert np.mean([f.of_readings.min() <= 0.05 for f in found]) < 0.1  # over readings and measures


def test_an_effect_in_half_of_the_readings_is_found():
    """By the mean more often than by the median, which does not hear what a quarter of the readings say."""
    rng = np.random.default_rng(2)
    found = [joint_test(planted(rng, 32, 10, effect=2.0, share=0.5)) for _ in range(40)]
    assert np.mean([f.p[0] <= 0.05 for f in found]) > 0.9
    assert np.mean([f.clear[0] for f in found]) == pytest.approx(16, abs=2)
    weak = [joint_test(planted(rng, 32, 10, effect=2.0, share=0.25)) for _ in range(40)]
    assert np.mean([f.p[0] <= 0.05 for f in weak]) > np.mean([f.p_median[0] <= 0.05 for f in weak]) + 0.2


def test_the_level_that_an_effect_hangs_on_is_found():
    rng = np.random.default_rng(4)
    factors = {"a": ["x"] * 16 + ["y"] * 16, "b": ["u", "v"] * 16}
    found = levels_test(planted(rng, 32, 10, effect=1.5, share=0.5, measures=2), factors)
    assert found["a"].differs.max() <= 0.05 < found["b"].differs.min()
    assert found["a"].p[0].max() <= 0.05 and found["a"].p.shape == (2, 2)


def test_a_reading_without_a_value_counts_nowhere():
    """Not as an effect of 0: the others say the same as without it."""
    x = planted(np.random.default_rng(6), 5, 6, effect=1.0)
    more = np.concatenate([x, np.full((4, 1, 6), np.nan)])
    one, two = joint_test(x), joint_test(more)
    assert two.values.tolist() == [5] and two.median == pytest.approx(one.median)
    assert (two.p == one.p).all() and (two.p_median == one.p_median).all() and (two.clear == one.clear).all()
    assert np.isnan(two.of_readings[5:]).all() and (two.of_readings[:5] == one.of_readings).all()
    alone, both = (levels_test(of, {"a": (list("xyxyx") + list("yyyy"))[: len(of)]})["a"] for of in (x, more))
    assert (alone.differs == both.differs).all() and (alone.p == both.p).all()
    assert variance_shares([0, 2, np.nan, 4], {"a": ["x", "y", "y", "y"]}) == variance_shares(
        [0, 2, 4], {"a": ["x", "y", "y"]})


def test_missing_seeds_are_left_out():
    x = np.array([[[1.0, 2.0, np.nan, 3.0]]])
    assert joint_test(x).median[0] == pytest.approx(2.0)
    nothing = joint_test(np.full((2, 1, 4), np.nan))
    assert nothing.p[0] == nothing.p_median[0] == 1.0 and nothing.values[0] == 0 and np.isnan(nothing.median[0])
    assert np.isnan(standardised([1.0, np.nan])) and standardised([0.0, 0.0]) == 0.0
    assert standardised([[-2.0, -2.0], [0.1, 0.1]]).tolist() == [-np.inf, np.inf]


def test_many_seeds_are_drawn_and_seeded():
    x = planted(np.random.default_rng(3), 4, 20)
    one, two = joint_test(x, draws=500), joint_test(x, draws=500)
    assert not one.exact and one.patterns == 500 and one.p[0] == two.p[0] >= 1 / 500


def test_half_of_the_patterns_say_what_all_do():
    """A pattern and its reverse are as large: counted one by one here."""
    x = planted(np.random.default_rng(7), 3, 5, effect=0.5)
    found = joint_test(x)
    z = x[:, 0] / np.sqrt((x[:, 0] ** 2).sum(axis=1, keepdims=True))
    signs = np.array(np.meshgrid(*[[1, -1]] * 5)).reshape(5, -1).T
    sums = np.abs(signs @ z.T)
    assert found.patterns == len(signs) == 32
    d = np.array([[np.mean(s * row) / np.std(s * row, ddof=1) for row in x[:, 0]] for s in signs])
    assert found.p[0] == np.mean(np.abs(d.mean(axis=1)) >= abs(d[(signs == 1).all(axis=1)].mean()) - 1e-9)
    assert found.of_readings[:, 0].tolist() == [np.mean(sums.max(axis=1) >= abs(s) - 1e-9) for s in z.sum(axis=1)]


@settings(max_examples=25, deadline=None)
@given(st.integers(2, 6), st.integers(2, 7), st.integers(0, 1000))
def test_changing_the_labels_turns_the_sign_and_nothing_else(readings, seeds, seed):
    x = np.random.default_rng(seed).standard_normal((readings, 2, seeds))
    one, two = joint_test(x), joint_test(-x)
    assert one.median == pytest.approx(-two.median) and one.p == pytest.approx(two.p)
    assert (one.clear == two.opposite).all() and one.p_family == pytest.approx(two.p_family)
    assert (one.p_family >= one.p - 1e-12).all()


def test_variance_by_factor_by_hand():
    """Effects 0, 1, 2, 3 over two factors: squares about the mean 1.5 sum to 5, 4 between the levels of a, 1 of b."""
    found = variance_shares([0, 1, 2, 3], {"a": ["x", "x", "y", "y"], "b": ["u", "v", "u", "v"]})
    assert found == pytest.approx({"a": 0.8, "b": 0.2, "other": 0.0})
    assert variance_shares([1, 1], {"a": ["x", "y"]}) == {"a": 0.0, "other": 1.0}
    assert variance_shares([0, np.inf], {"a": ["x", "y"]})["a"] == 1.0


def test_a_whole_multiverse_is_counted_one_by_one():
    """128 readings of 70 comparisons with 10 seeds under 25 factors: all 1024 exchanges."""
    rng = np.random.default_rng(8)
    x = planted(rng, 128, 10, measures=70)
    found = joint_test(x)
    assert found.exact and found.patterns == 1024 and found.of_readings.shape == (128, 70)
    levels_test(x, {str(i): [str(j) for j in rng.integers(0, 3, 128)] for i in range(25)})
