"""Which code made a number: versions, commit, a hash of the package's files."""

from __future__ import annotations

import hashlib
import platform
import subprocess
from functools import cache
from typing import Any

from attnlab import __version__
from attnlab.paths import PACKAGE


def versions() -> dict[str, str]:
    """Of everything a number may depend on."""
    from importlib.metadata import PackageNotFoundError, version
    found = {"attnlab": __version__, "python": platform.python_version()}
    for package in ("numpy", "pybullet", "numba", "pyarrow", "hydra-core"):
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            continue
    return found


def commit() -> str:
    """Of the code that runs, ``-dirty`` where files differ from it; empty outside of a checkout of this project."""
    try:
        shown = subprocess.run(["git", "-C", str(PACKAGE), "describe", "--always", "--dirty", "--abbrev=10",
                                "--exclude=*"], capture_output=True, text=True, check=True, timeout=10).stdout.strip()
        top = subprocess.run(["git", "-C", str(PACKAGE), "rev-parse", "--show-toplevel"], capture_output=True,
                             text=True, check=True, timeout=10).stdout.strip()
    except (OSError, subprocess.SubprocessError):
        return ""
    return shown if top == str(PACKAGE.parent) else ""


@cache
def code() -> dict[str, Any]:
    """The code of this process: ``version``, ``commit``, ``dirty`` (were files changed since?), ``hash`` of the files
    that numbers come from."""
    shown = commit()
    return {"version": __version__, "commit": shown.removesuffix("-dirty"), "dirty": shown.endswith("-dirty"),
            "hash": package_hash()}


@cache
def package_hash(more: tuple[str, ...] = ()) -> str:
    """16 digits of the sha256 of every Python file that a run's numbers come from: all of the package but what reads
    studies, what drives them, and the command line. ``more``: packages whose text decides a number beside runs."""
    digest = hashlib.sha256()
    for file in sorted(PACKAGE.rglob("*.py")):
        name = file.relative_to(PACKAGE)
        if name.parts[0] in (*NUMBERS, *more) or (len(name.parts) == 1 and name.stem in NUMBERS):
            digest.update(f"{name.as_posix()}\0".encode() + file.read_bytes() + b"\0")
    return digest.hexdigest()[:16]


NUMBERS = frozenset({  # packages and modules whose text decides what a run computes
    "arithmetic", "attention", "compiled", "config", "cycle", "equations", "reading", "settings", "streams",
    "behaviours", "curiosity", "exploration", "fusion", "kernels", "learners", "logs", "needs", "penalty", "pioneer",
    "probes", "robot", "simulators", "tables", "worlds"})
