"""Configs of a sweep's runs, composed by Hydra once for each choice of parts.

Composing takes Hydra some 20 ms. Runs that differ in plain values (``learner.alpha=0.1``) share what was composed for
their parts; the values are set in a copy, as Hydra would have set them last.
"""

from __future__ import annotations

import pickle
import re
from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any

from hydra.core.override_parser.overrides_parser import OverridesParser
from hydra.core.override_parser.types import Override
from omegaconf import DictConfig, OmegaConf, open_dict

from attnlab.tables.flat import dig, flatten

_REFERENCE = re.compile(r"\$\{([\w.]+)\}\Z")


class Composer:
    """Composes configs from overrides in Hydra's grammar."""

    def __init__(self, loader: Any, master: DictConfig):
        self.loader, self.master = loader, master
        self.parser = OverridesParser.create(config_loader=loader)
        self._parsed: dict[str, Override] = {}
        self._composed: dict[tuple[str, ...], bytes] = {}
        self._group = cache(loader.repository.group_exists)

    def parsed(self, override: str) -> Override:
        """One override as Hydra reads it."""
        if override not in self._parsed:
            self._parsed[override] = self.parser.parse_override(override)
        return self._parsed[override]

    def config(self, overrides: Sequence[str]) -> dict[str, Any]:
        """The resolved config under these overrides, as plain data of its own."""
        plain = {text: found for text in overrides if (found := self._plain(self.parsed(text)))}
        base = self._base(tuple(text for text in overrides if text not in plain))
        if all(_has(base, path) for path, _ in plain.values()):
            for path, value in plain.values():
                dig(base, path.rpartition(".")[0])[path.rpartition(".")[2]] = value
            if _resolve(base):
                return base
        composed, choices = self._by_hydra(overrides)
        config: dict[str, Any] = OmegaConf.to_container(composed, resolve=True)  # type: ignore[assignment]  # a mapping
        return named_by_file(config, choices)

    def _plain(self, override: Override) -> tuple[str, Any] | None:
        """(dotted name, value) if the override sets one value that is there already, and no more."""
        key = override.key_or_group
        value = override.value()
        if override.is_add() or override.is_force_add() or override.is_delete() or override.package is not None \
                or self._group(key) or isinstance(value, Mapping) or "$" in str(value):
            return None
        return key, value

    def _base(self, overrides: tuple[str, ...]) -> dict[str, Any]:
        if overrides not in self._composed:
            composed, choices = self._by_hydra(overrides)
            config: dict[str, Any] = OmegaConf.to_container(composed)  # type: ignore[assignment]  # a mapping
            self._composed[overrides] = pickle.dumps(named_by_file(config, choices))
        base: dict[str, Any] = pickle.loads(self._composed[overrides])
        return base

    def _by_hydra(self, overrides: Sequence[str]) -> tuple[DictConfig, dict[str, Any]]:
        """(the config, the option chosen of each group)."""
        config: DictConfig = self.loader.load_sweep_config(self.master, list(overrides))
        choices = dict(config.hydra.runtime.choices)
        with open_dict(config):
            config.pop("hydra")
        return config, choices


def named_by_file(config: dict[str, Any], choices: Mapping[str, Any]) -> dict[str, Any]:
    """The config with every part under the name it was chosen by: a file that was copied may still have the old one."""
    for group, option in choices.items():
        node = config.get(group)
        if isinstance(option, str) and isinstance(node, dict) and "name" in node and node["name"] != option:
            node.setdefault("part", node["name"])
            node["name"] = option
    return config


def _has(config: Mapping[str, Any], path: str) -> bool:
    """Is there a setting of this name that is no mapping?"""
    head, _, last = path.rpartition(".")
    node = dig(config, head) if head else config
    return isinstance(node, Mapping) and last in node and not isinstance(node[last], Mapping)


def _resolve(config: dict[str, Any]) -> bool:
    """Replace every ``${a.b}`` by what it names; False if something else must be resolved."""
    for path, value in flatten(config).items():
        if isinstance(value, str) and "${" in value:
            found = _REFERENCE.match(value)
            meant = dig(config, found[1]) if found else None
            if meant is None or isinstance(meant, Mapping) or "${" in str(meant):
                return False
            head, _, last = path.rpartition(".")
            (dig(config, head) if head else config)[last] = meant
        elif isinstance(value, list) and "${" in str(value):
            return False
    return True
