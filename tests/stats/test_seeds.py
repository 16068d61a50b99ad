"""Statistics over seeds against values worked out by hand, and against scipy where it has them."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from attnlab.stats import (
    bootstrap_band,
    bootstrap_interval,
    effect_size,
    holm,
    improvement,
    iqm,
    mean,
    paired,
    sign_flip_p,
)

numbers = st.lists(st.floats(-1e6, 1e6), min_size=2, max_size=12)


def test_mean_leaves_missing_out():
    assert mean([1.0, float("nan"), 3.0]) == 2.0
    assert np.isnan(mean([]))


def test_iqm_is_the_mean_of_the_middle_half():
    assert iqm([1, 2, 3, 4, 5, 6, 7, 100]) == 4.5  # 3, 4, 5, 6
    assert iqm([0, 10, 20, 1000]) == 15.0


def test_bootstrap_agrees_with_scipy():
    from scipy.stats import bootstrap
    values = np.random.default_rng(3).normal(10, 2, 20)
    theirs = bootstrap((values,), np.mean, n_resamples=9999, method="percentile",
                       vectorized=True).confidence_interval
    ours = bootstrap_interval(values, resamples=9999)
    assert ours.value == pytest.approx(values.mean())
    assert ours.low == pytest.approx(theirs.low, abs=0.06)
    assert ours.high == pytest.approx(theirs.high, abs=0.06)


def test_bootstrap_of_two_values_by_hand():
    # resamples of (0, 1): means 0, .5, .5, 1 with probabilities 1/4, 1/2, 1/4; the 95 % interval is all of it
    assert bootstrap_interval([0.0, 1.0]) == (0.5, 0.0, 1.0)


@given(numbers)
def test_bootstrap_is_seeded_and_within_the_data(values):
    for statistic in ("mean", "iqm"):
        one = bootstrap_interval(values, statistic, resamples=200)
        assert one == bootstrap_interval(values, statistic, resamples=200)
        slack = 1e-9 * max(1.0, *map(abs, values))
        assert min(values) - slack <= one.low <= one.high <= max(values) + slack


def test_one_seed_has_no_interval():
    one = bootstrap_interval([3.0])
    assert one.value == 3.0 and np.isnan(one.low) and np.isnan(one.high)
    centre, low, high = bootstrap_band(np.array([[1.0, 2.0]]))
    assert centre.tolist() == [1.0, 2.0] and np.isnan(low).all() and np.isnan(high).all()


def test_band_is_the_interval_in_every_column():
    values = np.random.default_rng(0).normal(size=(7, 3))
    centre, low, high = bootstrap_band(values)
    for column in range(3):
        alone = bootstrap_interval(values[:, column])
        assert (centre[column], low[column], high[column]) == pytest.approx(tuple(alone))


def test_band_with_missing_cells():
    values = np.array([[1.0, np.nan, np.nan], [3.0, 5.0, np.nan]])
    centre, low, high = bootstrap_band(values)
    assert centre[:2].tolist() == [2.0, 5.0] and np.isnan(centre[2])
    assert low[0] == 1.0 and high[0] == 3.0 and np.isnan(low[1]) and np.isnan(high[2])


def test_paired_takes_common_seeds_in_order():
    assert paired({2: 5.0, 0: 1.0, 9: 7.0}, {0: 0.5, 2: 1.0, 4: 3.0}).tolist() == [0.5, 4.0]
    assert paired({0: 1.0, 1: float("nan")}, {0: 0.0, 1: 1.0}).tolist() == [1.0]


def test_effect_size_by_hand():
    assert effect_size([1.0, 2.0, 3.0]) == pytest.approx(2.0)  # mean 2, sd 1
    assert effect_size([1.0, 2.0, 3.0], reference=1.0) == pytest.approx(1.0)
    assert effect_size([2.0, 2.0]) == np.inf and effect_size([-2.0, -2.0]) == -np.inf and effect_size([0.0, 0.0]) == 0
    assert np.isnan(effect_size([1.0]))


def test_improvement_by_hand():
    # pairs (2,1) (2,3) (4,1) (4,3): three of four won
    assert improvement([2, 4], [1, 3]) == 0.75
    assert improvement([1, 1], [1, 1]) == 0.5
    assert np.isnan(improvement([], [1]))


def test_sign_flip_by_hand():
    # 2^3 patterns, only all plus and all minus reach |6|
    assert sign_flip_p([1.0, 2.0, 3.0]) == 0.25
    assert sign_flip_p([1.0, 1.0, 1.0], reference=1.0) == 1.0
    assert np.isnan(sign_flip_p([1.0]))


def test_sign_flip_agrees_with_scipy():
    from scipy.stats import permutation_test
    values = np.random.default_rng(5).normal(0.4, 1, 10)
    theirs = permutation_test((values,), lambda x, axis: x.mean(axis=axis), vectorized=True,
                              permutation_type="samples", n_resamples=np.inf).pvalue
    assert sign_flip_p(values) == pytest.approx(theirs)


def test_sign_flip_is_rarely_small_under_the_null():
    rng = np.random.default_rng(1)
    p = [sign_flip_p(rng.normal(size=18), draws=2000) for _ in range(300)]
    assert 0.02 < np.mean(np.array(p) < 0.05) < 0.09


def test_holm_by_hand():
    # sorted .01 .02 .04: 3 * .01, then 2 * .02, then .04; never falling
    assert holm([0.04, 0.01, 0.02]) == pytest.approx([0.04, 0.03, 0.04])
    assert holm([0.5, 0.9]).tolist() == [1.0, 1.0]
    assert holm([[0.04, 0.5], [0.01, 0.01]]) == pytest.approx(np.array([[0.04, 0.5], [0.02, 0.02]]))
    corrected = holm([0.01, float("nan"), 0.02])
    assert corrected[0] == 0.02 and np.isnan(corrected[1]) and corrected[2] == 0.02


@given(st.lists(st.floats(0, 1), min_size=1, max_size=30))
def test_holm_never_lowers(p):
    assert all(a >= b for a, b in zip(holm(p), p, strict=True))
