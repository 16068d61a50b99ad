"""Folders of config files that a command line names."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from attnlab.errors import ConfigError

SCHEME = "attnlab"  # of addresses whose files are looked at, see attnlab.launch.harmless


def searchpath(folders: Sequence[Any]) -> str:
    """``hydra.searchpath=[...]`` of folders that were typed, under an address at which their files are looked at.
    Raises ConfigError for what is no folder."""
    addresses = []
    for folder in folders:
        path = str(folder).removeprefix("file://").removeprefix(f"{SCHEME}://")
        if "://" in path:
            raise ConfigError("hydra.searchpath", f"{folder} is no folder", "A pip package brings a folder of its own: "
                              "docs/authors.md")
        if not Path(path).is_dir():
            raise ConfigError("hydra.searchpath", f"there is no folder {path}")
        quoted = f"{SCHEME}://{path}".replace("\\", "\\\\").replace("'", "\\'")
        addresses.append(f"'{quoted}'")
    return f"hydra.searchpath=[{','.join(addresses)}]"
