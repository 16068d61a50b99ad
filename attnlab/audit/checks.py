"""The checks: identities and bounds that every episode obeys, so that averages over episodes must obey them too.

Each check returns findings with its arithmetic. N: cycles of an episode, A: activations of a behaviour, p: its periods.
A finding is ``impossible`` beyond the rounding of the printed numbers, ``strained`` if it needs something unlikely that
is named, else ``fits``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from attnlab.audit.table import Cell, Table

IMPOSSIBLE, STRAINED, FITS = "impossible", "strained", "fits"


class Finding(NamedTuple):
    """One comparison. ``cells``: what it is about; ``cycles``: the N assumed, or None if it does not matter."""
    check: str
    condition: str
    cells: str
    cycles: int | None
    arithmetic: str
    outcome: str


def audit(table: Table) -> list[Finding]:
    """All findings on a table, for each condition, and for each candidate of N where N matters."""
    found: list[Finding] = []
    for condition in table.conditions:
        for check in (_order, _range, _spread, _global_reward, _union, _well):
            found += check(table, condition)
        for n in table.cycles:
            for check_of_n in (_longest_period, _safety_bound, _period_term, _energy_fall, _active):
                found += check_of_n(table, condition, n)
    for n in table.cycles:
        found += _energy_balance(table, n)
    return found


def _judge(excess: float, rounding: float) -> str:
    """Impossible if a bound is passed by more than the printed numbers' rounding."""
    return IMPOSSIBLE if excess > rounding + 1e-9 else FITS


def _order(table: Table, condition: str) -> Iterator[Finding]:
    """min <= mean <= max of a quantity, on average as in every episode."""
    for what in ("energy", "safety", "hunger", "thirst"):
        low, middle, high = (table.get(f"{what}_{w}", condition) for w in ("min", "mean", "max"))
        for a, b, names in ((low, middle, "min <= mean"), (middle, high, "mean <= max")):
            if a and b:
                yield Finding("order", condition, f"{what}: {names}", None, f"{a.mean:g} <= {b.mean:g}",
                              _judge(a.mean - b.mean, a.rounding + b.rounding))


def _range(table: Table, condition: str) -> Iterator[Finding]:
    """Safety is within [0, 1], needs within [0, need_max]."""
    for quantity in ("safety_max", "safety_min", "safety_mean", "hunger_mean", "hunger_max", "thirst_mean",
                     "thirst_max"):
        cell = table.get(quantity, condition)
        if cell:
            top = 1.0 if quantity.startswith("safety") else table.settings.need_max
            yield Finding("range", condition, quantity, None, f"0 <= {cell.mean:g} <= {top:g}",
                          _judge(max(-cell.mean, cell.mean - top), cell.rounding))


def _spread(table: Table, condition: str) -> Iterator[Finding]:
    """Bhatia-Davis: values in [0, top] with mean m have a variance of at most m (top - m)."""
    for quantity in ("safety_max", "safety_min", "safety_mean", "hunger_mean", "thirst_mean"):
        cell = table.get(quantity, condition)
        if cell and cell.sd is not None:
            top = 1.0 if quantity.startswith("safety") else table.settings.need_max
            most = math.sqrt(max(0.0, (cell.mean + cell.rounding) * (top - cell.mean + cell.rounding)))
            yield Finding("deviation", condition, quantity, None,
                          f"{cell.sd:g} <= sqrt({cell.mean:g} x ({top:g} - {cell.mean:g})) = {most:.3g}",
                          _judge(cell.sd - most, cell.rounding))


def _global_reward(table: Table, condition: str) -> Iterator[Finding]:
    """The global reward is the sum of the behaviours' rewards."""
    parts, whole = table.group("reward", condition), table.get("reward.global", condition)
    if parts and whole:
        total = sum(cell.mean for cell in parts.values())
        yield Finding("sum of rewards", condition, "reward." + ", ".join(parts) + ", global", None,
                      f"{' + '.join(f'{c.mean:g}' for c in parts.values())} = {total:g}, printed {whole.mean:g}",
                      _judge(abs(total - whole.mean), whole.rounding + sum(c.rounding for c in parts.values())))


def _union(table: Table, condition: str) -> Iterator[Finding]:
    """Cycles with at least one active behaviour: at least the busiest behaviour's, at most the sum of all."""
    parts, union = table.group("activations", condition), table.get("active_cycles", condition)
    if parts and union:
        most, total = max(c.mean for c in parts.values()), sum(c.mean for c in parts.values())
        slack = union.rounding + sum(c.rounding for c in parts.values())
        share = (total - union.mean) / total
        yield Finding("union of activations", condition, "active_cycles", None,
                      f"{most:g} <= {union.mean:g} <= {total:g}; {share:.1%} of the activations fall together",
                      _judge(max(most - union.mean, union.mean - total), slack))


def _well(table: Table, condition: str) -> Iterator[Finding]:
    """'Always above E_well' needs the smallest energy above it, for the conditions it is said of."""
    cell = table.get("energy_min", condition) if condition in table.above_well else None
    if cell is None:
        return
    for well, where in table.settings.energy_well.items():
        yield Finding("always above E_well", condition, "energy_min", None,
                      f"{cell.mean:g} >= E_well = {well:g} ({where})", _judge(float(well) - cell.mean, cell.rounding))


def _longest_period(table: Table, condition: str, n: int) -> Iterator[Finding]:
    """Granted periods sum to the cycles, so A activations at the longest period span at most A p_max cycles."""
    longest = max(table.settings.periods)
    for name, cell in table.group("activations", condition).items():
        reach = (cell.mean + cell.rounding) * longest
        yield Finding("reach of the clocks", condition, f"activations.{name}", n,
                      f"{cell.mean:g} activations x {longest} = {cell.mean * longest:g} cycles at most, of {n}",
                      _judge(n - reach, 0.0))


def _safety_bound(table: Table, condition: str, n: int) -> Iterator[Finding]:
    """Mean safety over all cycles <= (p_max - N/A) / (p_max - p_min): cycles weigh periods, and sigma <= sigma_max."""
    safety, acts = table.get("safety_mean", condition), table.get("activations.avoid", condition)
    if safety and acts:
        shortest, longest = min(table.settings.periods), max(table.settings.periods)
        most = (longest - n / (acts.mean + acts.rounding)) / (longest - shortest)
        yield Finding("safety and activations", condition, "safety_mean, activations.avoid", n,
                      f"{safety.mean:g} <= ({longest} - {n}/{acts.mean:g}) / {longest - shortest} = {most:.3f}",
                      _judge(safety.mean - most, safety.rounding))


def _period_term(table: Table, condition: str, n: int) -> Iterator[Finding]:
    """A behaviour's extrinsic reward is the period term and a second term between 0 and A/2.

    The period term is sum (p - p_min) / 2 (p_max - p_min) = (N - p_min A) / 2 (p_max - p_min). Only where rewards hold
    no intrinsic part.
    """
    if condition not in table.extrinsic_only:
        return
    shortest, longest = min(table.settings.periods), max(table.settings.periods)
    for name, acts in table.group("activations", condition).items():
        reward = table.get(f"reward.{name}", condition)
        if reward:
            width = 2 * (longest - shortest)
            term, second = (n - shortest * acts.mean) / width, acts.mean / 2
            slack = reward.rounding + acts.rounding + longest / width  # the last period may be cut off
            yield Finding("reward and activations", condition, f"reward.{name}, activations.{name}", n,
                          f"({n} - {shortest} x {acts.mean:g}) / {width} = {term:.1f} <= {reward.mean:g} <= "
                          f"{term:.1f} + {acts.mean:g}/2 = {term + second:.1f}",
                          _judge(max(term - reward.mean, reward.mean - term - second), slack))
            yield from _need_reward(table, condition, name, n, term, reward, acts)


def _need_reward(table: Table, condition: str, name: str, n: int, term: float, reward: Cell,
                 acts: Cell) -> Iterator[Finding]:
    """With the mean need at the activations the second term is A (1 - need / need_max) / 2.

    Strained, not impossible, when two deviations away: the need may differ where the behaviour looks.
    """
    need = table.get({"eat": "hunger_mean", "drink": "thirst_mean"}.get(name, ""), condition)
    if need and reward.sd is not None:
        second = acts.mean * (1 - need.mean / table.settings.need_max) / 2
        apart = reward.mean - term - second
        yield Finding("reward and mean need", condition, f"reward.{name}, activations.{name}", n,
                      f"{term:.1f} + {acts.mean:g} x (1 - {need.mean:g}/{table.settings.need_max:g}) / 2 = "
                      f"{term + second:.1f}, printed {reward.mean:g} ± {reward.sd:g}",
                      STRAINED if abs(apart) > 2 * reward.sd + reward.rounding else FITS)


def _energy_fall(table: Table, condition: str, n: int) -> Iterator[Finding]:
    """Energy falls by at most e_u N + e_nb sum A; a larger range must come from rising, by meals."""
    high, low = table.get("energy_max", condition), table.get("energy_min", condition)
    parts = table.group("activations", condition)
    if high and low and parts:
        s, total = table.settings, sum(c.mean for c in parts.values())
        fall, span = s.e_u * n + s.e_nb * total, high.mean - low.mean
        slack = high.rounding + low.rounding + sum(c.rounding for c in parts.values())
        text = f"{high.mean:g} - {low.mean:g} = {span:g}, largest fall {s.e_u:g} x {n} + {s.e_nb:g} x {total:g} = " \
               f"{fall:g}"
        if span > fall + slack:
            text += f"; else the smallest comes first and {math.ceil(span / s.meal)} meals or more raise it"
        yield Finding("range of energy", condition, "energy_max, energy_min", n, text,
                      STRAINED if span > fall + slack else FITS)


def _active(table: Table, condition: str, n: int) -> Iterator[Finding]:
    """No more active cycles than cycles."""
    cell = table.get("active_cycles", condition)
    if cell:
        yield Finding("active cycles", condition, "active_cycles", n, f"{cell.mean:g} <= {n}",
                      _judge(cell.mean - n, cell.rounding))


def _energy_balance(table: Table, n: int) -> Iterator[Finding]:
    """E + H + T changes by -e_u + (2k - e_nb) nb_act a cycle, whatever is eaten; it starts the same in all conditions.

    So its mean is the start less e_u (N + 1)/2 plus (2k - e_nb) times the mean of the activations so far, which lies
    between 0 and their sum (half of it if they are spread evenly).
    """
    s, starts = table.settings, {}
    for condition in table.conditions:
        means = [table.get(name, condition) for name in ("energy_mean", "hunger_mean", "thirst_mean")]
        cells = [cell for cell in means if cell]
        parts = table.group("activations", condition)
        if len(cells) == len(means) and parts:
            total = sum(c.mean for c in parts.values())
            growth = (2 * s.k - s.e_nb) * total
            ends = sorted((0.0, growth))
            base = sum(c.mean for c in cells) + s.e_u * (n + 1) / 2
            slack = sum(c.rounding for c in cells) + abs(2 * s.k - s.e_nb) * sum(c.rounding for c in parts.values())
            starts[condition] = (base - ends[1] - slack, base - growth / 2, base - ends[0] + slack,
                                 math.sqrt(sum((c.sd or 0.0) ** 2 for c in cells)))
    known: list[str] = list(starts)
    for place, one in enumerate(known):
        for two in known[place + 1:]:
            a, b = starts[one], starts[two]
            apart = max(a[0], b[0]) - min(a[2], b[2])
            text = f"E + hunger + thirst at the start: {one} {a[1]:.0f} (between {a[0]:.0f} and {a[2]:.0f}), " \
                   f"{two} {b[1]:.0f} (between {b[0]:.0f} and {b[2]:.0f})"
            strained = abs(a[1] - b[1]) > 3 * math.hypot(a[3], b[3]) / math.sqrt(table.episodes)
            yield Finding("energy and needs", f"{one}, {two}", "energy_mean, hunger_mean, thirst_mean", n, text,
                          IMPOSSIBLE if apart > 0 else STRAINED if strained else FITS)
