"""Results: tidy Parquet tables, written whole or not at all, and read back as pandas frames."""

from attnlab.results.load import Study, load

__all__ = ["Study", "load"]
