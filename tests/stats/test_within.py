"""Measures within a run against values worked out by hand."""

import numpy as np
import pytest

from attnlab.stats import (
    block_means,
    convergence_episode,
    coverage,
    curvature,
    entropy_bits,
    footprint_cells,
    gini,
    overlap_null,
    overlap_ratio,
    rhythm,
)


def test_block_means_leaves_a_stump_out():
    assert block_means([1, 3, 5, 7], 2).tolist() == [2, 6]
    assert block_means([1, 3, 5, 7, 9, 9, 100], 3).tolist() == [3, 25 / 3]
    assert block_means([1, 3, 5, 7, 9], 3).tolist() == [3, 8]
    assert block_means([4.0], 50).tolist() == [4.0]


@pytest.mark.parametrize(("values", "expected"), [
    ([0, 0, 1, 1, 1, 1], 2), ([1] * 6, 0), ([0] * 6, 6), ([1, 1, 0, 0, 1, 1], 4), ([1, 1, 1, 1, 0, 0], 6)])
def test_convergence(values, expected):
    assert convergence_episode(values, block=2, level=1) == expected


def test_convergence_of_nothing():
    assert np.isnan(convergence_episode([], 50, 1))


def test_rhythm_of_a_sine_and_of_noise():
    t = np.arange(1000)
    sine = rhythm(np.sin(2 * np.pi * t / 100))
    assert sine.share > 0.95 and sine.period == pytest.approx(100)
    assert rhythm(np.random.default_rng(0).normal(size=1000)).share < 0.1
    assert rhythm(np.ones(100)).share == 0.0
    assert rhythm([1.0, 2.0]).share == 0.0


def test_overlap_of_table_5():
    assert overlap_ratio(443, 418) == pytest.approx(0.0564, abs=1e-4)
    assert overlap_ratio(364, 260) == pytest.approx(0.2857, abs=1e-4)
    assert np.isnan(overlap_ratio(0, 0))


def test_overlap_null_of_two_regular_trains():
    # every 4th cycle in both: a random phase coincides one time in four, and then on all cycles: mean (1/4) * (1/2)
    active = np.zeros((400, 2), bool)
    active[::4] = True
    null = overlap_null(active, draws=4000)
    assert set(np.round(null, 6)) == {0.0, 0.5}
    assert null.mean() == pytest.approx(0.125, abs=0.02)
    assert (overlap_null(active) == overlap_null(active)).all()


def test_coverage_counts_a_cell_once():
    assert coverage(np.array([0, 0, 1]), np.array([0, 0, 1]), (2, 4)) == 0.25


def test_footprint():
    visits = np.zeros((7, 7))
    visits[3, 3] = 5
    assert footprint_cells(visits, 0.1, 0.1).sum() == 5  # a cross
    assert footprint_cells(visits, 0.25, 0.1).sum() == 21  # 5 x 5 without its corners
    assert footprint_cells(visits, 0.0, 0.1).sum() == 1


def test_evenness():
    assert entropy_bits([1, 1, 1, 1, 0]) == pytest.approx(2.0)
    assert entropy_bits([9, 0]) == 0.0
    assert gini([1, 1, 1, 1]) == pytest.approx(0.0)
    assert gini([0, 0, 0, 1]) == pytest.approx(0.75)
    assert np.isnan(gini([0, 0])) and np.isnan(entropy_bits([0, 0]))


def test_curvature_of_a_circle_a_line_and_a_point():
    angle = np.linspace(0, 2 * np.pi, 2000)
    assert curvature(2 * np.cos(angle), 2 * np.sin(angle)) == pytest.approx(0.5, rel=0.02)
    assert curvature(np.linspace(0, 5, 100), np.zeros(100)) == pytest.approx(0.0, abs=1e-9)
    assert np.isnan(curvature(np.zeros(50), np.zeros(50)))
