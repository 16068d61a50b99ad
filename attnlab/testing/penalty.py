"""Checks of a router of the penalty."""

from __future__ import annotations

from typing import Any

from attnlab.testing.build import make


def shares_are_shares(name: str, **settings: Any) -> None:
    """A share in [0, 1] for every behaviour, whatever killed the robot; asked again, the same."""
    router = make("penalty", name, **settings)
    behaviours = [make("behaviours", each) for each in ("avoid", "eat", "drink")]
    for cause in ("crash", "hunger", "thirst", "energy", "boredom"):
        for some in (behaviours, behaviours[:1], []):
            shares = router.shares(cause, some)
            assert len(shares) == len(some) and all(0.0 <= share <= 1.0 for share in shares), f"{name}: {shares}"
            assert router.shares(cause, some) == shares, f"{name}: shares is not pure"


CHECKS = (shares_are_shares,)
