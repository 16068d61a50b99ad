"""Tails and quantiles against scipy.stats, which takes a second to import."""

import subprocess
import sys

import numpy as np
from scipy import ndimage, stats

from attnlab.stats import entropy_bits, footprint_cells, improvement, iqm
from attnlab.stats.tails import coin, normal_below, normal_quantile, t_above, t_quantile


def test_student_and_normal_are_scipys_to_the_last_bit():
    x, p = np.linspace(-6, 40, 93), np.linspace(0.001, 0.999, 91)
    for n in (1, 2, 5, 19, 400):
        assert (t_above(x, n) == stats.t.sf(x, n)).all()
        assert t_quantile(0.975, n) == stats.t.ppf(0.975, n)
    assert (normal_quantile(p) == stats.norm.ppf(p)).all() and (normal_below(x) == stats.norm.cdf(x)).all()


def test_the_coin_is_counted():
    assert coin(0).tolist() == [1.0] and coin(3).tolist() == [1 / 8, 4 / 8, 7 / 8, 1.0]
    for n in (5, 20, 41, 2000):
        np.testing.assert_allclose(coin(n), stats.binom.cdf(np.arange(n + 1), n, 0.5), rtol=1e-10)
        assert np.searchsorted(coin(n), 0.025) == stats.binom.ppf(0.025, n, 0.5)


def test_shares_of_pairs_middles_and_maps_are_scipys():
    draw = np.random.default_rng(0)
    a, b = draw.integers(0, 5, 14), draw.integers(0, 4, 9)
    assert np.isclose(improvement(a, b), stats.mannwhitneyu(a, b).statistic / (14 * 9))
    assert all(iqm(a[:n]) == stats.trim_mean(a[:n], 0.25) for n in range(1, 14))
    visits = draw.poisson(0.2, (40, 30))
    disc = np.hypot(*np.mgrid[-3:4, -3:4]) * 0.1 <= 0.26
    assert (footprint_cells(visits, 0.26, 0.1) == ndimage.binary_dilation(visits > 0, structure=disc)).all()
    assert entropy_bits(visits) == stats.entropy(visits.ravel(), base=2)


def test_what_decides_does_not_import_it():
    text = ("import sys; from attnlab.stats import *; t_interval([1., 2.]); median_interval([1., 2.]); "
            "bca_interval([1., 2., 4.]); bootstrap_interval([1., 2.], 'iqm'); improvement([1.], [2.]); "
            "print('scipy.stats' in sys.modules)")
    assert subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True).stdout == "False\n"
