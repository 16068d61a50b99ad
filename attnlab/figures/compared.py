"""What figures share that hold conditions of a study against each other by settings: who they are, and their outcomes
by seed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from attnlab.figures.style import colours
from attnlab.measures.base import CannotMeasure
from attnlab.measures.frames import episode_counts, episode_means, of_seeds
from attnlab.measures.rewards import mean_sums
from attnlab.stats import t_interval

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from attnlab.results.conditions import Conditions, Runs

BETTER, WORSE, UNCLEAR = "#0072b2", "#d55e00", "#767676"
EARLY, LATE, VALID, SAFETY = ("survival, first half of training", "survival, second half", "survival, validation",
                              "safety, validation")


class Asked(NamedTuple):
    """A condition: its settings as texts (``curiosity`` too) and its runs."""
    settings: Mapping[str, str]
    runs: Runs


class Difference(NamedTuple):
    """A mean difference paired by seed, with Student's t interval (95 %); nan under two seeds."""
    value: float
    low: float
    high: float
    seeds: int

    @property
    def side(self) -> int:
        """1 or -1 where the interval leaves out 0, else 0."""
        return int(self.low > 0) - int(self.high < 0)

    def said(self, digits: int) -> str:
        """``-1.5 [-2.0, -1.1]``."""
        ends = f" [{self.low:+.{digits}f}, {self.high:+.{digits}f}]" if np.isfinite(self.low) else ""
        return f"{self.value:+.{digits}f}{ends}"


def asked(conditions: Conditions) -> list[Asked]:
    """All conditions that have runs, in the order in which they were asked for."""
    names = ("curiosity", *conditions.settings)
    return [Asked(dict(zip(names, key, strict=True)), conditions.runs(key[0], key[1:])) for key in conditions.keyed]


def values_of(conditions: Conditions, setting: str) -> list[str]:
    """Values (as texts) of a setting that was swept, in the order in which they were asked for; none if it was not."""
    return list(dict.fromkeys(one.settings[setting] for one in asked(conditions) if setting in one.settings))


def called(conditions: Conditions, one: Asked) -> str:
    """The label of a condition's variant, or of its curiosity."""
    name = one.settings.get("variant") or one.settings["curiosity"]
    return conditions.labels.get(name, name)


def coloured(conditions: Conditions, of: Sequence[Asked]) -> dict[str, str]:
    """A colour for each name: those of the paper's two robots are theirs, whatever they are called."""
    roles: dict[str, str] = {}
    for one in of:
        s = one.settings
        plain = s["curiosity"] == "none" and s.get("reading.non_curious", "plain") == "plain" and \
            s.get("learner.of", "q_learning") == "q_learning"
        role = "none" if plain else s["curiosity"] if s["curiosity"] != "none" else ""
        name = called(conditions, one)
        roles.setdefault(name, role if role and role not in roles.values() else f"{name} ")
    shades = colours(list(roles.values()))
    return {name: shades[role] for name, role in roles.items()}


def survival(runs: Runs, which: str) -> dict[int, float]:
    """Seed -> survival in % of the longest episode: in one of ``EARLY``, ``LATE`` (halves of training), ``VALID``."""
    episodes = max(of_seeds(runs, episode_counts(runs.conditions, "episodes", "train")).values(), default=0)
    half = -(-episodes // 2)  # where the summary table has it, too
    within = {EARLY: (0, half), LATE: (half, episodes)}.get(which)
    found = episode_means(runs.conditions, "survival", "train" if within else "validation", within)
    return {seed: 100 * value for seed, value in of_seeds(runs, found).items()}


def outcome(runs: Runs, which: str) -> dict[int, float]:
    """Seed -> one of the four outcomes that conditions are compared by; empty where it was not recorded."""
    if which != SAFETY:
        return survival(runs, which)
    frame = runs.conditions.frame("episodes")
    return of_seeds(runs, episode_means(runs.conditions, "safety_mean", "validation", None)) \
        if "safety_mean" in frame else {}


def looks(runs: Runs, behaviour: str = "all") -> dict[int, float]:
    """Seed -> activations a cycle in validation, of all behaviours together or of one; also of who dies early."""
    try:
        acts = mean_sums(runs, "validation", behaviour, "activations")
    except CannotMeasure:
        return {}
    cycles = of_seeds(runs, episode_means(runs.conditions, "cycles", "validation", None))
    return {seed: acts[seed] / cycles[seed] for seed in acts if seed in cycles}


def difference(one: Mapping[int, float], other: Mapping[int, float]) -> Difference | None:
    """Of two conditions, over the seeds that both have; None without any."""
    both = [one[seed] - other[seed] for seed in sorted(set(one) & set(other))
            if np.isfinite(one[seed]) and np.isfinite(other[seed])]
    if not both:
        return None
    ends = t_interval(both)
    return Difference(float(ends.value), float(ends.low), float(ends.high), len(both))


def point(ax: Axes, x: float, of_seed: Mapping[int, float], colour: str, marker: str = "o", label: str | None = None,
          across: bool = False) -> None:
    """A mean over seeds with its t interval at place ``x``; ``across``: lying."""
    kept = [value for value in of_seed.values() if np.isfinite(value)]
    if not kept:
        return
    value, low, high, _ = (float(end) for end in t_interval(kept))
    if np.isfinite(low):
        ends, at = [low, high], [x, x]
        ax.plot(*((ends, at) if across else (at, ends)), color=colour, lw=1.6, solid_capstyle="butt")
    ax.plot(*((value, x) if across else (x, value)), ls="", marker=marker, ms=6, color=colour, mec="white", mew=0.7,
            label=label)
