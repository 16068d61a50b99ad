"""The answer in words, from finalists.csv alone: whoever has the table can say what it says."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence

from attnlab.claims.findings import Finding

BY_WORD = {str(finding): finding for finding in Finding}
AGAINST = ("inferred", "table4")
Row = Mapping[str, str]


def read(text: str) -> list[dict[str, str]]:
    """The rows of finalists.csv."""
    return list(csv.DictReader(io.StringIO(text)))


def listed(claims: Sequence[str], none: str = "none") -> str:
    """Claims by their ids."""
    return ", ".join(claims) or none


def ids(rows: Sequence[Row]) -> list[str]:
    """The claims of the table."""
    return [name for name in rows[0] if any(row[name] in BY_WORD for row in rows)]


def holds(row: Row, claims: Sequence[str]) -> list[str]:
    """Claims that hold together in a reading."""
    return [claim for claim in claims if BY_WORD[row[claim]].holds]


def best(rows: Sequence[Row]) -> Row | None:
    """The sound reading in which most claims hold; of equals the one with fewer contradicted, then the first."""
    claims = ids(rows)
    sound = [row for row in rows if not row["not_sound"]]
    return max(sound, key=lambda row: (len(holds(row, claims)), -int(row["contradicted"])), default=None)


def sentences(rows: Sequence[Row]) -> list[str]:
    """What the search found."""
    claims, top = ids(rows), best(rows)
    if top is None:
        return ["No reading that was judged is sound on the fresh seeds."]
    together = holds(top, claims)
    whole = "so there is a reading in which the paper is true" if len(together) == len(claims) else \
        "so the paper is not true in any reading that was found"
    said = [f"At most {len(together)} of {len(claims)} claims hold together ({listed(together)}), in reading "
            f"{top['reading']}, judged on {top['seeds']} seeds that took no part in the search; {whole}."]
    for name in AGAINST:
        row = next((row for row in rows if row["reading"] == name), None)
        if row is not None and row is not top:
            there = holds(row, claims)
            gained = [claim for claim in together if claim not in there]
            lost = [claim for claim in there if claim not in together]
            said.append(f"On the same seeds `{name}` has {len(there)} ({listed(there)}); the best reading gains "
                        f"{listed(gained, 'nothing')} and loses {listed(lost, 'nothing')}"
                        + (f"; `{name}` is not sound: {row['not_sound']}" if row["not_sound"] else "") + ".")
    sound = [row for row in rows if row["code"] and not row["not_sound"]]
    ever = {claim for row in sound for claim in holds(row, claims)}
    never = [claim for claim in claims if claim not in ever]
    always = [claim for claim in claims if all(claim in holds(row, claims) for row in sound)]
    untestable = [claim for claim in never if all(BY_WORD[row[claim]] is Finding.UNTESTABLE for row in sound)]
    said.append(f"Of the {len(sound)} sound finalists, none has {listed(never, 'a claim that the others lack')}"
                + (f" ({', '.join(untestable)} cannot be tested in any)" if untestable else "")
                + f"; {listed(always, 'no claim')} hold{'s' if len(always) < 2 else ''} in all of them.")
    return said
