"""Configs of runs without Hydra, for tests of what is below the command line."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import yaml

from attnlab import registry
from attnlab.paths import conf_dir


def node(group: str, option: str, **changes: Any) -> dict[str, Any]:
    """The config node of ``group=option`` with some settings changed."""
    spec = registry.find(group, option)
    if spec is not None:
        return {**spec.nodes()[option], **changes}
    written = yaml.safe_load((Path(conf_dir()) / group / f"{option}.yaml").read_text())
    written.pop("defaults", None)
    return {**written, **changes}


def config(**changes: Any) -> dict[str, Any]:
    """A short run on planar with the default parts; groups may be given by name, ``reading`` as a dict of changes."""
    chosen = {"seed": 0, "train_episodes": 3, "validation_episodes": 1, "simulator": "planar", "world": "paper",
              "behaviours": ["avoid", "eat", "drink"], "needs": "survival", "fusion": "min_speed_sum_turn",
              "curiosity": "litman", "learner": "q_learning", "exploration": "softmax", "reading": {}, "cluster": {},
              **changes}
    if "max_cycles" not in chosen:
        chosen["max_cycles"] = chosen["reading"].get("max_cycles", 1150)
    chosen["behaviours"] = {name: node("behaviours", name) for name in chosen["behaviours"]} \
        if isinstance(chosen["behaviours"], list) else chosen["behaviours"]
    for group in ("simulator", "world", "needs", "fusion", "curiosity", "learner", "exploration"):
        if isinstance(chosen[group], str):
            chosen[group] = node(group, chosen[group])
    if isinstance(chosen["reading"], str):
        chosen["reading"] = node("reading", chosen["reading"])
    return chosen
