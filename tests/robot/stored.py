"""Runs that are kept, for tests of what comes after."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from attnlab.config import run_key
from attnlab.robot.folder import run_to_folder
from attnlab.testing import config


def store(folder: Path, **settings: Any) -> Path:
    """Do a run of these settings and keep it; its folder."""
    whole = config(**settings)
    assert run_to_folder(whole, folder, {"run": folder.name, "key": run_key(whole), "overrides": [], "swept": {}}), \
        (folder / "run.json").read_text()
    return folder
