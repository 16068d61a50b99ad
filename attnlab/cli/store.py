"""Registered parts as config options of Hydra."""

from __future__ import annotations

from typing import Any

from attnlab import registry
from attnlab.config import RunSettings
from attnlab.groups import GROUPS
from attnlab.reading import Reading
from attnlab.settings import defaults_of

GROUPS_OF_RUN = {group for group in (*GROUPS, "reading")
                 if group in RunSettings.__dataclass_fields__}


def root_node() -> dict[str, Any]:
    """The top of the config: every setting that is not a group, with its default."""
    node = {key: value for key, value in defaults_of(RunSettings).items() if key not in GROUPS_OF_RUN}
    node["max_cycles"] = "${reading.max_cycles}"
    return node


def store_options() -> None:
    """Offer every registered part to Hydra; call after :func:`attnlab.registry.load_all`."""
    from hydra.core.config_store import ConfigStore
    store = ConfigStore.instance()
    store.store(name="settings", node=root_node(), provider="attnlab")
    store.store(group="reading", name="inferred", node={"name": "inferred", **defaults_of(Reading)},
                provider="attnlab")
    for (group, _), spec in registry.parts.items():
        if group not in GROUPS_OF_RUN:
            continue  # measures, say: parts of a report, not of a run
        for option, node in spec.nodes().items():
            package = GROUPS[group].node(option) if GROUPS[group].chosen == "list" else None
            store.store(group=group, name=option, node=node, package=package, provider=spec.origin)
