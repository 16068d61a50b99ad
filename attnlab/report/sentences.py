"""What a multiverse says, in sentences made from its numbers; rules and thresholds are those of statements.py."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from attnlab.report.contrasts import Contrast
from attnlab.report.curve import p_text
from attnlab.report.multiverse import Curves
from attnlab.report.statements import CLEAR, NEARLY_ALL, AtLevel, Kind

MOST = 7  # sentences of a kind on the first screen
NAMED = 14  # measures that one sentence names
HEADS = {Kind.ROBUST: "Robust: on one side in nearly all readings, and told from chance",
         Kind.HANGS: "Hang on one factor: told in readings with one of its levels, not in those with another",
         Kind.MIXED: "Mixed: told from chance, but in too few readings, and no factor sorts them",
         Kind.NOISE: "Noise: not told from chance"}


def sentences(of: Curves) -> list[tuple[Kind, int, list[str]]]:
    """Of each kind that there is: how many comparisons, and sentences."""
    found = []
    for kind in Kind:
        mine = [m for m, said in enumerate(of.statements) if said.kind is kind]
        if not mine:
            continue
        texts = _robust(of, mine) if kind is Kind.ROBUST else _hanging(of, mine) if kind is Kind.HANGS else \
            [_list(of, mine)]
        if len(texts) > MOST:
            texts = [*texts[:MOST], f"{len(texts) - MOST} more are in the table below."]
        found.append((kind, len(mine), texts))
    return found


def how_many(names: int, of: Curves) -> str:
    """What was compared, in how many readings and seeds."""
    seeds, contrasts = of.differences.shape[-1], of.contrasts
    whom = list(dict.fromkeys(c.whom for c in contrasts))
    measures = len({(c.node, c.order) for c in contrasts})
    same = "the same in all" if of.shared == seeds else f"of which all readings have {of.shared}"
    text = (f"{names} readings of what the text leaves open, {seeds} seeds, {same}. {len(contrasts)} comparisons: "
            f"{measures} measures, {contrasts[0].who} against {' and '.join(whom)}.")
    least = 2 / of.joint.patterns if of.joint.exact else 1 / of.joint.patterns
    if least > CLEAR:
        text += f" With {seeds} seeds no p is below {least:.2g}, so nothing can be told from chance; 6 seeds can."
    return text


def apart(of: Curves) -> str:
    """A warning where no seed is in all readings, so that its labels cannot be exchanged in all of them; else empty."""
    return "" if of.shared else ("no seed is in all readings, so that the joint test cannot keep how they hang "
                                 "together: run the same seeds in all, seed=0-9")


def _by_size(of: Curves, mine: Sequence[int]) -> list[int]:
    return sorted(mine, key=lambda m: (-of.statements[m].on_side / max(1, of.statements[m].values),
                                       -abs(of.joint.median[m]), m))


def _robust(of: Curves, mine: Sequence[int]) -> list[str]:
    """A sentence a measure and side, with everybody it is compared with."""
    together: dict[tuple[str, bool, str, str], list[int]] = {}
    for m in _by_size(of, mine):
        c, said = of.contrasts[m], of.statements[m]
        together.setdefault((c.node, c.order, c.told(said.side), c.who), []).append(m)
    texts = []
    for (_, _, word, who), members in together.items():
        first, said = of.contrasts[members[0]], of.statements[members[0]]
        against = " and ".join(f"than in {of.contrasts[m].whom} in {of.statements[m].on_side} of "
                               f"{of.statements[m].values} readings" for m in members)
        texts.append(f"{_name(first)} is {word} in {who} {against}, {_claimed(said.side)}.")
    return texts


def _hanging(of: Curves, mine: Sequence[int]) -> list[str]:
    """Which factor, which levels, and in how many readings of each: the side is that of the level where most are on
    one."""
    texts = []
    for m in sorted(mine, key=lambda m: (-of.shares[m][of.statements[m].factors[0]], m)):
        c, said = of.contrasts[m], of.statements[m]
        side = 1.0 if any(at.holds(1.0) for at in said.levels) else -1.0
        told = [f"{at.level} {at.above if side > 0 else at.below} of {at.values}"
                for at in sorted(said.levels, key=lambda at: -_share(at, side))]
        more = f" (also on {', '.join(said.factors[1:3])})" if len(said.factors) > 1 else ""
        texts.append(f"{_name(c)}, {c.who} against {c.whom}, hangs on {said.factors[0]}{more}: {c.told(side)}, "
                     f"{_claimed(side)}, with {'; with '.join(told)}.")
    return texts


def _share(at: AtLevel, side: float) -> float:
    return (at.above if side > 0 else at.below) / max(1, at.values)


def _list(of: Curves, mine: Sequence[int]) -> str:
    """Measures by name, each once; against whom, where it is not the same for all."""
    together: dict[str, list[Contrast]] = {}
    for m in mine:
        together.setdefault(of.contrasts[m].measure, []).append(of.contrasts[m])
    every = {c.whom for c in of.contrasts}
    names = [_name(some[0]) if {c.whom for c in some} == every else
             f"{_name(some[0])} against {' and '.join(c.whom for c in some)}" for some in together.values()]
    more = f"; and {len(names) - NAMED} more" if len(names) > NAMED else ""
    return "; ".join(names[:NAMED]) + more + "."


def _name(of: Contrast) -> str:
    return f"{of.measure} [{of.claim}]"


def _claimed(side: float) -> str:
    return "as claimed" if side > 0 else "the opposite of what is claimed"


def in_short(of: Curves, m: int) -> str:
    """The statement of a contrast in a few words."""
    said = of.statements[m]
    if said.kind is Kind.HANGS:
        return f"hangs on {said.factors[0]}"
    if said.kind is Kind.ROBUST:
        return f"robust, {'as claimed' if said.side > 0 else 'the opposite'}"
    return str(said.kind)


def curve_said(of: Curves, m: int) -> str:
    """A contrast's curve in a sentence: what is above, what is told."""
    c, said, joint = of.contrasts[m], of.statements[m], of.joint
    effects = of.effects[:, m]
    return (f"{_name(c)}, {c.who} against {c.whom}: {in_short(of, m)}. Claimed: {c.told(1.0)} (above 0) in {c.who}; "
            f"so it is in {int((effects > 0).sum())} of {said.values} readings, clearly in {joint.clear[m]}, "
            f"{c.told(-1.0)} clearly in {joint.opposite[m]}. Median d {np.nan_to_num(joint.median[m]):+.2f}, "
            f"joint p {p_text(joint.p[m])}, of all comparisons {p_text(joint.p_family[m])}.")


def rules() -> str:
    """How the kinds are told apart, for the page."""
    return (f"Robust: the joint p of all comparisons is {CLEAR:g} or less and {NEARLY_ALL:.0%} of the readings or more "
            "are on one side. Hangs on a factor: readings with one of its levels differ from the others (p of the "
            f"largest contrast of all factors, levels and comparisons {CLEAR:g} or less), and at one level the "
            f"statement holds ({NEARLY_ALL:.0%} of its readings on one side, joint p of these {CLEAR:g} or less), at "
            "another it does not. Mixed: told from chance, and neither. Noise: the rest. The rules were fixed before "
            "the runs.")
