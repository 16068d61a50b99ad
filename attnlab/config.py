"""The top of a run's config, and what both wings make of one: its key, its reading, its world."""

from __future__ import annotations

import dataclasses
import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any, Literal, get_args, get_origin

from attnlab import registry
from attnlab.errors import ConfigError, nearest
from attnlab.groups import GROUPS
from attnlab.reading import Reading
from attnlab.settings import build, cosmetics, hints_of, setting, without_late
from attnlab.worlds.base import Layout


@dataclass
class ValidationSettings:
    simulator: str | None = setting(None, "validate on another simulator than the one trained on")
    drive: Literal["kinematic", "wheels"] | None = setting(None, "drive of the pybullet that validates")
    clamp_level: Literal["none", "low", "LH", "HH"] = setting(
        "none", "hold everybody's curiosity level in the state at this one, whatever is wanted and liked: what was "
        "learned for that level acts", late=True)


@dataclass
class TuneSettings:
    goal: Any = setting(None, "look for what makes this measure best, by Optuna: its name, or {name: survival, phase: "
                        "train}; what is swept is then what may be chosen")
    trials: int = setting(30, "choices that are tried, each with all seeds", low=1, high=10_000)
    minimise: bool = setting(False, "the least is best")


@dataclass
class RunSettings:
    """Everything at the top of a config. Groups are mappings with the ``name`` of the chosen part. A cosmetic setting
    changes no number: it is in no run's key, sets no conditions apart, and cannot be swept."""
    seed: int = setting(0, "every draw of the run follows from it", low=0, high=2**63 - 1)
    train_episodes: int = setting(500, "episodes that learn; 0 needs start_from", low=0, high=10**12)
    validation_episodes: int = setting(100, "episodes after them, without learning", low=0, high=10**12)
    max_cycles: int = setting(1150, "machine cycles an episode; follows the reading", unit="mc", low=1, high=10**7)
    periods: list[int] = setting([1, 4, 8, 12], "periods a clock may have", unit="mc", low=1, high=10_000)
    study: str = setting("main", "folder of the results inside outputs", cosmetic=True)
    outputs: str = setting("outputs", "root folder of all results", cosmetic=True)
    fresh: bool = setting(False, "run again what is complete already", cosmetic=True)
    record: Literal["none", "last", "validation", "all"] = setting(
        "last", "episodes whose cycles are stored: the last one, all of validation, all, none")
    check_identities: bool = setting(True, "check the bookkeeping on every cycle")
    engine: Literal["auto", "python", "compiled"] = setting(
        "auto", "the loop as Python, or compiled from the same classes; auto compiles when it pays", cosmetic=True)
    picture: bool = setting(True, "draw the study's figures at its end", cosmetic=True)
    report: bool = setting(True, "build the study's report at its end", cosmetic=True)
    claims_file: str = setting("dinocera2014", "claims the study is judged by; its hash is stored with a run",
                               cosmetic=True)
    variants: Any = setting(None, "settings that are swept together: {name: {setting: value, ...}, ...}, or "
                            "{design: multiverse, size: 64, seed: 0}", cosmetic=True)
    tune: TuneSettings = setting(TuneSettings(), "a search among the values that are swept", cosmetic=True)
    labels: dict[str, Any] = setting({}, "names of conditions in tables and figures, e.g. {litman: CR, none: NCR}",
                                     cosmetic=True)
    start_from: str | None = setting(None, "folder of a complete run whose robot goes on here, with all it has learned",
                                     late=True)
    checkpoint_minutes: float | None = setting(
        10.0, "a run keeps every so often where it is, and a killed one goes on from there; null for never", unit="min",
        low=0, cosmetic=True)
    validation: ValidationSettings = setting(ValidationSettings(), "how validation differs from training")
    reading: dict[str, Any] = setting({}, "how the paper's open points are read")
    simulator: dict[str, Any] = setting({}, "")
    world: dict[str, Any] = setting({}, "")
    behaviours: dict[str, Any] = setting({}, "")
    needs: dict[str, Any] = setting({}, "")
    fusion: dict[str, Any] = setting({}, "")
    curiosity: dict[str, Any] = setting({}, "")
    learner: dict[str, Any] = setting({}, "")
    exploration: dict[str, Any] = setting({}, "")
    probe: dict[str, Any] = setting({}, "columns of one's own")
    callback: dict[str, Any] = setting({}, "who watches", cosmetic=True)
    cluster: dict[str, Any] = setting({}, "where a sweep runs", cosmetic=True)

    def __post_init__(self) -> None:
        if self.train_episodes < 1 and self.start_from is None:
            raise ConfigError("train_episodes", "is 0, must be at least 1", "0 is for robots of start_from")
        if self.train_episodes + self.validation_episodes < 1:
            raise ConfigError("validation_episodes", "is 0, and there is no training either")
        if len(set(self.periods)) != len(self.periods) or not self.periods:
            raise ConfigError("periods", f"{self.periods} must be different whole numbers, at least one")
        if not self.study.strip() or not self.study.isprintable() or set(self.study) & set("/\\") or \
                self.study.startswith("."):
            raise ConfigError("study", f"{self.study!r} cannot be the name of a folder")
        if len(self.study.encode()) > LONGEST_NAME:
            raise ConfigError("study", f"its name has {len(self.study.encode())} bytes", f"At most {LONGEST_NAME}")
        if not self.outputs.strip() or not self.outputs.isprintable():
            raise ConfigError("outputs", f"{self.outputs!r} cannot be a folder", "outputs=outputs")
        words = list(self.labels.values())
        for value, label in self.labels.items():
            if not isinstance(label, (str, int, float)) or not str(label).strip():
                raise ConfigError(f"labels.{value}", f"expected a word, got {label!r}")
            if words.count(label) > 1:
                raise ConfigError("labels", f"'{label}' would name two conditions", "Labels must differ")


COSMETIC = cosmetics(RunSettings)
_LATE: dict[str, type] = {"reading": Reading, "validation": ValidationSettings}
LONGEST_NAME = 240  # bytes: a file's name has 255 at most, and a study may be copied as NAME_pybullet
_layouts: dict[str, Layout] = {}


def check_path(path: str) -> None:
    """Raise ConfigError, with the nearest right name, unless some run can have a setting (or group) called ``path``."""
    head, *rest = path.split(".")
    if head not in RunSettings.__dataclass_fields__ or not all(rest):
        raise no_such_setting(path)
    group = GROUPS.get(head)
    if group is None:
        hint = Reading if head == "reading" else hints_of(RunSettings)[head]
        _walk([hint], rest, path)
        return
    specs = [spec for spec in registry.parts.values() if spec.group == head]
    if rest and group.chosen == "list":
        options = [option for spec in specs for option in spec.options]
        if rest[0] not in options:
            raise ConfigError(path, f"no {head} is called '{rest[0]}'", nearest(rest[0], options))
        specs, rest = [spec for spec in specs if rest[0] in spec.options], rest[1:]
    if rest and rest[0] in ("name", "part"):
        raise ConfigError(path, "a part is chosen by its group", group.typed("NAME"))
    _walk([spec.params for spec in specs], rest, path)


def _walk(owners: Sequence[Any], rest: Sequence[str], path: str) -> None:
    """Raise ConfigError unless one of the types has a setting ``rest[0]``, that one ``rest[1]``, and so on."""
    if not rest:
        return
    known: dict[str, list[Any]] = {}
    for owner in owners:
        for kind in (owner, *get_args(owner)):
            if kind is Any or kind is dict or get_origin(kind) is dict:
                return  # names of one's own
            if isinstance(kind, type) and dataclasses.is_dataclass(kind):
                for name, hint in hints_of(kind).items():
                    known.setdefault(name, []).append(hint)
    if rest[0] not in known:
        raise ConfigError(path, "no such setting", nearest(rest[0], known) if known else "It takes no settings")
    _walk(known[rest[0]], rest[1:], path)


def no_such_setting(path: str) -> ConfigError:
    """The error for a setting whose first name is none: where one of its last name is, or the nearest first name."""
    head, _, last = path.partition(".")
    heads = list(RunSettings.__dataclass_fields__)
    if last:
        close = get_close_matches(head, heads, n=1)
        return ConfigError(path, f"there is no '{head}'", f"Did you mean '{close[0]}.{last}'?" if close
                           else nearest(head, heads))
    nodes = {group.node(spec.name) for (name, _), spec in registry.parts.items() if (group := GROUPS[name]).in_run
             and path in spec.params.__dataclass_fields__}
    homes = ["reading"] if path in Reading.__dataclass_fields__ else sorted(nodes)
    meant = " or ".join(f"'{node}.{path}'" for node in homes[:4])
    if path == "penalty":
        meant = "'reading.penalised' or 'reading.penalty'"
    return ConfigError(path, "no such setting", f"Did you mean {meant}?" if meant else nearest(path, heads))


def run_key(config: Mapping[str, Any]) -> str:
    """Ten hex digits of everything in a config that can change a number; a group of which nothing is chosen cannot."""
    kept = {key: value for key, value in that_count(config).items() if value != {} or key == "reading"}
    return digits_of(kept)


def digits_of(config: Mapping[str, Any]) -> str:
    """Ten hex digits of settings. A robot that a run goes on from is known by its hash, wherever it is."""
    kept = dict(config)
    if "start_from" in kept:
        kept["start_from"] = str(kept["start_from"]).rpartition("#")[2]
    return hashlib.sha256(json.dumps(kept, sort_keys=True, default=str).encode()).hexdigest()[:10]


def that_count(config: Mapping[str, Any]) -> dict[str, Any]:
    """What of a config can change a number: all but cosmetic settings, and late ones that are not set."""
    return {key: without_late(_settings_of(key, value), value)
            for key, value in without_late(RunSettings, config).items() if key not in COSMETIC}


def _settings_of(name: str, node: Any) -> type | None:
    """The dataclass of what a config has under this name: reading, validation, or the part chosen of a group."""
    if name in _LATE or not isinstance(node, Mapping):
        return _LATE.get(name)
    spec = registry.parts.get((name, str(node.get("part") or node.get("name"))))
    return spec.params if spec else None


def reading_of(settings: RunSettings) -> Reading:
    """The reading of a run: as chosen, with the cycles of the run and what its world says of its sources."""
    chosen = {key: value for key, value in settings.reading.items() if key != "name"}
    sources = getattr(registry.build_params("world", settings.world, "world")[1], "sources", None)
    return build(Reading, {**chosen, "max_cycles": settings.max_cycles, **(sources.of_reading() if sources else {})},
                 "reading")


def layout_of(world: Mapping[str, Any], seed: int) -> Layout:
    """The world of a run, from its config node and the seed; built once a process, for many runs share it. Raises
    ConfigError that names the world as it is typed."""
    key = json.dumps([world, seed], sort_keys=True, default=str)
    if key not in _layouts:
        _layouts[key] = _built(world, seed)
    return _layouts[key]


def _built(world: Mapping[str, Any], seed: int) -> Layout:
    try:
        layout: Layout = registry.make("world", world, None).build(seed)
        return layout
    except ConfigError as error:
        if error.setting.startswith("world"):
            raise
        raise ConfigError(f"world={world.get('name')}", f"{error.setting}: {error.problem}", error.hint) from None


def recorded_reading(config: Mapping[str, Any]) -> Reading:
    """The reading of a run that was stored, perhaps by an older version: a setting that its config does not mention has
    its default, one that is no more is left out."""
    names = {field.name for field in dataclasses.fields(Reading)}
    known = {key: value for key, value in (config.get("reading") or {}).items() if key in names}
    if config.get("max_cycles"):
        known["max_cycles"] = config["max_cycles"]
    try:
        sources = getattr(registry.build_params("world", config.get("world") or {}, "world")[1], "sources", None)
    except ConfigError:  # a world of another version, or of a plugin that is not here
        sources = None
    return dataclasses.replace(Reading(), **known, **(sources.of_reading() if sources else {}))
