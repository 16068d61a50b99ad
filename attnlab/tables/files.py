"""Files that are whole or not there."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from attnlab.tables.schema import Column


def write_bytes(path: Path, data: bytes) -> None:
    """Write through a temporary file in the same folder, on disk before it gets its name."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}.tmp")
    try:
        with temporary.open("wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


def write_json(path: Path, content: dict[str, Any]) -> None:
    write_bytes(path, (json.dumps(content, indent=2, default=str) + "\n").encode())


def read_json(path: Path) -> dict[str, Any] | None:
    """The content, or None if the file is missing or no JSON object."""
    try:
        content = json.loads(path.read_text())
    except (OSError, ValueError):
        return None
    return content if isinstance(content, dict) else None


def write_parquet(path: Path, columns: Mapping[str, Sequence[Any]], known: Mapping[str, Column]) -> None:
    """One table; the bytes depend on the values and the Arrow version alone. ``known``: type, unit and meaning of
    columns, which are kept with them; a column that is not known gets the type of its values."""
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
    write_bytes(path, sink.getvalue().to_pybytes())
