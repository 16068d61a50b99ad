"""What was learned: the period that a behaviour grants itself at each percept."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from attnlab.errors import ConfigError
from attnlab.measures.base import CannotMeasure, Measure
from attnlab.measures.once import once_a_study
from attnlab.registry import register
from attnlab.settings import setting

if TYPE_CHECKING:
    import numpy as np

    from attnlab.results.conditions import Conditions, Runs


@once_a_study
def _levels(conditions: Conditions) -> dict[tuple[str, str], list[str]]:
    """(run, behaviour) -> curiosity levels of its table, in their order."""
    rows = conditions.frame("policy")
    found: dict[tuple[str, str], list[str]] = {}
    if len(rows):
        tables = rows[["run", "behaviour", "curiosity_level"]].drop_duplicates()
        for run, behaviour, level in tables.itertuples(index=False):
            found.setdefault((run, behaviour), []).append(level)
    return found


@once_a_study
def _learned(conditions: Conditions, least_visits: int) -> dict[tuple[str, str, str], dict[int, int]]:
    """(run, behaviour, curiosity level or any) -> percept -> learned period, as :func:`greedy` says."""
    rows = conditions.frame("policy").astype({"behaviour": "category", "curiosity_level": "category"})
    state = ["run", "behaviour", "curiosity_level", "period", "percept"]
    groups = rows.groupby(state, observed=True)
    visits, values = groups["visits"].sum(), groups["q"]
    best = rows.loc[values.idxmax()].set_index(state)["action"]
    votes = visits[(visits > 0) & (values.max() > values.min())].to_frame("visits")
    votes["action"] = best.reindex(votes.index).to_numpy()  # an empty frame would take over the index of a series
    votes = votes.reset_index()
    found: dict[tuple[str, str, str], dict[int, int]] = {}
    for any_level in (False, True):
        of = votes.assign(curiosity_level="any") if any_level else votes
        keys = ["run", "behaviour", "curiosity_level", "percept"]
        total = of.groupby([*keys, "action"], observed=True)[["visits"]].sum().reset_index()
        total = total[total.groupby(keys, observed=True)["visits"].transform("sum") >= least_visits]
        total = total.sort_values([*keys, "visits", "action"]).drop_duplicates(keys, keep="last")
        for run, behaviour, level, percept, action in total[[*keys, "action"]].itertuples(index=False):
            found.setdefault((run, behaviour, level), {})[int(percept)] = int(action)
    return found


def greedy(runs: Runs, behaviour: str, level: str = "any", least_visits: int = 1) -> dict[int, dict[int, int]]:
    """Seed -> percept -> learned period (mc). Percepts that a seed visited less than ``least_visits`` times, or in
    which it learned no preference (all values equal: a learner that does not learn), are left out.

    The state holds the last period too, so each percept has a row a period: every row votes for its best action with
    its visits. ``level``: a curiosity level, or any (all levels vote).
    """
    tables = _levels(runs.conditions)
    known = [name for _, run in sorted(runs.runs.items()) for name in tables.get((run, behaviour), [])]
    if not known:
        raise CannotMeasure(f"there is no table of a behaviour {behaviour}")
    if level not in ("any", *known):
        raise CannotMeasure(f"there is no curiosity level '{level}' (there are {', '.join(dict.fromkeys(known))})")
    found = _learned(runs.conditions, least_visits)
    return {int(seed): dict(found.get((run, behaviour, level), {})) for seed, run in runs.runs.items()}


def in_words(policy: dict[int, int]) -> str:
    """A learned policy as the paper writes one: "12 in bins 1-4, 1 in bins 5-6"."""
    runs: list[list[int]] = []
    for percept in sorted(policy):
        if runs and policy[percept] == runs[-1][0] and percept == runs[-1][2] + 1:
            runs[-1][2] = percept
        else:
            runs.append([policy[percept], percept, percept])
    said = [f"{period} in bin {a}" if a == b else f"{period} in bins {a}-{b}" for period, a, b in runs]
    return ", ".join(said) if said else "never visited"


@register("measure", "policy_match")
class PolicyMatch(Measure):
    """Share of percept bins (%) in which the learned period is one of those that ``pattern`` names.

    A seed that never visited one of these bins has no value: what it would do there nobody knows.
    """
    unit = "%"
    bounds = (0.0, 100.0)

    @dataclass
    class Params:
        behaviour: str = setting("drink", "whose table")
        level: str = setting("any", "curiosity level: none, low, LH, HH, or any")
        pattern: dict[Any, Any] = setting({"1-6": 12}, "bins -> period or periods, e.g. {1-4: 12, 5-6: [1, 4]}")

        def __post_init__(self) -> None:
            self.bins = parse_pattern(self.pattern)

    def of(self, runs: Runs) -> dict[int, float]:
        found = {}
        wanted, most = self.params.bins, runs.reading().percept_bins
        if max(wanted) != most:
            raise CannotMeasure(f"the pattern speaks of {max(wanted)} bins, the runs have {most}")
        for seed, policy in greedy(runs, self.params.behaviour, self.params.level).items():
            agree = sum(policy.get(percept) in wanted[percept] for percept in wanted)
            found[seed] = 100 * agree / len(wanted) if set(wanted) <= set(policy) else float("nan")
        if all(value != value for value in found.values()):
            raise CannotMeasure(f"no seed visited all {len(wanted)} bins of {self.params.behaviour} at level "
                                f"{self.params.level}")
        return found


def parse_pattern(pattern: dict[Any, Any]) -> dict[int, tuple[int, ...]]:
    """{"1-4": 12, 5: [1, 4]} -> {1: (12,), ..., 5: (1, 4)}. Raises ConfigError."""
    bins: dict[int, tuple[int, ...]] = {}
    for key, periods in pattern.items():
        first, _, last = str(key).partition("-")
        wanted = tuple(periods) if isinstance(periods, list) else (periods,)
        if not first.isdigit() or not (last or first).isdigit() or not all(type(p) is int and p > 0 for p in wanted):
            raise ConfigError("pattern", f"{key!r}: {periods!r} is not bins: period(s)", "Write it as {1-4: 12}")
        bins.update(dict.fromkeys(range(int(first), int(last or first) + 1), wanted))
    if not bins:
        raise ConfigError("pattern", "names no bins", "Write it as {1-4: 12, 5-6: [1, 4]}")
    return bins


@register("measure", "policy_levels")
class PolicyLevels(Measure):
    """How much more the learned periods differ between curiosity levels than between seeds of one level (% of cells).

    A cell is a behaviour's percept; distance is the share of cells, visited by both, whose periods differ. A cell with
    fewer than ``least_visits`` counts as not visited. For the test ``permutation``: under "levels do not matter" the
    levels of a seed may be exchanged.
    """
    unit = "%"
    bounds = (-100.0, 100.0)
    compares_seeds = True

    @dataclass
    class Params:
        levels: list[str] = setting(["LH", "HH"], "curiosity levels to compare")
        least_visits: int = setting(20, "updates that make a cell known", low=1)

        def __post_init__(self) -> None:
            if len(set(self.levels)) < 2:
                raise ConfigError("levels", "needs two different curiosity levels or more")

    def tables(self, runs: Runs) -> np.ndarray:
        """Learned periods of shape (seeds, levels, cells), 0 where never visited."""
        import numpy as np
        there = set(runs.runs.values())
        names = sorted({name for run, name in _levels(runs.conditions) if run in there})
        bins = runs.reading().percept_bins
        table = np.zeros((len(runs.runs), len(self.params.levels), len(names) * bins), np.int64)
        for j, level in enumerate(self.params.levels):
            for b, name in enumerate(names):
                learned = greedy(runs, name, level, self.params.least_visits)
                for i, (_, policy) in enumerate(sorted(learned.items())):
                    for percept, period in policy.items():
                        table[i, j, b * bins + percept - 1] = period
        return table

    def of(self, runs: Runs) -> dict[int, float]:
        from attnlab.stats.levels import level_contrast
        table = self.tables(runs)
        return dict(zip(sorted(runs.runs), (100 * level_contrast(table)).tolist(), strict=True))

    def null(self, runs: Runs, draws: int, seed: int) -> np.ndarray:
        """Means over seeds of the same number with each seed's levels exchanged at random, shape (draws,)."""
        from attnlab.stats.levels import level_null
        return 100 * level_null(self.tables(runs), draws, seed)
