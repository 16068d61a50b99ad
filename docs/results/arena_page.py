"""What came of the arena, in one screen of words whose numbers are from its tables, and then those tables."""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from arena_study import NAME, PRICE
from found import Row, table

BLIND = ("always_on", "fixed_4", "fixed_8", "fixed_12")
SURE = 0.95  # of resamples, from which a way is said to be on the front


def page(folder: Path) -> str:
    """README.md of the arena's results; empty if there are none."""
    rows, file = table(folder, NAME, "standings"), folder / NAME / "made.json"
    if not rows or not file.exists():
        return ""
    made = json.loads(file.read_text())
    worlds, logs = ([place for place in dict.fromkeys(row["place"] for row in rows) if place.startswith("world ") is of]
                    for of in (True, False))
    parts = ["# The arena of attention: what wins where, by how much, how sure",
             "Made by `python docs/results/make.py arena`: every number, and every word that hangs on one, is from the "
             "tables beside this page.", brief(rows, worlds, logs), what(rows, made, worlds, logs)]
    for title, places, unit in (("In worlds", worlds, "of survival"), ("On logs of real robots", logs, "of cycles")):
        if places:
            parts.append(f"**{title}.** {first(folder, rows, places)}\n\n" + "\n".join(f"- {said}" for said in (
                *clear(rows, places, unit), fronts(rows, places), blind(rows, places))))
    parts += [blindly(rows, worlds), curious(rows, worlds), between(rows, logs), unsure(rows, worlds, logs),
              papers(folder, worlds),
              "[The page](report.html) has the fronts, tables that any column sorts, the price of a look on a slider, "
              "and what each way looked at in the same cycles; [leaderboard.jsonl](leaderboard.jsonl) a row for each "
              "way, place, and seed or block. How it works, and how to join: [the arena](../../arena.md).",
              f"    {made['command']}"]
    parts += [f"## {place}\n\n{grid(rows, place)}" for place in (*worlds, *logs)]
    return "\n\n".join(part for part in parts if part) + "\n"


def competing(rows: Sequence[Row], place: str) -> list[Row]:
    """The rows of a place that are no clocks to hold against."""
    return [row for row in rows if row["place"] == place and not row["way"].startswith("(")]


def hundred(value: str, sign: str = "") -> str:
    """A share in hundredths."""
    return f"{100 * float(value):{sign}.1f}"


def spread(row: Row, name: str, sign: str = "") -> str:
    """A mean with its interval."""
    return f"{hundred(row[name], sign)} [{hundred(row[f'{name}_low'], sign)}, {hundred(row[f'{name}_high'], sign)}]"


def span(values: Iterable[str]) -> str:
    """``1.2 to 3.4``, in hundredths."""
    texts = [f"{100 * value:.1f}" for value in sorted(float(value) for value in values)]
    return texts[0] if texts[0] == texts[-1] else f"{texts[0]} to {texts[-1]}"


def listed(items: Sequence[str]) -> str:
    """``a, b and c``."""
    return items[0] if len(items) == 1 else f"{', '.join(items[:-1])} and {items[-1]}" if items else "none"


def what(rows: Sequence[Row], made: dict[str, Any], worlds: Sequence[str], logs: Sequence[str]) -> str:
    """What was compared, and what it took."""
    ways = len({row["way"] for place in worlds for row in competing(rows, place)})
    on_logs = len({row["way"] for place in logs for row in competing(rows, place)})
    seeds = max(int(row["units"]) for row in rows if row["place"] in worlds)
    train, validate = made["episodes"]
    engine = "all compiled" if made["engines"] == ["compiled"] else f"engines: {', '.join(made['engines'])}"
    took = f" On two cores it took {made['wall_s'] / 60:.1f} minutes, compiling included." if "wall_s" in made else ""
    return (f"{ways} ways to decide when to look in {len(worlds)} worlds ({seeds} seeds, {train} training and "
            f"{validate} validation episodes, planar, {made['runs']} of {made['asked_for']} runs, {engine}), {on_logs} "
            f"on {len(logs)} logs of real robots (8 blocks, learned on one half and judged on the other). Every way "
            f"has its default settings; nothing was tuned here.{took} Each is held against clocks of fixed period that "
            "look as often. \"Clearly\" means p < 0.05 by the paired t test after Holm's correction for all ways of a "
            "place; in brackets 95 % intervals, each on its own.")


def first(folder: Path, rows: Sequence[Row], places: Sequence[str]) -> str:
    """Who is first at the page's price."""
    ranks = {(row["place"], row["way"]): row[PRICE] for row in table(folder, NAME, "ranks")}
    said = []
    for place in places:
        row = next(row for row in competing(rows, place) if ranks[place, row["way"]] == "1")
        said.append(f"{row['way']} in {short(place)} ({hundred(row['looks'])} looks in 100 cycles, harm "
                    f"{spread(row, 'harm')} %)")
    return f"At a price of {PRICE} a look the best score is that of {listed(said)}."


def short(place: str) -> str:
    """A place's name in a sentence."""
    return place.removeprefix("world ")


def brief(rows: Sequence[Row], worlds: Sequence[str], logs: Sequence[str]) -> str:
    """The answer in three sentences."""
    verdicts = {(row["place"], row["way"]): row["verdict"] for row in rows}
    ways = sorted({row["way"] for row in rows})

    def everywhere(places: Sequence[str], word: str) -> list[str]:
        return [way for way in ways if places and all(verdicts.get((place, way)) == word for place in places)]
    better, worse = (everywhere(worlds, word) for word in ("better", "worse"))
    sightless = [way for way in better if way.startswith("fixed")]
    more = f" ({listed(sightless)} sees nothing: it only looks more often for AVOID than for the rest)" \
        if sightless else ""
    return (f"**In short.** Clearly better than a clock of fixed period that looks as often, in all {len(worlds)} "
            f"worlds: {listed(better)}{more}. Clearly worse in all of them: {listed(worse)}. On each of {len(logs)} "
            f"logs of real robots, clearly better: {listed(everywhere(logs, 'better'))}.")


def clear(rows: Sequence[Row], places: Sequence[str], unit: str) -> list[str]:
    """Who is clearly better and worse than fixed clocks of equal looks, in how many places, by how much."""
    said = []
    for word, gains in (("better", "saves"), ("worse", "loses")):
        found: dict[str, list[Row]] = {}
        for place in places:
            for row in competing(rows, place):
                if row["verdict"] == word:
                    found.setdefault(row["way"], []).append(row)
        order = sorted(found, key=lambda way: (-len(found[way]), way))
        each = [f"{way} in {len(found[way])} of {len(places)} ({gains} "
                f"{span(str(abs(float(row['saved']))) for row in found[way])} points {unit})" for way in order]
        said.append(f"Clearly {word} than a fixed clock of equal looks: {listed(each)}.")
    held = {row["way"] for place in places for row in competing(rows, place) if row["verdict"]}
    never = sorted(way for way in held if not any(
        row["verdict"] in ("better", "worse") for place in places for row in competing(rows, place)
        if row["way"] == way))
    return [*said, f"Nowhere clear: {listed(never)}."]


def fronts(rows: Sequence[Row], places: Sequence[str]) -> str:
    """Who is on the front of looks and harm, for sure."""
    sure = Counter(row["way"] for place in places for row in competing(rows, place) if float(row["on_front"]) >= SURE)
    each = [f"{way} in {n} of {len(places)}" for way, n in sorted(sure.items(), key=lambda item: (-item[1], item[0]))]
    return f"On the front of looks and harm in at least {100 * SURE:.0f} % of resamples: {listed(each)}."


def blind(rows: Sequence[Row], places: Sequence[str]) -> str:
    """What clocks of fixed period come to."""
    said = [f"{way} {span(of)} %" for way in BLIND if (of := [row["harm"] for place in places
                                                              for row in competing(rows, place) if row["way"] == way])]
    future = [row for row in rows if row["place"] in places and row["way"] == "(knows the future)"]
    more = (f" Who knows the future would need {span(row['looks'] for row in future)} looks in 100 cycles for a harm "
            f"of {span(row['harm'] for row in future)} %.") if future else ""
    return f"Harm of fixed clocks: {listed(said)}.{more}"


def pair(rows: Sequence[Row], places: Sequence[str], one: str, other: str) -> list[str]:
    """Two ways side by side, a text a place."""
    said = []
    for place in places:
        by_way = {row["way"]: row for row in competing(rows, place)}
        if {one, other} <= set(by_way):
            a, b = by_way[one], by_way[other]
            said.append(f"in {short(place)} {hundred(a['looks'])} looks and {spread(a, 'harm')} % harm beside "
                        f"{hundred(b['looks'])} and {spread(b, 'harm')} %")
    return said


def blindly(rows: Sequence[Row], places: Sequence[str]) -> str:
    """Clocks that see nothing and only give AVOID more looks than the others."""
    said = []
    for way in dict.fromkeys(row["way"] for row in rows if row["way"].startswith("fixed_12 ")):
        of = [row for place in places for row in competing(rows, place) if row["way"] == way]
        words = {word: sum(row["verdict"] == word for row in of) for word in ("better", "worse")}
        said.append(f"{way}, {span(row['looks'] for row in of)} looks in 100 cycles, harm "
                    f"{span(row['harm'] for row in of)} %, clearly better in {words['better']} and clearly worse in "
                    f"{words['worse']} of {len(of)}")
    return ("**How much of it is seeing?** The fixed clocks that ways are held against have one period for all "
            f"behaviours. Those that are as blind but give AVOID more looks than all else: {'; '.join(said)}. Only "
            "what a way saves beyond that can be owed to what it sees.") if said else ""


def curious(rows: Sequence[Row], places: Sequence[str]) -> str:
    """The robot of 2014 beside that of 2012."""
    said = pair(rows, places, "q_learning+litman", "q_learning")
    return ("**Curiosity** (q_learning+litman, the robot of 2014, beside q_learning, that of 2012): "
            f"{'; '.join(said)}.") if said else ""


def between(rows: Sequence[Row], places: Sequence[str]) -> str:
    """The way that needs the percepts between looks, beside itself without them."""
    said = pair(rows, places, "tempo_rl(all)", "tempo_rl")
    return f"**The percepts between looks**, which only a log can give (tempo_rl(all) beside tempo_rl): " \
           f"{'; '.join(said)}." if said else ""


def unsure(rows: Sequence[Row], worlds: Sequence[str], logs: Sequence[str]) -> str:
    """What is not sure."""
    held = sum(bool(row["verdict"]) for row in rows)
    clearly = sum(row["verdict"] in ("better", "worse") for row in rows)
    return (f"**How sure.** Of {held} comparisons {clearly} are clear; in each of the {len(worlds) + len(logs)} places "
            "the chance of calling any clear that is not is at most 5 %, over all places together it is more. Blocks "
            "of a log are not independent, so that their intervals are too narrow rather than too wide. One simulator, "
            "default settings, one body; training is shorter than the usual 500 episodes, set from what runs cost "
            "before any result of this study was seen.")


def papers(folder: Path, worlds: Sequence[str]) -> str:
    """What the papers say of their ways, asked of this robot."""
    rows = table(folder, NAME, "claims")
    if not rows:
        return ""
    names = [short(world) for world in worlds]
    by_claim: dict[tuple[str, str, str], dict[str, str]] = {}
    for row in rows:
        by_claim.setdefault((row["claims"], row["claim"], row["title"]), {})[row["world"]] = row["verdict"]
    lines = [["claim", *names], ["---"] * (1 + len(names))]
    lines += [[f"{claims} {claim}: {title}", *(of.get(name, "") for name in names)]
              for (claims, claim, title), of in by_claim.items()]
    grid = "\n".join(f"| {' | '.join(line)} |" for line in lines)
    return (f"## What their papers say, asked of this robot\n\n{grid}\n\nClaims files in `conf/claims/`. \"Direction "
            "only\": the direction is clear, and these claims name no number. What came of the ways on the toys of "
            "their papers: [toys](../toys/README.md).")


def grid(rows: Sequence[Row], place: str) -> str:
    """The table of a place, by harm."""
    lines = ["| way | looks in 100 cycles | harm, % | saved against a fixed clock of equal looks | p (Holm) | | on the "
             "front, of resamples |", "| --- | --- | --- | --- | --- | --- | --- |"]
    for row in rows:
        if row["place"] == place:
            saved = spread(row, "saved", "+") if row["saved"] else ""
            often = f"{100 * float(row['on_front']):.0f} %" if row["on_front"] else ""
            p = f"{float(row['p_holm']):.3f}" if row["p_holm"] else ""
            lines.append(f"| {row['way']}{' *' if row['between'] == '1' else ''} | {spread(row, 'looks')} | "
                         f"{spread(row, 'harm')} | {saved} | {p} | {row['verdict']} | {often} |")
    return "\n".join(lines)


def numbers(text: str) -> list[str]:
    """Decimal numbers of a text, for who checks them."""
    return re.findall(r"(?<![\w.])[-+]?\d+\.\d+(?![\w.])", text)
