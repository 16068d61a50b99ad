"""Every registered part keeps what its group promises; authors of plugins run the same suite."""

from importlib.util import find_spec

import pytest

from attnlab import registry
from attnlab.loading import load_all
from attnlab.testing import checks
from attnlab.testing.common import IN_A_RUN

load_all()
GROUPS = (*IN_A_RUN, "world", "penalty", "measure", "figure", "probe", "callback")
CASES = [(spec.group, option, check) for spec in registry.parts.values() if spec.group in GROUPS
         and all(map(find_spec, getattr(spec.cls, "requires", ())))
         for option in (spec.name, *spec.presets) for check in checks(spec.group)]

SMALL = {("learner", "evolution"): {"generations": 1, "population": 5, "episodes": 1},  # the same, sooner
         **{("learner", name): {"steps": 400} for name in ("sb3", "dqn", "ppo")},
         ("measure", "survival_convergence"): {"episodes": [0, 6], "block": 2},  # what a study of six episodes has
         ("measure", "reward_convergence"): {"episodes": [0, 6], "block": 2, "end": 2},
         ("measure", "reward_rise"): {"early": [0, 3], "late": [3, 6]},
         ("measure", "policy_levels"): {"levels": ["low", "LH"], "least_visits": 1}}


@pytest.mark.parametrize(("group", "name", "check"), CASES, ids=["-".join(case) for case in CASES])
def test_conforms(group, name, check):
    checks(group)[check](name, **SMALL.get((group, name), {}))


def test_every_group_has_a_suite_and_a_part():
    assert {group for group, _, _ in CASES} == set(GROUPS) <= set(registry.GROUPS)
    assert all(len(checks(group)) > 2 for group in GROUPS)
