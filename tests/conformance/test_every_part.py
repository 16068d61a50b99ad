"""Every registered part keeps what its group promises; authors of plugins run the same suite."""

import pytest

from attnlab import registry
from attnlab.testing import checks

registry.load_all()
CASES = [(spec.group, option, check) for spec in registry.parts.values() for option in spec.nodes()
         for check in checks(spec.group)]


@pytest.mark.parametrize(("group", "name", "check"), CASES, ids=["-".join(case) for case in CASES])
def test_conforms(group, name, check):
    checks(group)[check](name)


def test_every_group_has_a_suite_and_a_part():
    assert {group for group, _, _ in CASES} == set(registry.GROUPS)
