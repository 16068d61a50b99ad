"""What the standings say, in words and in tables: every number is theirs."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from attnlab.arena.summary import PRICES, Ends, Standing, kept, leaders, order, ranks
from attnlab.tables.csvs import csv_bytes

Places = Mapping[str, Sequence[Standing]]
HEADS = ("place", "way", "between", "units", "looks", "looks_low", "looks_high", "harm", "harm_low", "harm_high",
         "saved", "saved_low", "saved_high", "p", "p_holm", "verdict", "front", "on_front")


def percent(x: float) -> str:
    """Of a share."""
    return f"{100 * x:.1f}"


def spread(ends: Ends, sign: str = "") -> str:
    """A mean with its interval, of shares, in hundredths."""
    return f"{100 * ends[0]:{sign}.1f} [{100 * ends[1]:{sign}.1f}, {100 * ends[2]:{sign}.1f}]"


def words(place: str, found: Sequence[Standing], price: float) -> str:
    """What is sure in one place, in plain words."""
    by_name = {s.way: s for s in found}
    first = order(found, price)
    if not first:
        return f"{place}: nobody competes."
    best = by_name[first[0]]
    text = (f"{place}: at a price of {price:g} a look the best score is {best.way}'s, with {100 * best.looks[0]:.0f} "
            f"looks in 100 cycles and a harm of {percent(best.harm[0])} %. ")
    compared = [s for s in found if s.verdict]
    if not compared:
        return text + "Too few seeds or blocks to say who beats a fixed clock."
    better, worse = ([s for s in compared if s.verdict == word] for word in ("better", "worse"))
    better.sort(key=lambda s: -s.saved[0] if s.saved else 0.0)
    names = "; ".join(f"{s.way} by {spread(s.saved)} points at {100 * s.looks[0]:.0f} looks" for s in better if s.saved)
    text += (f"Of {len(compared)} ways held against a fixed clock of equal looks, {len(better)} are clearly better"
             f"{f' ({names})' if names else ''} and {len(worse)} clearly worse{named(s.way for s in worse)} (Holm over "
             f"the {len(compared)}, 5 % together). ")
    return text + steady(found, price)


def steady(found: Sequence[Standing], price: float) -> str:
    """How much hangs on the price."""
    spans = [f"{way} {f'at {low:g}' if low == high else f'from {low:g} to {high:g}'}" for low, high, way in
             leaders(found)]
    return (f"First by the price of a look: {', '.join(spans)}. At half and at twice the price "
            f"{100 * kept(found, price, price / 2):.0f} % and {100 * kept(found, price, price * 2):.0f} % of the pairs "
            "of ways keep their order.")


def named(ways: Iterable[str]) -> str:
    """Their names in brackets; nothing for none."""
    listed = ", ".join(ways)
    return f" ({listed})" if listed else ""


def plain(places: Places, price: float) -> str:
    """In Markdown: one screen of words, then a table a place."""
    lines = ["# The arena of attention", "", *(f"- {words(name, found, price)}" for name, found in places.items())]
    for name, found in places.items():
        lines += ["", f"## {name}", "", *table(found)]
    return "\n".join(lines) + "\n"


def table(found: Sequence[Standing]) -> list[str]:
    """The lines of a Markdown table of one place."""
    lines = ["| way | looks in 100 cycles | harm, % | saved against a fixed clock of equal looks | p (Holm) | | on the "
             "front | of resamples |", "| --- | --- | --- | --- | --- | --- | --- | --- |"]
    for s in found:
        saved = spread(s.saved, "+") if s.saved else ""
        lines.append(f"| {s.way}{' *' if s.between else ''} | {spread(s.looks)} | {spread(s.harm)} | {saved} | "
                     f"{'' if s.holm is None else f'{s.holm:.3f}'} | {s.verdict} | {'yes' if s.front else ''} | "
                     f"{f'{100 * s.often:.0f} %' if s.competes else ''} |")
    return lines


def standings_csv(places: Places) -> bytes:
    """All standings, a row a place and way; shares, not hundredths."""
    rows = []
    for place, found in places.items():
        for s in found:
            ends = [*s.looks, *s.harm, *(s.saved or (None,) * 3), s.p, s.holm]
            rows.append([place, s.way, int(s.between), s.units, *("" if x is None else f"{x:.6g}" for x in ends),
                         s.verdict, int(s.front), f"{s.often:.3f}" if s.competes else ""])
    return csv_bytes(HEADS, rows)


def ranks_csv(places: Places) -> bytes:
    """Place of each way at each price."""
    rows = [[place, way, *of] for place, found in places.items() if order(found, 0.0)
            for way, of in ranks(found).items()]
    return csv_bytes(["place", "way", *(f"{price:g}" for price in PRICES)], rows)
