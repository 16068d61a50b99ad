"""A fingerprint of a run's tables, to compare runs bit for bit wherever they were made."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from typing import Any


def digest(tables: Mapping[str, Mapping[str, Sequence[Any]]]) -> str:
    """16 hexadecimal digits of all values of all tables by name, every bit of every float; not of Arrow's file format,
    which may change with its version."""
    found = hashlib.sha256()
    for table, columns in sorted(tables.items()):
        for name, values in sorted(columns.items()):
            found.update(f"{table}.{name}: {list(values)!r}\n".encode())
    return found.hexdigest()[:16]
