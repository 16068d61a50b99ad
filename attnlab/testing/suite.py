"""The suite: which checks a part of each group must pass."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from attnlab.errors import ConfigError
from attnlab.groups import GROUPS
from attnlab.testing import behaviour, body, common, curiosity, figure, learner, measure, penalty, watching, world
from attnlab.testing.build import part_of

Check = Callable[..., None]  # (name, **settings)

CHECKS: dict[str, tuple[Check, ...]] = {"curiosity": curiosity.CHECKS, "learner": learner.LEARNER,
                            "exploration": learner.EXPLORATION, "behaviours": behaviour.CHECKS, "needs": body.NEEDS,
                            "fusion": body.FUSION, "simulator": world.SIMULATOR, "world": world.WORLD,
                            "penalty": penalty.CHECKS, "measure": measure.CHECKS, "figure": figure.CHECKS,
                            "probe": watching.PROBE, "callback": watching.CALLBACK}


def checks(group: str) -> dict[str, Check]:
    """The checks of a group by name; each is called with the part's name and settings, and raises if it fails."""
    if group not in GROUPS:
        raise ConfigError(group, "no such group", f"Known: {', '.join(GROUPS)}")
    return {check.__name__: check for check in (*common.checks(group), *CHECKS.get(group, ()))}


def conformance(group: str, name: str, **settings: Any) -> Callable[[str], None]:
    """A pytest function over all checks of one part; call the result ``test_...`` in a test file."""
    import pytest
    found = checks(group)

    @pytest.mark.parametrize("check", found)
    def test(check: str) -> None:
        part_of(group, name)  # that it is not known comes before what it lacks
        found[check](name, **settings)
    test.__doc__ = f"{group} '{name}' keeps what every part of its group promises."
    return test
