"""A study seen as conditions: which runs belong together, what sets them apart, what they are called.

Runs are sorted by curiosity, by the swept settings, and by any setting that differs although nobody swept it (two
studies mixed in one folder). Everything that goes beyond one run (measures, claims, figures) reads through here.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

from attnlab.config import COSMETIC, layout_of, recorded_reading
from attnlab.errors import ConfigError
from attnlab.loading import load_all
from attnlab.results.flat import dig, flatten, natural, text
from attnlab.results.load import Study

if TYPE_CHECKING:
    import pandas as pd

    from attnlab.reading import Reading
    from attnlab.worlds.base import Layout

IGNORED = {*COSMETIC, "seed", "experiment"}  # set no conditions apart


class Runs:
    """Some runs of a study, one a seed: what a measure is given. ``runs`` maps seed -> run name."""

    def __init__(self, conditions: Conditions, where: Mapping[str, Any], runs: Mapping[int, str]):
        self.conditions, self.where, self.runs = conditions, dict(where), dict(runs)

    def rows(self, table: str, **equal: Any) -> pd.DataFrame:
        """Rows of these runs in a table, with a ``seed`` column; ``equal``: column=value to keep."""
        return self.conditions.rows(table, self.runs, equal)

    def config(self, seed: int) -> dict:
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
        self.study, self.notes = study, []
        self.configs = {run: study.config(run) for run in study.complete}
        self.configs = {run: config for run, config in self.configs.items() if config is not None}
        for run in sorted(set(study.complete) - set(self.configs)):
            self.notes.append(f"run {run} is left out: its config.yaml is missing or unreadable")
        declared = [name for name in study.swept if name not in ("seed", "curiosity")]
        self.declared = list(declared)
        self.settings = declared + self._undeclared(declared)
        self.labels = {str(k): str(v) for c in self.configs.values() for k, v in (c.get("labels") or {}).items()}
        for value, name in (labels or {}).items():
            self.labels.setdefault(str(value), str(name))
        self._by_key = self._sort_runs()
        self._indices: dict[str, dict[str, Any]] = {}
        self._layouts: dict[str, Layout | None] = {}

    # which runs belong together

    def _undeclared(self, declared: list[str]) -> list[str]:
        """Settings that differ between runs of the same swept settings; each gets a note."""
        flat = {run: flatten(config) for run, config in self.configs.items()}
        groups: dict[tuple, list[str]] = {}
        for run in self.configs:
            groups.setdefault(tuple(text(self._value(run, name)) for name in declared), []).append(run)
        found: dict[str, dict[str, int]] = {}
        for runs in groups.values():
            for name in sorted({name for run in runs for name in flat[run]}):
                counts: dict[str, int] = {}
                for run in runs:
                    value = text(flat[run].get(name))
                    counts[value] = counts.get(value, 0) + 1
                if len(counts) > 1 and not (name.startswith("curiosity.") or name.partition(".")[0] in IGNORED):
                    total = found.setdefault(name, {})
                    for value, count in counts.items():
                        total[value] = total.get(value, 0) + count
        found = {name: counts for name, counts in found.items() if not _follows(name, found, flat)}
        for name, counts in found.items():
            parts = " and ".join(f"{value} in {n} run{'s' * (n > 1)}" for value, n in sorted(counts.items()))
            self.notes.append(f"runs of different studies are mixed here: {name} is {parts}; shown as conditions apart")
        return sorted(found)

    def _value(self, run: str, name: str) -> Any:
        swept = self.study.about(run).get("swept") or {}
        if name in swept:
            return swept[name]
        value = dig(self.configs[run], name)
        return value.get("name") if isinstance(value, Mapping) else value

    def _sort_runs(self) -> dict[tuple, dict[int, str]]:
        keys: dict[tuple, dict[int, str]] = {}
        for run in sorted(self.configs):
            about = self.study.about(run)
            key = (str(about.get("curiosity")), *(text(self._value(run, name)) for name in self.settings))
            seeds = keys.setdefault(key, {})
            seed = about.get("seed")
            if seed in seeds:
                self.notes.append(f"run {run} is left out: seed {seed} of its condition is there already "
                                  f"({seeds[seed]})")
            else:
                seeds[seed] = run
        return keys

    # views

    @cached_property
    def curiosities(self) -> list[str]:
        """Values of curiosity, those with a label first (CR before NCR as labelled), then by name."""
        found = sorted({key[0] for key in self._by_key})
        order = list(self.labels)
        return sorted(found, key=lambda c: (order.index(c) if c in order else len(order), c))

    @cached_property
    def strata(self) -> list[tuple[str, ...]]:
        """Combinations of ``settings`` (as texts) that have runs, those with a label in the order of the labels, then
        by number and name; [()] if nothing else differs."""
        found, order = {key[1:] for key in self._by_key}, list(self.labels)
        return sorted(found, key=lambda stratum: [(order.index(value) if value in order else len(order),
                                                   natural(value)) for value in stratum])

    def runs(self, curiosity: str, stratum: tuple[str, ...] = ()) -> Runs:
        """The runs of a condition; empty if there are none."""
        where = {"curiosity": curiosity, **dict(zip(self.settings, stratum, strict=False))}
        return Runs(self, where, self._by_key.get((curiosity, *stratum), {}))

    def matching(self, where: Mapping[str, Any], stratum: Mapping[str, str]) -> tuple[Runs, str]:
        """Runs with these settings (a role of a claims file), within a stratum; a note if seeds were found twice."""
        found, twice = {}, 0
        for key, seeds in sorted(self._by_key.items()):
            has = {"curiosity": key[0], **dict(zip(self.settings, key[1:], strict=True))}
            if all(has.get(name) == value for name, value in stratum.items()) and \
                    all(self._fits(has, seeds, name, value) for name, value in where.items()):
                twice += len(set(found) & set(seeds))
                found = {**seeds, **found}
        return Runs(self, where, found), f"{twice} seeds fit twice; the first was taken" if twice else ""

    def _fits(self, has: Mapping[str, str], seeds: Mapping[int, str], name: str, value: Any) -> bool:
        if name in has:
            return has[name] == text(value)
        run = next(iter(seeds.values()))
        return text(self._value(run, name)) == text(value)

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
        if len(stratum) == 1 and list(self.labels.values()).count(self.labels.get(stratum[0])) == 1:
            return self.labels[stratum[0]]
        return ", ".join(f"{name}={value}" for name, value in zip(self.settings, stratum, strict=True))

    def named(self) -> dict[str, str]:
        """What each run's condition is called where all are listed: run -> name, in the order of curiosities."""
        found = {}
        for stratum in self.strata:
            rivals = [c for c in self.curiosities if self.runs(c, stratum).runs]
            for curiosity in rivals:
                name, where = self.name(curiosity), self.stratum_name(stratum)
                alone = bool(where) and len(rivals) == 1 and where in self.labels.values()
                called = where if alone else " ".join(filter(None, (name, where)))
                found.update(dict.fromkeys(self.runs(curiosity, stratum).runs.values(), called))
        return found

    def rows(self, table: str, runs: Mapping[int, str], equal: Mapping[str, Any]) -> pd.DataFrame:
        """Rows of runs (seed -> run) in a table."""
        frame = self.frame(table)
        indices = self._indices.get(table)
        if indices is None:
            indices = self._indices[table] = frame.groupby("run", observed=True).indices if len(frame) else {}
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
        node, seed = self.configs[run].get("world") or {}, self.configs[run].get("seed", 0)
        key = json.dumps([node, seed if node.get("part") != "layout" else 0], sort_keys=True, default=str)
        if key not in self._layouts:
            load_all()
            try:
                self._layouts[key] = layout_of(node, seed)
            except (ConfigError, KeyError):
                self._layouts[key] = None
        return self._layouts[key]

    def frame(self, table: str) -> pd.DataFrame:
        """A whole table; of ``cycles`` only the last recorded episode of each run is read."""
        return self.study.plain(table)


def _follows(name: str, found: Mapping[str, Any], flat: Mapping[str, Mapping[str, Any]]) -> bool:
    """Is this setting a matter of which part was chosen? Then the part's name says it: world.name for world.boxes."""
    part = f"{name.partition('.')[0]}.name"
    if part == name or part not in found:
        return False
    values: dict[str, set[str]] = {}
    for settings in flat.values():
        values.setdefault(text(settings.get(part)), set()).add(text(settings.get(name)))
    return all(len(of) == 1 for of in values.values())
