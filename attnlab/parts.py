"""``python -m attnlab.parts``: every part, where it comes from, and what failed to load; with a name, all about it.

    python -m attnlab.parts                 all parts by group
    python -m attnlab.parts surprise        its docs, parameters with defaults, units and ranges, its file
    python -m attnlab.parts learner/random  a name that several groups use
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from attnlab.cli.listing import find, table
from attnlab.console import guarded
from attnlab.loading import load_all


def main(argv: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m attnlab.parts", description="List all parts, or explain one.")
    parser.add_argument("name", nargs="*", help="a part, or group/part")
    names = parser.parse_args(argv).name
    load_all()
    print("\n\n".join(map(find, names)) if names else table())
    return 0


if __name__ == "__main__":
    sys.exit(guarded(main))
