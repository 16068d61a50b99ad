"""The project's own studies on the page: a paragraph each, whose numbers and words come from the tables."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path

import found
from found import EARLY, LATE, LESS, MORE, VALID, Row, contrast, difference, number, side, table
from studies import BY_NAME, CAPS, CR, LEVELS, OWN_LEVEL, PLAIN, RANDOM_W, SAME, SHUFFLED

from attnlab.claims.files import load_claims
from attnlab.claims.findings import Finding
from attnlab.figures.phase_map import papers
from attnlab.reading import Reading

LADDER = {EARLY: "early survival", LATE: "late survival", VALID: "survival in validation", "safety": "safety"}
SHOWN = {"bigger_table": tuple(LADDER), "matched_budget": (VALID, "safety"),  # differences that the page has as a table
         "clamped_levels": (VALID, "safety", "hunger", "thirst")}
ALL = "all"


def text(name: str, folder: Path) -> str:
    """The paragraph of a study; that it is not known where its tables are not here."""
    if not found.made(folder, name):
        return found.MISSING.format(name)
    return {"bigger_table": bigger_table, "matched_budget": matched_budget, "clamped_levels": clamped_levels,
            "where_curiosity_pays": where_curiosity_pays}[name](folder)


def changes(rows: Mapping[str, Row | None]) -> str:
    """What is clearly other, with its number, then what is not: ``less early survival (-1.4 [-1.8, -0.9] points),
    not clear safety``. ``rows``: what it is called -> difference."""
    there = {name: row for name, row in rows.items() if row is not None}
    said = [f"{side(row)} {name} ({difference(row)})" for name, row in there.items() if side(row) in (MORE, LESS)]
    unclear = [name for name, row in there.items() if side(row) not in (MORE, LESS)]
    return ", ".join([*said, *([f"not clear {_and(unclear)}"] if unclear else [])])


def _and(words: Sequence[str]) -> str:
    return " and ".join(filter(None, [", ".join(words[:-1]), words[-1]]))


def bigger_table(folder: Path) -> str:
    """What each step of the ladder changes."""
    def step(one: str, other: str) -> str:
        return f"({one} less {other}): " + changes({name: contrast(folder, "bigger_table", quantity, one, other)
                                                   for quantity, name in LADDER.items()})
    seeds = found.made(folder, "bigger_table")["seeds"]
    older = contrast(folder, "controls", EARLY, CR, SAME)
    before = f" (the {older['seeds']} seeds of `controls` had {difference(older)} of early survival)" if older else ""
    return (f"{seeds} seeds that took no part in `controls`. The bigger table by itself {step(SAME, PLAIN)}. The "
            f"curious reward on that table {step(CR, SAME)}{before}. In between stands a curious reward whose liking "
            f"is drawn from the behaviour's own past and says nothing of the percept {step(SHUFFLED, SAME)}; from "
            f"there to a liking that says something {step(CR, SHUFFLED)}. A wanting drawn at random in place of "
            f"the residual energy {step(RANDOM_W, CR)}. All of it together {step(CR, PLAIN)}.")


def matched_budget(folder: Path) -> str:
    """Who is on the front, and how pairs fare under each cap."""
    rows = table(folder, "matched_budget", "front")
    fronts = []
    for which in dict.fromkeys(row["outcome"] for row in rows):
        unit, on = "%" if which.startswith("survival") else "1", [r for r in rows if r["outcome"] == which]
        at = sorted((r for r in on if r["on_front"] == "1"), key=lambda r: float(r["looks_mean"]))
        fronts.append(f"of looks and {which.partition(',')[0]}, from the fewest looks: " + ", ".join(
            f"{r['condition']} at {float(r['looks_mean']):.2f}/s ({number(r['mean'], unit)}{' %' * (unit == '%')})"
            for r in at))
    pairs = [f"{one} survives {_by_cap(folder, one, other)} than {other}"
             for one, other in ((CR, SAME), (CR, PLAIN), (PLAIN, "fixed at 4"), (PLAIN, "random"))]
    return (f"Caps of {', '.join(CAPS)} looks a second for all behaviours together. Who learns may take fewer, so that "
            f"what was taken is counted. On the Pareto front in validation {'; '.join(fronts)}. Under the same "
            f"cap, in validation, {'; '.join(pairs)}.")


def _by_cap(folder: Path, one: str, other: str) -> str:
    """``clearly more under 1 and clearly less under 2 of 4 caps (at most +1.2 [+0.3, +2.1] points, at 2.2/s)``."""
    rows = {cap: contrast(folder, "matched_budget", VALID, f"looks_per_s={cap} {one}", f"looks_per_s={cap} {other}")
            for cap in CAPS}
    there = {cap: row for cap, row in rows.items() if row is not None}
    sides = Counter(side(row) for row in there.values())
    cap = max(there, key=lambda cap: abs(float(there[cap]["difference"])), default="-")
    most = f" (most apart at {cap}/s: {difference(there[cap])})" if there else ""
    return f"clearly more under {sides[MORE]} and clearly less under {sides[LESS]} of {len(there)} caps{most}"


def steps(name: str, folder: Path) -> list[list[str]]:
    """A row a pair: (one less another, differences); the first row is the head. Of the map: a row a comparison."""
    if name == "where_curiosity_pays":
        rows = table(folder, name, "together")
        return [["survival of", "E_well/E_max", "difference", "clearly better in", "worse in", "sound worlds"],
                *([row["what"], ALL if row["energy_well"] == ALL else _ratio(row["energy_well"]), _points(row),
                   row["better"], row["worse"], row["worlds"]] for row in rows)]
    pairs = [pair for pair in BY_NAME[name].pairs if contrast(folder, name, SHOWN[name][0], *pair)]
    return [["difference", *SHOWN[name]],
            *([f"{one} less {other.rpartition('=')[2].partition(' ')[2] if '=' in other else other}",
               *(difference(row) if (row := contrast(folder, name, quantity, one, other)) else "-"
                 for quantity in SHOWN[name])] for one, other in pairs)]


def where_curiosity_pays(folder: Path) -> str:
    """How many worlds, on the whole, and the paper's."""
    worlds, together = (table(folder, "where_curiosity_pays", name) for name in ("map", "together"))
    titles = list(dict.fromkeys(row["what"] for row in worlds))
    first = [row for row in worlds if row["what"] == titles[0]]
    sound = sum(row["sound"] == "1" for row in first)
    parts = []
    for title in titles:
        of = {row["energy_well"]: row for row in together if row["what"] == title}
        whole = of[ALL]
        parts.append(f"{title}, {_points(whole)} over all of them, clearly better in {whole['better']} and clearly "
                     f"worse in {whole['worse']}")
    paper = [row for row in worlds
             if tuple(float(row[axis]) for axis in ("distance_m", "obstacles", "energy_well")) == papers()]
    here = "; ".join(f"{row['what']}, {_points(row)}" for row in paper)
    return (f"{len(first)} worlds, {first[0]['seeds']} seeds each. In {sound} of them the robot of 2012 is sound (it "
            f"survives at least 90 % in the first half of training), and only those count here. Survival of "
            f"{'; '.join(parts)}. Chance alone makes about {0.025 * sound:.0f} worlds clearly better and as many "
            f"clearly worse. In the paper's own world (ring): {here}.")


def _ratio(well: str) -> str:
    return f"{float(well) / Reading().energy_max:.2f}"


def _points(row: Row) -> str:
    """``+0.3 [-0.1, +0.7] points``."""
    value = row.get("mean") or row["difference"]
    return f"{float(value):+.1f} [{float(row['low']):+.1f}, {float(row['high']):+.1f}] points"


def clamped_levels(folder: Path) -> str:
    """What holding each level changes, and how well each was known."""
    rows = table(folder, "clamped_levels", "levels")

    def of(level: str, quantity: str, digits: int = 0) -> str:
        row = next((r for r in rows if (r["condition"], r["quantity"]) == (level, quantity)), None)
        return "-" if row is None else f"{float(row['mean']):.{digits}f} [{float(row['low']):.{digits}f}, " \
            f"{float(row['high']):.{digits}f}]"
    looked, visited = "looks in 100 cycles", "states visited in training, %"
    parts = [f"{level[0].upper()}{level[1:]} ({of(level, visited)} % of its states were ever visited in training) it "
             f"takes {of(level, looked)} looks in 100 cycles; beside its own level, "
             + changes({name: contrast(folder, "clamped_levels", quantity, level, OWN_LEVEL)
                        for quantity, name in ((VALID, "survival"), ("safety", "safety"), ("hunger", "hunger"),
                                               ("thirst", "thirst"))}) for level in LEVELS]
    return (f"CR learns as ever; in validation only the level in its state is held. With its own level it takes "
            f"{of(OWN_LEVEL, looked)} looks in 100 cycles. {'. '.join(parts)}. In a state that was never visited all "
            "values are 0, and the shortest period is taken: what is said of a level that was hardly visited is said "
            "of that.")


def verdicts(name: str, folder: Path) -> str:
    """How the study's own claims fare: by verdict, or, where many combinations are judged, a count for each claim."""
    titles = {claim: of.title for claim, of in load_claims(BY_NAME[name].claims).claims.items()}
    rows, combinations = table(folder, name, "verdicts"), table(folder, name, "combinations")
    if combinations:
        return "\n".join(f"- {claim} {title}: {_counted(combinations, claim)}." for claim, title in titles.items()
                         if claim in combinations[0])
    fared = {row["claim"]: Finding(row["verdict"]) for row in rows}
    return "\n".join(f"- {claim} {title}: {fared[claim]}." for claim, title in titles.items() if claim in fared)


def _counted(combinations: Sequence[Row], claim: str) -> str:
    of = Counter(Finding(row[claim]) for row in combinations)
    return ", ".join(f"{finding} in {of[finding]}" for finding in Finding if of[finding]) + f" of {len(combinations)}"
