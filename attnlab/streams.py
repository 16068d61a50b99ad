"""Named random streams: every draw of a run comes from one; each depends on the seed and its name alone."""

from __future__ import annotations

import hashlib
from random import Random


def stream(seed: int, *names: str | int) -> Random:
    """The stream called ``names`` of the run with this seed.

    A stream's numbers do not depend on which other streams exist or how much was drawn from them, so adding a part
    shifts nobody else's randomness, and streams that leave the condition out of their name are the same in all
    conditions. Python's Mersenne twister is stable across versions and draws a float in 50 ns.
    """
    label = "/".join(str(part) for part in (seed, *names))
    return Random(int.from_bytes(hashlib.sha256(label.encode()).digest()[:16], "big"))
