"""The top of a run's config, and what both wings make of one: its key, its reading, its world."""

from __future__ import annotations

import dataclasses
import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from attnlab import registry
from attnlab.errors import ConfigError
from attnlab.reading import Reading
from attnlab.settings import build, cosmetics, setting
from attnlab.worlds.base import Layout


@dataclass
class ValidationSettings:
    simulator: str | None = setting(None, "validate on another simulator than the one trained on")
    drive: Literal["kinematic", "wheels"] | None = setting(None, "drive of the pybullet that validates")


@dataclass
class RunSettings:
    """Everything at the top of a config. Groups are mappings with the ``name`` of the chosen part. A cosmetic setting
    changes no number: it is in no run's key, sets no conditions apart, and cannot be swept."""
    seed: int = setting(0, "every draw of the run follows from it", low=0, high=2**63 - 1)
    train_episodes: int = setting(500, "episodes that learn", low=1, high=10**12)
    validation_episodes: int = setting(100, "episodes after them, without learning", low=0, high=10**12)
    max_cycles: int = setting(1150, "machine cycles an episode; follows the reading", unit="mc", low=1, high=10**7)
    periods: list[int] = setting([1, 4, 8, 12], "periods a clock may have", unit="mc", low=1, high=10_000)
    study: str = setting("main", "folder of the results inside outputs", cosmetic=True)
    outputs: str = setting("outputs", "root folder of all results", cosmetic=True)
    fresh: bool = setting(False, "run again what is complete already", cosmetic=True)
    record: Literal["none", "last", "validation", "all"] = setting(
        "last", "episodes whose cycles are stored: the last one, all of validation, all, none")
    check_identities: bool = setting(True, "check the bookkeeping on every cycle")
    picture: bool = setting(True, "draw the study's figures at its end", cosmetic=True)
    report: bool = setting(True, "build the study's report at its end", cosmetic=True)
    claims_file: str = setting("dinocera2014", "claims the study is judged by; its hash is stored with a run",
                               cosmetic=True)
    variants: Any = setting(None, "settings that are swept together: {name: {setting: value, ...}, ...}, or "
                            "{design: multiverse, size: 64, seed: 0}", cosmetic=True)
    labels: dict[str, Any] = setting({}, "names of conditions in tables and figures, e.g. {litman: CR, none: NCR}",
                                     cosmetic=True)
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
        if len(set(self.periods)) != len(self.periods) or not self.periods:
            raise ConfigError("periods", f"{self.periods} must be different whole numbers, at least one")
        if not self.study or any(c in self.study for c in "/\\\0\n") or self.study.startswith("."):
            raise ConfigError("study", f"{self.study!r} cannot be the name of a folder")


COSMETIC = cosmetics(RunSettings)
_layouts: dict[str, Layout] = {}


def run_key(config: Mapping[str, Any]) -> str:
    """Ten hex digits of everything in a config that can change a number; a group of which nothing is chosen cannot."""
    kept = {key: value for key, value in config.items() if key not in COSMETIC and (value != {} or key == "reading")}
    return hashlib.sha256(json.dumps(kept, sort_keys=True, default=str).encode()).hexdigest()[:10]


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
