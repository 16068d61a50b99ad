"""Q-learning that knows how long each period was."""

from __future__ import annotations

from attnlab.learners.base import LearnerContext
from attnlab.learners.q_learning import QLearning, TabularParams
from attnlab.registry import register


@register("learner", "smdp_q")
class SmdpQ(QLearning):
    """Semi-Markov Q-learning (after Bradtke & Duff 1995, NIPS 7, who also discount the reward within the period): eq
    (2) with gamma^p for a period of p cycles, so that gamma is a discount a cycle and a long period is a long time.
    The same as ``q_learning`` under ``reading.q_update=smdp``, whatever the reading. Draws nothing at random."""

    def __init__(self, params: TabularParams, context: LearnerContext):
        super().__init__(params, context)
        self._discount = [params.gamma ** cycles for cycles in range(max(context.periods) + 1)]
