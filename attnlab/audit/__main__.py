"""``python -m attnlab.audit [FILE] [--all]``: which cells of a summary table cannot be true together; ``--claims``:
which claims cannot."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from attnlab.audit.certificate import certify
from attnlab.audit.checks import FITS, IMPOSSIBLE, STRAINED, Finding, audit
from attnlab.audit.table import Table, load_table
from attnlab.claims import DEFAULT as CLAIMS
from attnlab.console import guarded, table_width
from attnlab.errors import ConfigError


def main(argv: Sequence[str]) -> int:
    """Entry point; returns 0 whatever the table says, for an inconsistent table is a finding and no failure."""
    parser = argparse.ArgumentParser(prog="python -m attnlab.audit",
                                     description="Check a summary table by the model's own identities and bounds.")
    parser.add_argument("file", nargs="?", help="name or path of a table (default: Table 5 of the paper)")
    parser.add_argument("--all", action="store_true", help="show what fits too")
    parser.add_argument("--claims", nargs="?", const=CLAIMS, metavar="FILE", help="which pairs of claims exclude each "
                        f"other, instead of a table ({CLAIMS})")
    parser.add_argument("--seen", nargs="+", default=[], type=Path, metavar="VERDICTS", help="verdicts.csv of studies, "
                        "in which pairs of claims were seen to hold")
    parser.add_argument("--out", type=Path, metavar="CSV", help="write the pairs of claims, each with its reason")
    given = parser.parse_args(list(argv))
    for name in ("seen", "out"):
        if getattr(given, name) and given.claims is None:
            raise ConfigError(f"--{name}", "is for claims", "--claims")
    if given.claims is not None:
        return certify(given.claims, given.seen, given.out)
    table = load_table(given.file)
    findings = audit(table)
    _print(table, findings, given.all)
    return 0


def _print(table: Table, findings: list[Finding], everything: bool) -> None:
    from rich.console import Console
    from rich.table import Table as Shown
    from rich.text import Text
    console = Console(width=table_width(140))
    shown = Shown(title=Text(table.title), title_justify="left", show_lines=True)
    for head in ("check", "for", "N", "arithmetic", "outcome"):
        shown.add_column(head)
    styles = {IMPOSSIBLE: "bold red", STRAINED: "yellow", FITS: "green"}
    for f in findings:
        if everything or f.outcome != FITS:
            doubt = " †" if any(table.is_undecided(cell, f.condition) for cell in f.cells.split(", ")) else ""
            shown.add_row(f.check, Text(f.condition), str(f.cycles or ""), Text(f.arithmetic),
                          Text(f.outcome + doubt, style=styles[f.outcome]))
    console.print(shown)
    for n, where in table.cycles.items():
        bad = sum(f.outcome == IMPOSSIBLE for f in findings if f.cycles == n)
        console.print(Text(f"N = {n} ({where}): {bad} impossible, "
                           f"{sum(f.outcome == STRAINED for f in findings if f.cycles == n)} strained, "
                           f"{sum(f.outcome == FITS for f in findings if f.cycles == n)} fit"))
    loose = [f for f in findings if f.cycles is None]
    console.print(Text(f"whatever N: {sum(f.outcome == IMPOSSIBLE for f in loose)} impossible of {len(loose)}"))
    for note in (*table.notes, *(f"† for {c} the text does not tell {' from '.join(cells)}"
                                 for c, cells in table.undecided)):
        console.print(Text(f"note: {note}" if not note.startswith("†") else note))


if __name__ == "__main__":
    sys.exit(guarded(main))
