"""Claims as code: what a paper says, written down as rules before a run, and the verdicts of a study on them.

This module is light (the command line imports it): it only finds a claims file and fingerprints it. Reading one is
:mod:`attnlab.claims.files`, judging it is :mod:`attnlab.claims.judge`.
"""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Any

from attnlab.errors import ConfigError
from attnlab.loading import named_file

DEFAULT = "dinocera2014"


def claims_path(name: Any) -> Path:
    """The file of claims ``name``: a name (dinocera2014; in conf, a plugins folder or a pip package) or a path to a
    .yaml. Raises ConfigError if there is none."""
    if not isinstance(name, str) or not name.strip() or not name.isprintable():
        raise ConfigError("claims_file", f"expected the name or the path of a claims file, got {name!r}")
    return named_file("claims", name, "claims_file")


def claims_hash(name: str) -> str:
    """SHA-256 (64 hex digits) of the bytes of a claims file; ``name`` as in :func:`claims_path`."""
    return hashlib.sha256(claims_path(name).read_bytes()).hexdigest()


def claims_mark(name: str) -> dict[str, str]:
    """Name and hash of a claims file as it is now: what is stored with a run, so that later changes show."""
    return {"name": name, "sha256": claims_hash(name)}
