"""Files that are whole or not there."""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import secrets
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from attnlab.tables.schema import Column


def write_bytes(path: Path, data: bytes) -> None:
    """Write through a temporary file in the same folder, on disk before it gets its name, and the name on disk too.
    Raises OSError that names ``path``."""
    temporary = path.with_name(f".{path.name}.{secrets.token_hex(4)}.tmp")
    try:
        with temporary.open("wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        temporary.replace(path)
        _sync_folder(path.parent)
    except OSError as cause:
        raise OSError(cause.errno, cause.strerror, str(path)) from None
    finally:
        with contextlib.suppress(OSError):
            temporary.unlink(missing_ok=True)


@contextlib.contextmanager
def whole(path: Path) -> Iterator[Path]:
    """Where somebody else's writer may put a file that is to be at ``path`` whole or not at all; the same ending."""
    temporary = path.with_name(f".{path.stem}.{os.getpid()}{path.suffix}")
    try:
        yield temporary
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


def _sync_folder(folder: Path) -> None:
    """The names in a folder, on disk; where a system cannot open folders, it sees to that itself."""
    with contextlib.suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def sweep_temporary(folder: Path) -> None:
    """Remove half-written files that a killed process left in a folder that is ours alone."""
    for path in folder.glob(".*.tmp"):
        with contextlib.suppress(OSError):
            path.unlink()


def mark_of(data: bytes) -> dict[str, Any]:
    """What tells whether a file is still as it was written: its length in bytes and its sha256."""
    return {"bytes": len(data), "sha256": hashlib.sha256(data).hexdigest()}


def write_json(path: Path, content: dict[str, Any]) -> None:
    write_bytes(path, (json.dumps(content, indent=2, default=str) + "\n").encode())


def read_json(path: Path) -> dict[str, Any] | None:
    """The content, or None if the file is missing or no JSON object."""
    try:
        content = json.loads(path.read_text())
    except (OSError, ValueError, RecursionError):
        return None
    return content if isinstance(content, dict) else None


def write_parquet(path: Path, columns: Mapping[str, Sequence[Any]], known: Mapping[str, Column]
                  ) -> dict[str, Any]:
    """One table; its :func:`mark_of`. The bytes depend on the values and the Arrow version alone. ``known``: type,
    unit and meaning of columns, which are kept with them; a column that is not known gets the type of its values."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    arrays, fields = [], []
    for name, values in columns.items():
        column = known.get(name)
        arrays.append(pa.array(values, type=pa.type_for_alias(column.type) if column else None))
        about = {"unit": column.unit, "meaning": column.meaning} if column else None
        fields.append(pa.field(name, arrays[-1].type, metadata=about))
    table = pa.Table.from_arrays(arrays, schema=pa.schema(fields))
    sink = pa.BufferOutputStream()
    pq.write_table(table, sink, compression="zstd", use_dictionary=True, write_statistics=True)
    data = sink.getvalue().to_pybytes()
    write_bytes(path, data)
    return mark_of(data)
