"""Statistics over seeds, and what is measured within a run. Every random draw is seeded: the same data, the same bytes.

Values of one condition are arrays of shape (seeds,) or (seeds, x); intervals are percentile bootstrap intervals over
seeds, because episodes of one robot are not independent.
"""

from attnlab.stats.seeds import (
    Interval,
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
from attnlab.stats.series import block_means, convergence_episode, overlap_null, overlap_ratio, rhythm
from attnlab.stats.space import coverage, curvature, entropy_bits, footprint_cells, gini

__all__ = ["Interval", "block_means", "bootstrap_band", "bootstrap_interval", "convergence_episode", "coverage",
           "curvature", "effect_size", "entropy_bits", "footprint_cells", "gini", "holm", "improvement", "iqm", "mean",
           "overlap_null", "overlap_ratio", "paired", "rhythm", "sign_flip_p"]
