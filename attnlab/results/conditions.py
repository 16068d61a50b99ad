"""A study seen as conditions: which runs belong together, what sets them apart, what they are called.

Conditions and their names are those of the study's file. Runs are sorted by curiosity and by the settings that set
conditions apart. Everything that goes beyond one run (measures, claims, figures) reads through here.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

from attnlab.config import layout_of, recorded_reading
from attnlab.errors import ConfigError
from attnlab.loading import load_all
from attnlab.results.load import Study
from attnlab.tables.flat import dig, text
from attnlab.tables.naming import is_value, value_of

if TYPE_CHECKING:
    import pandas as pd

    from attnlab.reading import Reading
    from attnlab.worlds.base import Layout


class Runs:
    """Some runs of a study, one a seed: what a measure is given. ``runs`` maps seed -> run name."""

    def __init__(self, conditions: Conditions, where: Mapping[str, Any], runs: Mapping[int, str]):
        self.conditions, self.where, self.runs = conditions, dict(where), dict(runs)

    def rows(self, table: str, **equal: Any) -> pd.DataFrame:
        """Rows of these runs in a table, with a ``seed`` column; ``equal``: column=value to keep."""
        return self.conditions.rows(table, self.runs, equal)

    def config(self, seed: int) -> dict[str, Any]:
        """The resolved config of the run with this seed."""
        return self.conditions.configs[self.runs[seed]]

    def reading(self) -> Reading:
        """The reading of the first run."""
        load_all()
        return recorded_reading(self.config(min(self.runs)))

    def setting(self, name: str, seed: int | None = None) -> Any:
        """A setting by its dotted name from the first (or the given) run; None if there is none."""
        seeds = sorted(self.runs)
        return dig(self.config(seeds[0] if seed is None else seed), name) if seeds else None


class Conditions:
    """All complete runs of a study by condition.

    ``settings``: names of what differs besides curiosity and seed. ``notes``: one line for everything odd.
    """

    def __init__(self, study: Study, labels: Mapping[str, str] | None = None):
        self.study, self.notes = study, list(study.file.notes)
        self.configs = {run: study.config(run) for run in sorted(study.complete)}
        self.settings = list(study.swept)
        self.labels = {**{str(value): str(name) for value, name in (labels or {}).items()}, **study.file.labels}
        self._texts = {c.name: tuple(text(c.settings.get(name)) for name in ("curiosity", *self.settings))
                       for c in study.file.conditions}
        self._by_key = self._sort_runs()
        self._indices: dict[str, dict[str, Any]] = {}

    def _sort_runs(self) -> dict[tuple[str, ...], dict[int, str]]:
        """(curiosity, settings) -> seed -> run, in the order in which conditions were asked for."""
        keys: dict[tuple[str, ...], dict[int, str]] = {}
        for run in self.study.named():
            seeds, seed = keys.setdefault(self._texts[self.study.condition(run).name], {}), self.study.seed(run)
            if seed in seeds:
                self.notes.append(f"run {run} is left out: seed {seed} of its condition is there already "
                                  f"({seeds[seed]})")
            else:
                seeds[seed] = run
        return keys

    # views

    @property
    def keyed(self) -> list[tuple[str, ...]]:
        """(curiosity, *settings) of every condition that has runs."""
        return list(self._by_key)

    @cached_property
    def curiosities(self) -> list[str]:
        """Values of curiosity, those with a label first (CR before NCR as labelled), then as they were asked for."""
        return self._labelled(dict.fromkeys(key[0] for key in self._by_key))

    @cached_property
    def strata(self) -> list[tuple[str, ...]]:
        """Combinations of ``settings`` (as texts) that have runs, those with a label in the order of the labels, then
        as they were asked for; [()] if nothing else differs."""
        order = list(self.labels)
        found = dict.fromkeys(key[1:] for key in self._by_key)
        return sorted(found, key=lambda stratum: [order.index(value) if value in order else len(order)
                                                  for value in stratum])

    def _labelled(self, values: Iterable[str]) -> list[str]:
        order = list(self.labels)
        return sorted(values, key=lambda value: order.index(value) if value in order else len(order))

    def runs(self, curiosity: str, stratum: tuple[str, ...] = ()) -> Runs:
        """The runs of a condition; empty if there are none."""
        where = {"curiosity": curiosity, **dict(zip(self.settings, stratum, strict=False))}
        return Runs(self, where, self._by_key.get((curiosity, *stratum), {}))

    def matching(self, where: Mapping[str, Any], stratum: Mapping[str, str]) -> tuple[Runs, str]:
        """Runs with these settings (a role of a claims file), within a stratum; a note if seeds were found twice."""
        found: dict[int, str] = {}
        twice = 0
        for key, seeds in sorted(self._by_key.items()):
            has = {"curiosity": key[0], **dict(zip(self.settings, key[1:], strict=True))}
            if all(has.get(name) == value for name, value in stratum.items()) and \
                    all(self._fits(has, seeds, name, value) for name, value in where.items()):
                twice += len(set(found) & set(seeds))
                found = {**seeds, **found}
        return Runs(self, where, found), f"{twice} seeds fit twice; the first was taken" if twice else ""

    def _fits(self, has: Mapping[str, str], seeds: Mapping[int, str], name: str, value: Any) -> bool:
        if name in has:
            return is_value(name, has[name], value)
        config = self.configs[next(iter(seeds.values()))]
        return is_value(name, text(value_of({}, config, name)), value)

    def name(self, curiosity: str) -> str:
        """What a curiosity is called in figures."""
        return self.labels.get(curiosity, curiosity)

    def stratum_name(self, stratum: tuple[str, ...]) -> str:
        """What sets a combination apart: setting=value for a few settings, the label of a single one that has it, a
        number for many."""
        if len(self.settings) > 5:
            if "variant" in self.settings:
                place = self.settings.index("variant")
                if sum(other[place] == stratum[place] for other in self.strata) == 1:
                    return stratum[place]
            return f"combination {self.strata.index(stratum) + 1}"
        if len(stratum) == 1 and list(self.labels.values()).count(self.labels.get(stratum[0], "")) == 1:
            return self.labels[stratum[0]]
        return ", ".join(f"{name}={value}" for name, value in zip(self.settings, stratum, strict=True))

    def rows(self, table: str, runs: Mapping[int, str], equal: Mapping[str, Any]) -> pd.DataFrame:
        """Rows of runs (seed -> run) in a table."""
        frame = self.frame(table)
        if table not in self._indices:
            of_run = frame.groupby("run", observed=True).indices if len(frame) else {}
            self._indices[table] = {str(run): rows for run, rows in of_run.items()}
        indices = self._indices[table]
        parts, seeds = [], []
        for seed, run in sorted(runs.items()):
            if run in indices:
                parts.append(indices[run])
                seeds += [seed] * len(indices[run])
        import numpy as np
        chosen = frame.iloc[np.concatenate(parts)] if parts else frame.iloc[:0]
        chosen = chosen.assign(seed=seeds)
        for column, value in equal.items():
            chosen = chosen[chosen[column] == value]
        return chosen

    def layout(self, run: str) -> Layout | None:
        """The world of a run, built again from its config and seed; None if that world's plugin is not here."""
        load_all()
        try:
            return layout_of(self.configs[run].get("world") or {}, self.configs[run].get("seed", 0))
        except ConfigError:
            return None

    def frame(self, table: str) -> pd.DataFrame:
        """A whole table; of ``cycles`` only the last recorded episode of each run is read."""
        return self.study.plain(table)
