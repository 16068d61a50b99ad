"""Folders in the temporary folder that say whose they are, so that those of killed processes can be removed."""

from __future__ import annotations

import contextlib
import os
import platform
import shutil
import tempfile
from pathlib import Path

from attnlab.tables.claim import place
from attnlab.tables.files import read_json, write_json
from attnlab.tables.processes import birth, is_running

PREFIX, OWNER = "attnlab-", ".attnlab-owner.json"
PREFIXES = (PREFIX, "pymp-")  # ours, and those that multiprocessing makes for its sockets


def scratch() -> tempfile.TemporaryDirectory[str]:
    """An empty folder that goes with the object, or else with the next command."""
    sweep_scratch()
    made = tempfile.TemporaryDirectory(prefix=PREFIX)
    sign(Path(made.name))
    return made


def sign(folder: Path) -> None:
    """Say that a temporary folder is this process's."""
    with contextlib.suppress(OSError):
        write_json(folder / OWNER, {"place": place(), "host": platform.node(), "pid": os.getpid(),
                                    "pid_birth": birth(os.getpid())})


def sweep_scratch() -> None:
    """Remove the signed folders of processes that are gone: of this user and this machine, where that can be told."""
    for prefix in PREFIXES:
        for file in Path(tempfile.gettempdir()).glob(f"{prefix}*/{OWNER}"):
            owner = read_json(file) or {}
            with contextlib.suppress(OSError, AttributeError):  # a system without user numbers
                if owner.get("place") == place() and file.stat().st_uid == os.getuid() and \
                        not is_running(owner, patience_s=0.0):
                    shutil.rmtree(file.parent, ignore_errors=True)
