"""Measures within a run against values worked out by hand."""

import numpy as np
import pytest

from attnlab.stats import (
    block_means,
    chance_overlap,
    convergence_episode,
    coverage,
    entropy_bits,
    footprint_cells,
    gini,
    overlap_ratio,
)


def test_block_means_leaves_a_stump_out():
    assert block_means([1, 3, 5, 7], 2).tolist() == [2, 6]
    assert block_means([1, 3, 5, 7, 9, 9, 100], 3).tolist() == [3, 25 / 3]
    assert block_means([1, 3, 5, 7, 9], 3).tolist() == [3, 8]
    assert block_means([4.0], 50).tolist() == [4.0]


@pytest.mark.parametrize(("values", "expected"), [
    ([0, 0, 1, 1, 1, 1], 2), ([1] * 6, 0), ([0] * 6, np.inf), ([1, 1, 0, 0, 1, 1], 4),
    ([1, 1, 1, 1, 0, 0], np.inf)])
def test_convergence(values, expected):
    assert convergence_episode(values, block=2, level=1) == expected


def test_convergence_of_nothing():
    assert np.isnan(convergence_episode([], 50, 1))


def test_overlap_of_table_5():
    assert overlap_ratio(443, 418) == pytest.approx(0.0564, abs=1e-4)
    assert overlap_ratio(364, 260) == pytest.approx(0.2857, abs=1e-4)
    assert np.isnan(overlap_ratio(0, 0))


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


def test_overlap_by_chance_is_that_of_trains_turned_at_random():
    rng = np.random.default_rng(0)
    trains = [np.arange(0, 120, 4), np.arange(0, 120, 6), np.array([3, 4, 5, 90])]
    drawn = []
    for _ in range(4000):
        union = set().union(*(((train + rng.integers(120)) % 120).tolist() for train in trains))
        drawn.append(1 - len(union) / sum(map(len, trains)))
    assert chance_overlap([30, 20, 4], 120) == pytest.approx(np.mean(drawn), abs=0.003)
    # two trains, half and half of 4 cycles: union 4 (1 - 1/4) = 3 of 4 activations
    assert chance_overlap([2, 2], 4) == 0.25
