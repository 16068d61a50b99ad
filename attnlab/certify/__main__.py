"""``python -m attnlab.certify``: do planar and pybullet agree? Exit 0 if within every tolerance, 1 if not.

    python -m attnlab.certify                                     every shipped world, some minutes
    python -m attnlab.certify --worlds paper --episodes 0         sensors and motion only
    python -m attnlab.certify reading.v_max_m_s=0.3               any setting of a run

Prints a table and stores certificate.json and certificate.md in --out.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager
from functools import partial
from pathlib import Path
from typing import Any

from attnlab.certify.certificate import WORLDS, certify, compose
from attnlab.console import guarded
from attnlab.errors import ConfigError
from attnlab.loading import load_all


def main(argv: Sequence[str] | None = None) -> int:
    """Entry point; returns the exit code."""
    return guarded(_main, argv)


def _main(argv: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m attnlab.certify", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--poses", type=_count, default=5000, help="random poses a world (5000)")
    parser.add_argument("--episodes", type=_count, default=60,
                        help="training episodes of a closed-loop run, with half as many to validate; 0: none (60)")
    parser.add_argument("--seeds", type=_count, default=3, help="closed-loop runs a world (3)")
    parser.add_argument("--first-seed", type=_count, default=0, help="the first of them (0)")
    parser.add_argument("--worlds", default=",".join(WORLDS), help=f"names with commas ({','.join(WORLDS)})")
    parser.add_argument("--no-wheels", action="store_true", help="leave the unjudged row of drive=wheels out (slow)")
    parser.add_argument("--out", type=Path, default=Path("outputs/certificate"), help="folder (outputs/certificate)")
    parser.add_argument("overrides", nargs="*", help="settings of a run, name=value")
    arguments = parser.parse_args(argv)
    if not arguments.poses:
        raise ConfigError("--poses", "is 0, must be at least 1")
    load_all()
    worlds = [world for world in arguments.worlds.split(",") if world]
    compose(worlds[0] if worlds else "", 0, "planar", 1, arguments.overrides)  # complain before anything runs
    found = certify(worlds, arguments.poses, arguments.episodes, arguments.seeds, arguments.overrides,
                    not arguments.no_wheels, arguments.first_seed, _progress)
    found["command"] = " ".join(["python -m attnlab.certify", *argv])
    _store(found, arguments.out)
    _show(found, arguments.out)
    return 0 if found["passes"] else 1


def _count(text: str) -> int:
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number of 0 or more")
    return int(text)


def _progress(poses: int, episodes: int) -> AbstractContextManager[list[Callable[[], None]]]:
    """A context manager with a bar for poses and one for episodes: the two functions that advance them."""
    from contextlib import contextmanager

    from rich.console import Console
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    @contextmanager
    def bars() -> Iterator[list[Callable[[], None]]]:
        with Progress(TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn(),
                      TextColumn("left"), TimeRemainingColumn(), console=Console(stderr=True)) as progress:
            tasks = [progress.add_task(name, total=total) for name, total in (("poses", poses), ("episodes", episodes))]
            yield [partial(progress.advance, task) for task in tasks]
    return bars()


def _store(found: dict[str, Any], folder: Path) -> None:
    from attnlab.certify.page import page
    from attnlab.tables.files import write_bytes, write_json
    folder.mkdir(parents=True, exist_ok=True)
    write_json(folder / "certificate.json", found)
    write_bytes(folder / "certificate.md", page(found).encode())


def _show(found: dict[str, Any], folder: Path) -> None:
    from rich.console import Console
    from rich.table import Table

    from attnlab.certify.page import number
    table = Table("measure", "tolerance", "worst", "in world", "", title="planar against pybullet")
    for row in found["verdict"]:
        table.add_row(row["meaning"], f"{number(row['limit'])} {row['unit']}", number(row["worst"]), row["world"],
                      "passes" if row["passes"] else "FAILS")
    Console().print(table)
    print(f"{'Certified' if found['passes'] else 'Not certified'}; all numbers in {folder / 'certificate.md'}")


if __name__ == "__main__":
    sys.exit(main())
