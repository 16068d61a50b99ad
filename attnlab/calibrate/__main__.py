"""``python -m attnlab.calibrate STUDY``: how far can verdicts be believed? Thousands of planted studies, each judged.

    python -m attnlab.calibrate outputs/cr_vs_ncr                noise as in the report of this study
    python -m attnlab.calibrate seeds.csv --claims mine          of a report's table of seeds, by your rules
    python -m attnlab.calibrate STUDY --docs docs/claims.md      and put the table there

Prints for every rule how often it says "reproduced" or "contradicted" where nothing is, how often it holds where the
paper's effect is, and how many seeds it needs for that; stores calibration.csv in --out.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from attnlab.calibrate.table import Row, as_csv, as_markdown, calibrate, read_seeds
from attnlab.claims import DEFAULT
from attnlab.claims.files import load_claims
from attnlab.console import guarded, table_width
from attnlab.errors import ConfigError
from attnlab.tables.files import write_bytes

MARKS = ("<!-- calibration:begin -->", "<!-- calibration:end -->")


def main(argv: Sequence[str] | None = None) -> int:
    """Entry point; returns the exit code: 0 if every rule is wrong in 5 % of studies or fewer, as far as can be told
    (upper bound 6.5 %), else 1."""
    return guarded(_main, argv)


def _main(argv: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m attnlab.calibrate", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", type=Path, help="a study with a report, or its seeds.csv")
    parser.add_argument("--claims", default=DEFAULT, help=f"claims file, name or path ({DEFAULT})")
    parser.add_argument("--planted", type=int, default=2000, help="planted studies a rule (2000)")
    parser.add_argument("--seeds", type=int, default=20, help="seeds of each (20)")
    parser.add_argument("--seed", type=int, default=0, help="of the planting (0)")
    parser.add_argument("--out", type=Path, default=Path("outputs/calibration"), help="folder (outputs/calibration)")
    parser.add_argument("--docs", type=Path, help="a page to put the table into, between its marks")
    given = parser.parse_args(argv)
    if given.planted < 100:
        raise ConfigError("--planted", f"is {given.planted}, must be at least 100", "A rate needs studies")
    rows = calibrate(load_claims(given.claims), read_seeds(given.study), given.planted, given.seeds, given.seed)
    page = _page(given.docs, rows) if given.docs else None
    try:
        given.out.mkdir(parents=True, exist_ok=True)
    except OSError as cause:
        raise ConfigError("--out", f"{given.out} cannot be written ({cause.strerror or cause})") from None
    write_bytes(given.out / "calibration.csv", as_csv(rows))
    if given.docs and page:
        write_bytes(given.docs, page.encode())
    _show(rows, given.out)
    return 0 if sound(rows) else 1


def sound(rows: Sequence[Row]) -> bool:
    """Is every rule wrong in 5 % of studies or fewer, its upper bound under 6.5 %?"""
    return all(value <= 0.05 and high < 0.065 for row in rows for value, high in (row.false_reproduced,
                                                                                 row.false_contradicted))


def _page(file: Path, rows: Sequence[Row]) -> str:
    try:
        text = file.read_text()
        before, after = text.index(MARKS[0]) + len(MARKS[0]), text.index(MARKS[1])
    except (OSError, ValueError):
        raise ConfigError("--docs", f"{file} has no place for the table", f"Write {' '.join(MARKS)} there") from None
    return f"{text[:before]}\n\n{as_markdown(rows)}\n\n{text[after:]}"


def _show(rows: Sequence[Row], out: Path) -> None:
    from rich.console import Console
    from rich.table import Table
    shown = Table(title=f"{rows[0].planted} planted studies a rule, {rows[0].seeds} seeds each", title_justify="left")
    for head in ("claim", "false reproduced", "false contradicted", "holds if so", "seeds to hold", "to reproduce"):
        shown.add_column(head, justify="left" if head == "claim" else "right")
    for line in as_markdown(rows).splitlines()[2:]:
        cells = [cell.strip() for cell in line.strip("| ").split(" | ")]
        shown.add_row(cells[0].partition(" ")[0], *cells[1:])
    Console(width=table_width()).print(shown)
    print(f"{'every rule is' if sound(rows) else 'NOT every rule is'} wrong in 5 % of the studies or fewer")
    print(f"table    {out / 'calibration.csv'}")


if __name__ == "__main__":
    sys.exit(main())
