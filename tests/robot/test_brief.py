"""What is said of an episode: numpy and compiled code say the same, to the last bit."""

from __future__ import annotations

import numpy as np
import pytest

from attnlab.attention import Activation
from attnlab.robot.episode import run_episode
from attnlab.robot.plan import RunPlan
from attnlab.robot.quick import quick
from attnlab.robot.record import Recorder
from attnlab.robot.series import Series
from attnlab.testing import config

ROBOTS = {"the paper's": {}, "nobody guards": {"behaviours": ("eat", "drink")},
          "of one period": {"periods": (4,), "curiosity": "none"},
          "of energy alone": {"needs": "energy_only", "behaviours": ("avoid", "wander")},
          "at its limits": {"how": {"energy_clipped": True, "needs_floored": True}},
          "that rests": {"behaviours": ("avoid", "wander", "rest")}}


@pytest.fixture(params=ROBOTS)
def lived(request):
    """(agent that has just lived an episode, its logs also as tables, the plan), for some lengths of an episode."""
    plan = RunPlan(config(max_cycles=1150, **ROBOTS[request.param]))
    simulator = plan.simulator()
    agent = plan.agent(simulator)

    def live(episode):
        run_episode(agent, plan.exploration("train"), plan.start_pose("train", episode), True)
        looks = np.zeros((len(agent.attentions), 1151, len(Activation._fields)))
        for attention, table in zip(agent.attentions, looks, strict=True):
            attention.log.table, attention.log.rows = None, len(attention.log)
            table[:len(attention.log)] = np.array(attention.log, np.float64)
            attention.log.table = table
        agent.history.table, agent.history.rows = np.array(list(agent.history), np.float64), len(agent.history)
        return agent, looks, plan
    yield live
    simulator.close()


def test_compiled_code_says_the_same(lived):
    for episode in range(3):
        agent, looks, plan = lived(episode)
        series, recorder = Series(agent, plan.layout), Recorder("r", 0, "litman", {}, plan.layout, True)
        visits, others = (np.zeros(recorder._cells, np.int64) for _ in range(2))
        recorder._cover(others, series.path[1:])
        assert quick(agent, looks)(True, visits) == series.brief()
        assert (visits == others).all() and visits.sum() == agent.simulator.cycle


@pytest.mark.parametrize(("field", "value"), [("sigma", 7e9), ("wanting", -0.1), ("liking", np.nan), ("level", 9.0),
                                              ("reward", np.inf), ("cycle", 1e6), ("period", 5.0)])
def test_what_cannot_be_is_left_to_the_checks(lived, field, value):
    agent, looks, plan = lived(0)
    look = agent.attentions[-1].log.rows // 2
    looks[-1, look, Activation._fields.index(field)] = value
    visits = np.zeros(Recorder("r", 0, "litman", {}, plan.layout, True)._cells, np.int64)
    assert quick(agent, looks)(True, visits) is None and not visits.any()
    with pytest.raises(Exception, match="."):
        Series(agent, plan.layout).check()


def test_an_unbalanced_body_is_left_to_the_checks(lived):
    agent, looks, plan = lived(0)
    balanced = not (plan.reading.energy_clipped or plan.reading.needs_floored)
    agent.history.table[-1, 2] += 0.5
    visits = np.zeros(Recorder("r", 0, "litman", {}, plan.layout, True)._cells, np.int64)
    assert (quick(agent, looks)(True, visits) is None) == balanced
