"""``python -m attnlab.search``: the largest set of the paper's claims that hold together in any reading."""

from __future__ import annotations

import argparse
import shlex
import sys
from collections.abc import Sequence
from pathlib import Path

from attnlab.claims import DEFAULT as CLAIMS
from attnlab.console import guarded
from attnlab.errors import ConfigError
from attnlab.launch.multiverse import DEFAULT as POINTS
from attnlab.loading import load_all
from attnlab.search.plan import SHAPE
from attnlab.search.rungs import parse
from attnlab.tables.ranges import seeds


def main(argv: Sequence[str]) -> int:
    """Entry point; 0 whatever is found. Stopped at any time, the same command goes on."""
    parser = argparse.ArgumentParser(
        prog="python -m attnlab.search",
        description="Search all combinations of the paper's open points for the largest set of claims that hold "
        "together; finalists are judged on fresh seeds.")
    parser.add_argument("--minutes", type=float, default=60.0, metavar="M",
                        help="of wall time, finalists included (60)")
    parser.add_argument("--rungs", metavar="N:S:K,...", help="readings, seeds and training episodes of each rung; "
                        "left out: what fits the minutes")
    parser.add_argument("--finalists", type=int, default=8, metavar="N", help="readings that are judged (8)")
    parser.add_argument("--fresh-seeds", default="500-519", metavar="SEEDS", help="they are judged on (500-519)")
    parser.add_argument("--first-seed", type=int, default=100, metavar="N", help="of the rungs (100); each has its own")
    parser.add_argument("--episodes", type=int, default=500, metavar="K", help="of training of the finalists (500, of "
                        "which the claims speak)")
    parser.add_argument("--seed", type=int, default=0, metavar="N", help="of what is drawn in the search (0)")
    parser.add_argument("--points", default=POINTS, metavar="FILE", help=f"the open points ({POINTS})")
    parser.add_argument("--claims", default=CLAIMS, metavar="FILE", help=f"what is to hold ({CLAIMS})")
    parser.add_argument("--out", type=Path, default=Path("outputs/search"), help="folder of its studies and tables")
    parser.add_argument("overrides", nargs="*", help="of all runs: cluster.jobs=1 ...")
    given = parser.parse_intermixed_args(argv)
    load_all()
    fresh = checked(given)
    from attnlab.search.run import Search
    search = Search(given, fresh, f"python -m attnlab.search {shlex.join(argv)}".strip())
    for line in search.run():
        print(line, flush=True)
    print(f"{given.out}: rungs.csv, claims.csv, finalists.csv, verdicts.csv")
    return 0


def checked(given: argparse.Namespace) -> list[int]:
    """The fresh seeds. Raises ConfigError for what cannot be, before anything runs."""
    for name, low, high in (("minutes", 0.1, 100_000), ("finalists", 1, 1000), ("episodes", 5, 100_000),
                            ("seed", 0, 2**31), ("first_seed", 0, 2**31)):
        value = getattr(given, name)
        if not low <= value <= high:
            raise ConfigError(f"--{name.replace('_', '-')}", f"is {value:g}, must be from {low} to {high}")
    fresh = seeds("--fresh-seeds", given.fresh_seeds)
    rungs = [rung.seeds for rung in parse(given.rungs)] if given.rungs else [of for of, _ in SHAPE]
    last = given.first_seed + sum(rungs) - 1
    taken = [seed for seed in fresh if given.first_seed <= seed <= last]
    if taken:
        raise ConfigError("--fresh-seeds", f"seed {taken[0]} takes part in the rungs ({given.first_seed} to {last})",
                          "Choose others, or --first-seed")
    return fresh


if __name__ == "__main__":
    sys.exit(guarded(main))
