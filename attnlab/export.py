"""``python -m attnlab.export STUDY --csv [--out DIR]``: a study's tables as CSV."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from attnlab.console import guarded
from attnlab.errors import ConfigError


def main(argv: Sequence[str]) -> int:
    """Entry point; returns 0."""
    parser = argparse.ArgumentParser(prog="python -m attnlab.export",
                                     description="A study's tables and its list of runs in another format.")
    parser.add_argument("study", help="folder of a study, or its name in outputs/")
    parser.add_argument("--csv", action="store_true", help="comma-separated values, a file a table")
    parser.add_argument("--out", help="folder of the files (default: csv/ in the study)")
    given = parser.parse_args(list(argv))
    if not given.csv:
        raise ConfigError("export", "names no format", "--csv")
    from attnlab.results.export import export_csv
    from attnlab.results.load import Study, folder_of
    folder = folder_of(given.study)
    for file in export_csv(Study(folder), Path(given.out) if given.out else folder / "csv"):
        print(file)
    return 0


if __name__ == "__main__":
    sys.exit(guarded(main))
