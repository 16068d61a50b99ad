"""Statistics over seeds, and what is measured within a run. Every random draw is seeded: the same data, the same bytes.

Values of one condition are arrays of shape (seeds,) or (seeds, x). Intervals are over seeds, because episodes of one
robot are not independent: Student's t where something is decided, bootstrap bands in figures.
"""

from attnlab.stats.intervals import (
    Ends,
    bca_interval,
    mean_interval,
    median_interval,
    sign_flip_p,
    t_interval,
)
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
)
from attnlab.stats.series import block_means, chance_overlap, convergence_episode, overlap_ratio
from attnlab.stats.space import coverage, entropy_bits, footprint_cells, gini

__all__ = ["Ends", "Interval", "bca_interval", "block_means", "bootstrap_band", "bootstrap_interval", "chance_overlap",
           "convergence_episode", "coverage", "effect_size", "entropy_bits", "footprint_cells", "gini", "holm",
           "improvement", "iqm", "mean", "mean_interval", "median_interval", "overlap_ratio", "paired", "sign_flip_p",
           "t_interval"]
