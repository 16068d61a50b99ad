"""The suite: which checks a part of each group must pass."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from attnlab import registry
from attnlab.errors import ConfigError
from attnlab.loading import load_all
from attnlab.testing import behaviour, body, common, curiosity, figure, learner, measure, penalty, world

Check = Callable[..., None]  # (name, **settings)

CHECKS: dict[str, tuple] = {"curiosity": curiosity.CHECKS, "learner": learner.LEARNER,
                            "exploration": learner.EXPLORATION, "behaviours": behaviour.CHECKS, "needs": body.NEEDS,
                            "fusion": body.FUSION, "simulator": world.SIMULATOR, "world": world.WORLD,
                            "penalty": penalty.CHECKS, "measure": measure.CHECKS, "figure": figure.CHECKS}


def checks(group: str) -> dict[str, Check]:
    """The checks of a group by name; each is called with the part's name and settings, and raises if it fails."""
    if group not in registry.GROUPS:
        raise ConfigError(group, "no such group", f"Known: {', '.join(registry.GROUPS)}")
    return {check.__name__: check for check in (*common.checks(group), *CHECKS.get(group, ()))}


def conformance(group: str, name: str, **settings: Any) -> Callable:
    """A pytest function over all checks of one part; call the result ``test_...`` in a test file."""
    import pytest
    found = checks(group)

    @pytest.mark.parametrize("check", found)
    def test(check: str) -> None:
        load_all()
        if registry.find(group, name) is None:
            raise registry.unknown(group, name, group)
        found[check](name, **settings)
    test.__doc__ = f"{group} '{name}' keeps what every part of its group promises."
    return test
