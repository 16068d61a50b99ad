"""Small studies for tests of what reads a study: a second or two of real runs, in a folder."""

from __future__ import annotations

import tempfile
from functools import cache
from pathlib import Path
from typing import Any

from attnlab.results.conditions import Conditions
from attnlab.results.load import load
from attnlab.tables.scratch import scratch
from attnlab.testing.build import config

SMALL = {"train_episodes": 6, "validation_episodes": 2, "max_cycles": 200, "record": "last"}
KINDS: dict[str, dict[str, Any]] = {
    "normal": {}, "bare": {"behaviours": ("wander",), "needs": "energy_only"}}  # bare: no AVOID, no needs


def plant(folder: Path, seeds: tuple[int, ...] = (0, 1, 2), curiosities: tuple[str, ...] = ("litman", "none"),
          **settings: Any) -> Path:
    """Run a study of a few short runs into ``folder``; ``settings`` as of :func:`attnlab.testing.config`."""
    from attnlab.robot.folder import run_to_folder
    for seed in seeds:
        for curiosity in curiosities:
            name = f"{curiosity}-seed{seed}"
            info = {"run": name, "key": name, "overrides": [f"curiosity={curiosity}", f"seed={seed}"], "swept": {}}
            chosen = config(**{**SMALL, "seed": seed, "curiosity": curiosity, **settings})
            assert run_to_folder(chosen, folder / name, info), f"{folder / name} failed"
    return folder


@cache
def _home() -> tempfile.TemporaryDirectory[str]:
    """Goes with the process."""
    return scratch()


@cache
def _folder(kind: str, seeds: tuple[int, ...]) -> Path:
    folder = Path(_home().name) / f"{kind}-{'-'.join(map(str, seeds))}"
    if kind != "empty":
        return plant(folder, seeds, **KINDS[kind])
    (folder / "run").mkdir(parents=True)
    (folder / "run" / "run.json").write_text('{"status": "failed", "error": "none is complete", "seed": 0}')
    return folder


def conditions(kind: str = "normal", seeds: tuple[int, ...] = (0, 1, 2)) -> Conditions:
    """CR and NCR of these seeds, read anew: a ``normal`` study, a ``bare`` one (robots without AVOID and without
    needs), or an ``empty`` one (no run is complete)."""
    return Conditions(load(_folder(kind, seeds)))
