"""What was typed, checked before anything is composed: groups, options and settings, with the nearest right name.

Overrides are parsed by Hydra; which groups and options there are is asked of Hydra's loader, which settings of the
dataclasses. Values are checked later, when a run is planned.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from itertools import islice
from typing import Any

from hydra.core.object_type import ObjectType
from hydra.core.override_parser.overrides_parser import OverridesParser
from hydra.core.override_parser.types import IntervalSweep, Override, QuotedString, RangeSweep
from hydra.errors import HydraException

from attnlab import registry
from attnlab.config import RunSettings, check_path, no_such_setting
from attnlab.errors import ConfigError, nearest
from attnlab.groups import GROUPS
from attnlab.launch.searchpath import searchpath
from attnlab.paths import PACKAGE

ALLOWED = ("hydra.searchpath", "hydra.verbose", "hydra/job_logging", "hydra/hydra_logging")  # all else is ours
ELSEWHERE = {  # groups of files that no run is composed of
    "claims": "claims_file=NAME", "audit": "python -m attnlab.audit NAME", "captions": "They follow the claims file",
    "multiverse": "variants={design: multiverse}", "measure": "A claims file names measures",
    "figure": "Figures are drawn by python -m attnlab.report", "penalty": "reading.penalised=NAME"}
OWN_NAMES = ("labels", "variants")  # settings that hold names of one's own
MOST_CHECKED = 1000  # values of one sweep
MOST_RUNS = 100_000  # of one command


class Door:
    """Checks overrides against what Hydra's ``loader`` can find. Nothing of it composes a config."""

    def __init__(self, loader: Any):
        self.loader, self.searchpath = loader, list[str]()
        self.foreign = False  # is there a sweeper of others?
        self.parser = OverridesParser.create(config_loader=loader)
        self.options = cache(self._options)

    def in_place(self, arguments: Iterable[str]) -> list[str]:
        """Arguments with the + that Hydra wants: on a group or setting that is not there by default, on no other. Who
        types ``experiment=smoke`` or ``+learner.alpha=0.1`` is understood."""
        return [self._in_place(argument) for argument in arguments]

    def _in_place(self, argument: str) -> str:
        key = argument.partition("=")[0]
        plain = key.lstrip("+")
        rest = argument[len(key):]
        if plain in self.options(""):
            if plain in RunSettings.__dataclass_fields__ and _chosen(plain) != "list":
                return plain + rest
            return argument if plain in RunSettings.__dataclass_fields__ or plain == "hydra" else f"+{plain}{rest}"
        head = plain.partition(".")[0]
        if plain == "hydra.searchpath" and isinstance(folders := self._parsed(argument).value(), list):
            return searchpath([_plain(folder) for folder in folders])
        if head == "hydra":
            return argument
        if head in OWN_NAMES or (key.startswith("+") and "." in plain):  # there or not
            return f"++{plain}{rest}"
        return plain + rest if plain in RunSettings.__dataclass_fields__ else argument

    def parsed(self, arguments: Iterable[str]) -> list[Override]:
        """Arguments as Hydra reads them. Raises ConfigError."""
        return [self._parsed(argument) for argument in arguments]

    def check(self, arguments: Sequence[str]) -> list[Override]:
        """The parsed arguments. Raises ConfigError if one cannot be meant."""
        overrides = self.parsed(arguments)
        self.searchpath = [str(o.input_line) for o in overrides if o.key_or_group == "hydra.searchpath"]
        self.foreign = any(o.key_or_group == "hydra/sweeper" and o.value() != "basic" for o in overrides)
        seen: dict[str, Override] = {}
        for override in overrides:
            self.check_one(override)
            adds = override.is_add() and override.key_or_group in GROUPS and _chosen(override.key_or_group) == "list"
            name = str(override.input_line) if adds else override.key_or_group
            other = seen.setdefault(name, override)
            if other is not override:
                raise ConfigError(override.key_or_group, f"is typed twice: {other.input_line} and "
                                  f"{override.input_line}", "Keep one; several values to sweep over: a,b,c")
        return overrides

    def check_one(self, override: Override) -> None:
        """Is it something that a run has?"""
        key, text = override.key_or_group, str(override.input_line)
        if not key:
            raise ConfigError(text, "names no setting", "Write setting=value")
        if override.package is not None:
            raise ConfigError(text, "parts have their place, packages are not used", f"Write {key}=...")
        if key.partition(".")[0].partition("/")[0] == "hydra":
            self._check_hydra(key, text, override)
            return
        if override.is_delete():
            if key in RunSettings.__dataclass_fields__:
                raise ConfigError(key, "cannot be left out", f"Its default is taken where nothing is typed: no ~{key}")
            check_path(key)
            return
        for value in _values(override):
            self.check_setting(key, value)

    def check_setting(self, key: str, value: Any) -> None:
        """One setting or group and the value it gets."""
        if "_target_" in key or "_target_" in str(value):
            raise ConfigError(key, "no class is named in a config", "A part of one's own: docs/authors.md")
        head = key.partition(".")[0]
        if head in ELSEWHERE:
            raise no_such_setting(key) if "." in key or head == "penalty" else \
                ConfigError(key, "is not chosen for a run", ELSEWHERE[head])
        if key in self.options("") and key != "hydra":
            self._check_group(key, value)
        elif "/" in key:
            raise ConfigError(key, "no such group of parts",
                              nearest(key, [g for g in self.options("") if g not in ELSEWHERE and g != "hydra"]))
        else:
            check_path(key)

    def _check_group(self, group: str, value: Any) -> None:
        """Parts by name, or settings of the one chosen."""
        known = list(self.options(group))
        if isinstance(value, Mapping):
            if not value:
                raise ConfigError(group, "{} sets nothing", nearest("", known))
            for name in value:
                check_path(f"{group}.{name}")
            return
        several = _chosen(group) == "list"
        names = value if isinstance(value, list) else [value]
        if isinstance(value, list) and not several:
            raise ConfigError(group, f"there is one at a time, and this is a list: {_typed(value)}",
                              f"One run of each: {group}={','.join(map(str, value))}" if value else nearest("", known))
        for name in names:
            if not isinstance(name, str) or "$" in name:
                raise ConfigError(f"{group}={_typed(name)}", "expected a name", nearest("", known))
            if name not in known:
                raise registry.unknown(group, name, group, known)
            if names.count(name) > 1:
                raise ConfigError(group, f"{_typed(value)} names {name} twice", "Each once")

    def _check_hydra(self, key: str, text: str, override: Override) -> None:
        if key in ALLOWED:
            if override.is_delete() or override.value() is None:
                raise ConfigError(text, "sets nothing", "Leave it out")
            return
        if key == "hydra/sweeper" and not override.is_delete():
            self._check_group(key, override.value())
            return
        if key.startswith(("hydra.sweeper.", "hydra/sweeper/")) and self.foreign and "_target_" not in text:
            return
        hints = {"launcher": "Where runs are done is a part of ours: cluster=local",
                 "sweeper": "Sweeps are typed: python -m attnlab learner.alpha=0.1,0.5 seed=0-9",
                 "callbacks": "Who watches a run is a part of ours: callback=[...]",
                 "run": "Folders: outputs=... and study=...", "sweep": "Folders: outputs=... and study=..."}
        part = key.replace("/", ".").split(".")[1:2]
        raise ConfigError(text, "is not used here", hints.get(part[0] if part else "", "Of Hydra's own settings these "
                          f"are: {', '.join(ALLOWED)}"))

    def _options(self, group: str) -> tuple[str, ...]:
        """Names that can stand after ``group=``; the groups themselves for ""."""
        kind = ObjectType.CONFIG if group else ObjectType.GROUP
        return tuple(self.loader.get_group_options(group, kind, overrides=self.searchpath))

    def _parsed(self, argument: str) -> Override:
        try:
            override, = self.parser.parse_overrides([argument])
        except HydraException as cause:
            short = argument if len(argument) <= 60 else argument[:57] + "..."
            if argument.isidentifier() and any((PACKAGE / name).is_file()
                                               for name in (f"{argument}.py", f"{argument}/__main__.py")):
                raise ConfigError(short, "is no setting", f"Type: python -m attnlab.{argument}") from None
            raise ConfigError(short, f"cannot be read ({str(cause).splitlines()[0][:100]})",
                              "Write setting=value, and quote special characters: 'study=\"my study\"'") from None
        found: Override = override
        return found


def _values(override: Override) -> list[Any]:
    """The value that an override sets, or those it sweeps over."""
    if not override.is_sweep_override():
        return [override.value()]
    key = override.key_or_group
    if not override.is_discrete_sweep():  # for a search; the sweeper refuses it where all values are to be run
        if key in GROUPS:
            raise ConfigError(key, "interval(...) has numbers, and a part has a name", "List them: a,b,c")
        sweep = override.value()
        return [sweep.start, sweep.end] if isinstance(sweep, IntervalSweep) else []
    _check_range(override)
    try:
        values = list(islice(override.sweep_iterator(), MOST_CHECKED))
    except (ValueError, IndexError, HydraException):
        values = []
    if not values:
        raise ConfigError(key, f"{str(override.input_line).partition('=')[2]} names no value", "List them: a,b,c")
    if key == "experiment":
        raise ConfigError(key, "each is a study of its own", "One command for each")
    return [_plain(value) for value in values]


def _check_range(override: Override) -> None:
    """Raise ConfigError for a range of more values than a study may have; Hydra would list them, were they endless."""
    swept = override.value()
    if isinstance(swept, RangeSweep) and swept.start is not None and swept.stop is not None and swept.step:
        count = abs(float(swept.stop) - float(swept.start)) / abs(float(swept.step))
        if not count <= MOST_RUNS:
            raise ConfigError(override.key_or_group, f"{str(override.input_line).partition('=')[2]} has more than "
                              f"{MOST_RUNS:,} values")


def _plain(value: Any) -> Any:
    """A value of a sweep without Hydra's quotes."""
    if isinstance(value, QuotedString):
        return value.text
    if isinstance(value, list):
        return [_plain(item) for item in value]
    return {_plain(k): _plain(v) for k, v in value.items()} if isinstance(value, dict) else value


def _chosen(group: str) -> str:
    """How many options of a group there are at a time: ``list`` or ``option``."""
    return "list" if group == "experiment" or (group in GROUPS and GROUPS[group].chosen == "list") else "option"


def _typed(value: Any) -> str:
    """A value as one would type it."""
    return value if isinstance(value, str) else json.dumps(value, default=str).replace('"', "")

