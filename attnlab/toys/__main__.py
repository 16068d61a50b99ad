"""``python -m attnlab.toys``: every way on the toy of its paper, and the paper's claims judged.

    python -m attnlab.toys                       20 seeds, minutes; the page, the table and verdicts in outputs/toys
    python -m attnlab.toys --seeds 6 --short 20  does it work? Seconds, verdicts mean little
    python -m attnlab.toys --table toys.csv      plays nothing: verdicts of a table that is there

Writes ``README.md``, ``toys.csv`` (a row for every way, toy, seed and quantity), ``verdicts.csv`` and ``made.json``.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from attnlab.claims.judge import Verdict
from attnlab.console import guarded
from attnlab.errors import ConfigError
from attnlab.loading import load_all
from attnlab.report import verdicts as tables
from attnlab.tables.code import code
from attnlab.tables.files import write_bytes
from attnlab.toys.page import page, sentence
from attnlab.toys.table import Told, as_csv, claims, judged, play, read


def main(argv: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m attnlab.toys", description="The toys of the papers on when to "
                                     "look, played by the ways, and the papers' claims judged.")
    parser.add_argument("--seeds", type=int, default=20, help="of every way on every toy")
    parser.add_argument("--short", type=int, default=1, metavar="N", help="an Nth of all episodes: a trial")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="processes")
    parser.add_argument("--table", type=Path, help="a toys.csv that is there; nothing is played")
    parser.add_argument("--out", type=Path, default=Path("outputs/toys"), help="folder to write to")
    given = parser.parse_args(argv)
    for name in ("seeds", "short", "jobs"):
        if getattr(given, name) < 1:
            raise ConfigError(f"--{name}", f"must be at least 1, got {getattr(given, name)}")
    load_all()
    typed = f"python -m attnlab.toys --seeds {given.seeds}" + (f" --short {given.short}" if given.short > 1 else "")
    told = read(given.table) if given.table else {}
    ready(given.out)  # before minutes of playing
    if given.table:
        made = made_of(given.table)
    else:
        told, made = play(range(given.seeds), given.jobs, given.short), {"command": typed, "code": code()}
    write(told, given.out, made)
    return 0


def ready(out: Path) -> None:
    """Make the folder. Raises ConfigError if it cannot be written."""
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as cause:
        raise ConfigError("--out", f"{out} cannot be written ({cause.strerror or cause})") from None
    if not os.access(out, os.W_OK):
        raise ConfigError("--out", f"{out} cannot be written")


def made_of(table: Path) -> dict[str, Any]:
    """What is written beside a table of who played it."""
    beside = table.with_name("made.json")
    unknown = {"command": f"python -m attnlab.toys --table {table.name}", "code": None}
    try:
        return {**unknown, **json.loads(beside.read_text())}
    except (OSError, ValueError, TypeError):
        return unknown


def write(told: Told, out: Path, made: dict[str, Any]) -> dict[str, list[Verdict]]:
    """Judge, and write all there is to a folder that is there; prints what was found. ``made``: the command that
    played, and its code."""
    found, files = judged(told), claims()
    write_bytes(out / "toys.csv", as_csv(told))
    write_bytes(out / "verdicts.csv", tables.as_csv(found))
    write_bytes(out / "README.md", page(found, files, str(made["command"])).encode())
    made = {"claims_sha256": {name: of.sha256 for name, of in files.items()}, **made}  # those of the play, if known
    write_bytes(out / "made.json", (json.dumps(made, indent=1) + "\n").encode())
    for name, verdicts in found.items():
        tables.print_table(verdicts, files[name].title)
        print(sentence(verdicts))
    print(f"page     {out / 'README.md'}", file=sys.stderr)
    return found


if __name__ == "__main__":
    sys.exit(guarded(main))
