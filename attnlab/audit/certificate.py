"""The certificate of pairs of claims: in the terminal, as CSV, and what it says in words."""

from __future__ import annotations

import csv
import io
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path

from attnlab.audit.pairs import ALL, IMPOSSIBLE, POSSIBLE, SEEN, UNDECIDED, Pair, pairs
from attnlab.claims.files import load_claims
from attnlab.claims.findings import Finding
from attnlab.errors import ConfigError
from attnlab.tables.csvs import csv_bytes
from attnlab.tables.files import write_bytes

MARKS = {IMPOSSIBLE: "x", POSSIBLE: "o", UNDECIDED: "?"}
MOST = 12  # reasons shown in the terminal


def certify(name: str, seen: Sequence[Path], out: Path | None) -> int:
    """Prove, show, and write if ``out`` is given; 0 whatever is found. Raises ConfigError."""
    claims = load_claims(name)
    found = pairs(claims, dict(item for file in seen for item in holding(file).items()))
    print(matrix(found, list(claims.claims)))
    told = [pair for pair in found if pair.outcome != POSSIBLE]
    for pair in told[:MOST]:
        print(f"{pair.one}, {pair.other}: {pair.outcome}: {pair.reason}")
    if len(told) > MOST:
        print(f"and {len(told) - MOST} more" + ("" if out else ": --out FILE.csv has all"))
    print(words(as_rows(found)))
    if out is not None:
        out.parent.mkdir(parents=True, exist_ok=True)
        write_bytes(out, as_csv(found).encode())
        print(out)
    return 0


def holding(file: Path) -> dict[str, list[str]]:
    """Study and combination -> claims that hold in it, from a verdicts.csv. Raises ConfigError."""
    try:
        rows = list(csv.DictReader(io.StringIO(file.read_text())))
    except (OSError, UnicodeDecodeError) as cause:
        raise ConfigError("--seen", f"{file} cannot be read: {cause}") from None
    words_of = {str(finding): finding for finding in Finding}
    found: dict[str, list[str]] = {}
    for row in rows:
        if not {"settings", "claim", "verdict"} <= set(row) or row["verdict"] not in words_of:
            raise ConfigError("--seen", f"{file} is no table of verdicts", "A report writes verdicts.csv")
        holds = found.setdefault(f"{file.resolve().parent.name} {row['settings']}".strip(), [])
        if words_of[row["verdict"]].holds and row["claim"] not in holds:
            holds.append(row["claim"])
    return found


def matrix(found: Sequence[Pair], ids: Sequence[str]) -> str:
    """A triangle of marks, a line a claim."""
    marks = {frozenset((pair.one, pair.other)): "s" if pair.reason.startswith(SEEN) else MARKS[pair.outcome]
             for pair in found}
    wide = max(map(len, ids))
    lines = [f"{one:<{wide}} " + " ".join(marks[frozenset((one, other))] for other in ids[:place])
             for place, one in enumerate(ids)]
    return "\n".join([*lines, f"columns: {ids[0]} to {ids[-1]}",
                      "x impossible; possible: s seen, o in numbers; ? not decidable"])


def as_rows(found: Sequence[Pair]) -> list[dict[str, str]]:
    """As rows of the CSV."""
    return [dict(pair._asdict()) for pair in found]


def as_csv(found: Sequence[Pair]) -> str:
    """A row a pair."""
    return csv_bytes(Pair._fields, found).decode()


def words(rows: Sequence[Mapping[str, str]]) -> str:
    """What a certificate says, from the rows of its CSV."""
    every = next(row["outcome"] for row in rows if row["one"] == ALL)
    rows = [row for row in rows if row["one"] != ALL]
    count = Counter(row["outcome"] for row in rows)
    seen = len([row for row in rows if row["outcome"] == POSSIBLE and row["reason"].startswith(SEEN)])
    listed = [f"{row['one']} and {row['other']}" for row in rows if row["outcome"] == IMPOSSIBLE]
    which = f" ({', '.join(listed)})" if listed else ""
    return (f"Of {len(rows)} pairs of claims, {count[IMPOSSIBLE]} cannot hold together{which}, {count[POSSIBLE]} can "
            f"({seen} do in a study, {count[POSSIBLE] - seen} in numbers that were constructed and that bounds and "
            f"identities allow), {count[UNDECIDED]} are not decidable; all claims at once are {every}. Whether a "
            "robot does what numbers allow is another question: python -m attnlab.search.")
