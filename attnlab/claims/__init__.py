"""Claims as code: what a paper says, written down as rules before a run, and the verdicts of a study on them.

This module is light (the command line imports it): it only finds a claims file and fingerprints it. Reading one is
:mod:`attnlab.claims.files`, judging it is :mod:`attnlab.claims.judge`.
"""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Any

from attnlab.errors import ConfigError, nearest

DEFAULT = "dinocera2014"


def claims_folders() -> list[Path]:
    """Where claims files are looked for by name: conf/claims, and claims/ in every plugins folder."""
    from attnlab.loading import plugin_folders
    from attnlab.paths import conf_dir
    return [folder for folder in (conf_dir() / "claims", *(f / "claims" for f in plugin_folders())) if folder.is_dir()]


def claims_path(name: Any) -> Path:
    """The file of claims ``name``: a name (dinocera2014) or a path to a .yaml. Raises ConfigError if there is none."""
    if not isinstance(name, str) or not name.strip():
        raise ConfigError("claims_file", f"expected the name or the path of a claims file, got {name!r}")
    path = Path(name)
    if path.suffix in (".yaml", ".yml") or len(path.parts) > 1:
        if path.is_file():
            return path
        raise ConfigError(f"claims_file={name}", "there is no such file")
    for folder in claims_folders():
        found = folder / f"{name}.yaml"
        if found.is_file():
            return found
    known = {file.stem for folder in claims_folders() for file in folder.glob("*.yaml")}
    raise ConfigError(f"claims_file={name}", f"no claims file is called '{name}'",
                      nearest(name, known) if known else "")


def claims_hash(name: str) -> str:
    """SHA-256 (64 hex digits) of the bytes of a claims file; ``name`` as in :func:`claims_path`."""
    return hashlib.sha256(claims_path(name).read_bytes()).hexdigest()


def claims_mark(name: str) -> dict[str, str]:
    """Name and hash of a claims file as it is now: what is stored with a run, so that later changes show."""
    return {"name": name, "sha256": claims_hash(name)}
