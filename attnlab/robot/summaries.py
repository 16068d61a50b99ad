"""What is said of an episode when it has ended: safety, turning, bouts of eating and drinking."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from attnlab.attention import Attention, Looks
from attnlab.equations import safety as _safety_at
from attnlab.worlds.base import Layout
from attnlab.worlds.geometry import clearances

Values = npt.NDArray[np.float64]
_safety: Any = _safety_at  # eq (13) of many at once: the same arithmetic on arrays
BOUT_MC = 60  # meals of one kind nearer than this to each other are one bout


def held(looks: Looks, n: int, values: Any) -> Values:
    """What was set at each activation, in every cycle until the next one, shape (n,)."""
    return np.repeat(values, np.diff(looks.cycle, append=n))


def in_order(values: npt.NDArray[Any]) -> float:
    """The sum from the first to the last, each step rounded, as :func:`attnlab.arithmetic.total` has it."""
    return float(np.cumsum(values)[-1]) if len(values) else 0.0


def guard_of(attentions: Sequence[Attention]) -> Attention | None:
    """The behaviour that answers for crashes, if its period may change: safety is about its attention."""
    return next((a for a in attentions if "crash" in a.behaviour.charges and len(set(a.periods)) > 1), None)


def safety(guard: Attention, looks: Looks, distances: Values) -> Values:
    """Eq (13) in every cycle, shape (n,), from where the robot is: ``distances`` (n,), m, from its centre to the
    nearest surface, which count up to sigma_max. No sensor is read for it."""
    shortest, longest, high = min(guard.periods), max(guard.periods), guard.behaviour.sigma_high
    watched = held(looks, len(distances), _safety(1.0, 1.0, looks.period, shortest, longest))
    return np.minimum(distances, high) / high * watched


def safety_held(guard: Attention, looks: Looks, n: int) -> Values:
    """Eq (13) in every cycle, shape (n,), from what the behaviour last perceived."""
    shortest, longest = min(guard.periods), max(guard.periods)
    return held(looks, n, _safety(looks.sigma, guard.behaviour.sigma_high, looks.period, shortest, longest))


def distances(path: Values, layout: Layout) -> Values:
    """From the centre to the nearest surface, m, shape (n,), for poses of shape (n, 3)."""
    return clearances(path[:, :2], layout.solids)


def turning(path: Values) -> float:
    """Sum of the absolute turns along poses (n, 3), rad."""
    turns = (np.diff(path[:, 2]) + np.pi) % (2 * np.pi) - np.pi
    return float(np.abs(turns).sum())


def bouts(meals: Mapping[str, Sequence[int]]) -> dict[str, float | int | None]:
    """Bouts of an episode. ``meals``: cycles at which each need was satisfied, rising.

    A bout is a run of meals of one kind less than BOUT_MC apart. ``bouts``: how many; ``bout_switches``: how often the
    next one was of another kind; mean and standard deviation of the cycles from the start of one to that of the next,
    empty where there are none.
    """
    started: list[tuple[int, str]] = []
    for need, times in meals.items():
        started += [(time, need) for before, time in zip([None, *times], times, strict=False)
                    if before is None or time - before >= BOUT_MC]
    started.sort()
    gaps = np.diff([time for time, _ in started])
    switches = sum(one != other for (_, one), (_, other) in pairwise(started))
    return {"bouts": len(started), "bout_switches": switches,
            "bout_interval_mean": float(gaps.mean()) if gaps.size else None,
            "bout_interval_sd": float(gaps.std(ddof=1)) if gaps.size > 1 else None}
