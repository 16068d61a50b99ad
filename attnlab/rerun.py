"""``python -m attnlab.rerun RUN``: make a run once more; the same bytes, or the first difference."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from attnlab.console import guarded
from attnlab.loading import load_all


def main(argv: Sequence[str]) -> int:
    """Entry point; 0 if the tables are the same bytes, 1 if not. What is stored is not touched."""
    parser = argparse.ArgumentParser(prog="python -m attnlab.rerun",
                                     description="Make a stored run once more and compare its tables byte by byte.")
    parser.add_argument("run", help="folder of a run: outputs/<study>/<run>")
    given = parser.parse_args(list(argv))
    from attnlab.launch.again import made_again
    load_all()
    found = made_again(Path(given.run))
    print("\n".join(found) if found else "the same bytes")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(guarded(main))
