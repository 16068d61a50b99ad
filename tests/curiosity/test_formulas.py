"""The formulas against numbers worked out by hand or by quadrature."""

from math import exp, log, sqrt

import pytest

from attnlab.curiosity import formulas as f


@pytest.mark.parametrize("x", [1e-3, 0.1, 1.0, 2.0, 5.9, 6.0, 12.0, 1e4])
def test_digamma(x):
    from scipy.special import digamma
    assert f.digamma(x) == pytest.approx(digamma(x), rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("x", [1e-9, 1e-3, 0.1, 0.5, 1.0, 1.4616, 2.0, 3.3, 7.999, 8.0, 12.0, 1e4, 1e9])
def test_lgamma(x):
    from scipy.special import gammaln
    assert f.lgamma(x) == pytest.approx(gammaln(x), rel=1e-14, abs=1e-13)


def test_dirichlet_surprise_by_hand():
    a = [2, 3, 1, 4, 1, 1]
    assert f.dirichlet_surprise(a, 0, "prior_post") == pytest.approx(0.228118, abs=5e-7)
    assert f.dirichlet_surprise(a, 0, "post_prior") == pytest.approx(0.188549, abs=5e-7)
    assert f.dirichlet_surprise(a, 4, "prior_post") == pytest.approx(0.534971, abs=5e-7)
    assert f.dirichlet_surprise(a, 4, "post_prior") == pytest.approx(0.381696, abs=5e-7)


def test_dirichlet_surprise_is_the_divergence_of_beta_beliefs():
    from scipy.integrate import quad
    from scipy.stats import beta
    prior, post = beta(2, 5).pdf, beta(3, 5).pdf
    forward = quad(lambda x: prior(x) * log(prior(x) / post(x)), 1e-12, 1 - 1e-12)[0]
    assert f.dirichlet_surprise([2, 5], 0, "prior_post") == pytest.approx(forward, rel=1e-6)


def test_gamma_divergence_against_quadrature():
    from scipy.integrate import quad
    from scipy.stats import gamma
    p, q = gamma(4.2, scale=1 / 2.0), gamma(3.0, scale=1 / 1.5)
    expected = quad(lambda x: p.pdf(x) * (p.logpdf(x) - q.logpdf(x)), 1e-9, 40)[0]
    assert f.gamma_divergence(4.2, 2.0, 3.0, 1.5) == pytest.approx(expected, rel=1e-6)
    assert f.gamma_divergence(3.0, 1.5, 3.0, 1.5) == 0.0


def test_entropy():
    assert f.entropy([1, 1, 1, 1, 1, 1]) == pytest.approx(log(6))
    assert f.entropy([3, 1]) == pytest.approx(-(0.75 * log(0.75) + 0.25 * log(0.25)))
    assert f.entropy([5, 0]) == 0.0


def test_squash():
    assert f.squash(0.1, 0.1) == pytest.approx(1 - exp(-1))
    assert f.squash(-0.3, 0.1) == 0.0


def test_wundt_curve_peaks_between_its_two_thresholds():
    assert f.wundt(0.5, 0.35, 0.75, 20, 1.0) == pytest.approx(0.9525741 - 0.0066929, abs=1e-6)
    values = [f.wundt(n / 100, 0.3, 0.8, 20, 1.0) for n in range(101)]
    assert values.index(max(values)) == 55
    assert max(values[0], values[100]) < 0.02
    assert f.wundt(1.0, 0.3, 0.8, 20, 2.0) < -0.9  # too much novelty is aversive
    assert sqrt(values[55]) > 0.98
