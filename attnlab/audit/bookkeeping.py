"""The model's bookkeeping as linear inequalities between means over seeds of what claims measure.

A quantity is a measure with its settings; a variable is a quantity of a role. ``NECESSARY`` hold in any reading;
``CONSTRUCTED`` are those of one reading, ``inferred`` with nobody dead in validation, in which witnesses are made:
numbers that keep to them keep to the bounds and identities of the equations (docs/claims.md).
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from attnlab.claims.parts import Part
from attnlab.measures.base import Measure
from attnlab.reading import Reading
from attnlab.stats.soundness import LEAST_EARLY

BEHAVIOURS = ("avoid", "eat", "drink")
SHORTEST, LONGEST = 1, 12  # periods of eq 1
CHORDS = (1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12)  # mean periods between which chords stay below a concave bound
BLOCK = 50  # episodes between two points of Fig 6
Terms = Mapping[str, float]  # variable -> factor


@dataclass(frozen=True)
class Row:
    """sum of factor x variable <= most. ``why``: what it comes from; ``claim``: whose it is, empty for bookkeeping."""
    terms: Terms
    most: float
    why: str
    claim: str = ""


def quantity(part: Part) -> str:
    """A measure with its settings, in words that are the same for the same thing."""
    node = dict(part.node)
    name = node.pop("name")
    if name == "episode":
        return f"{node['column']}" + (" train" if node.get("phase") == "train" else "")
    if name in ("activations", "reward") and not node.get("episodes"):
        extras = [k for k in ("extrinsic", "survived") if node.get(k)]
        extras += [f"minus {node['minus']}"] if node.get("minus") else []
        return " ".join([name, str(node.get("behaviour", "all")), *extras])
    return " ".join([name, *(f"{k}={v}" for k, v in sorted(node.items(), key=str))])


def bounds(measure: Measure) -> tuple[float, float]:
    """The least and the most of a measure; counts, energies and needs are not negative."""
    low, high = measure.bounds
    return (0.0, high) if measure.unit in ("activations", "mc", "bit", "rad/m") and low == -float("inf") and \
        not getattr(measure.params, "minus", None) else (low, high)


def necessary(role: str) -> Iterator[Row]:
    """Of any reading."""
    def v(name: str) -> str:
        return f"{name} of {role}"
    for first, then in (("energy_min", "energy_mean"), ("energy_mean", "energy_max"), ("safety_min", "safety_mean")):
        yield Row({v(first): 1, v(then): -1}, 0, f"{first} <= {then}")
    yield Row({v("safety_mean"): 1}, 1, "safety <= 1 (eq 13)")
    yield Row({v("safety_min"): -1}, 0, "safety >= 0 (eq 13)")
    parts = {v(f"activations {b}"): 1.0 for b in BEHAVIOURS}
    yield from _equal({**parts, v("activations all"): -1}, 0, "activations add up")
    for b in BEHAVIOURS:
        yield Row({v(f"activations {b}"): -1}, 0, "activations are counted")
        yield Row({v(f"activations {b}"): 1, v("active_cycles"): -1}, 0, f"{b} is active in active cycles alone")
    yield Row({v("active_cycles"): 1, v("activations all"): -1}, 0, "a cycle is active if somebody is")
    for b in ("eat", "drink"):
        yield from _equal({v("activations avoid"): 1, v(f"activations {b}"): -1, v(f"activations avoid minus {b}"): -1},
                          0, "a difference of activations")
    for kind in (" extrinsic", " survived"):
        each = {v(f"reward {b}{kind}"): 1.0 for b in BEHAVIOURS}
        yield from _equal({**each, v(f"reward all{kind}"): -1}, 0, "rewards add up")
        yield from _equal({v(f"reward eat{kind}"): 1, v(f"reward drink{kind}"): 1, v(f"reward eat+drink{kind}"): -1}, 0,
                          "rewards add up")


def constructed(role: str, activations: float) -> Iterator[Row]:
    """Of the reading in which witnesses are made, for a robot with so many ``activations`` an episode."""
    r = Reading()
    n, high = r.max_cycles, LONGEST - SHORTEST

    def v(name: str) -> str:
        return f"{name} of {role}"
    yield from _equal({v("activations all"): 1}, activations, "as many as are tried")
    yield from _equal({v("overlap"): activations, v("active_cycles"): 100}, 100 * activations, "by its formula")
    yield from _equal({v("activation_saving behaviour=avoid"): n, v("activations avoid"): 100}, 100 * n,
                      "by its formula")
    for b in BEHAVIOURS:
        acts = v(f"activations {b}")
        yield Row({acts: -1}, -n / LONGEST, f"granted periods sum to {n} cycles (eq 1)")
        yield Row({acts: 1}, n, "one look a cycle at most")
        pays, term = v(f"reward {b} extrinsic"), 1 / (2 * high)
        yield Row({pays: -1, acts: -SHORTEST * term}, -n * term, "the period term of eqs 7-9 is (N - A) / 22")
        yield Row({pays: 1, acts: SHORTEST * term - 0.5}, n * term, "and the second term A / 2 at most")
        paid = v(f"reward {b} survived")
        if role != "treatment":
            yield from _equal({paid: 1, pays: -1}, 0, "without curiosity the reward is extrinsic (eq 4)")
        yield Row({paid: -1}, 0, "rewards are positive but for the penalty")
        yield Row({paid: 1, acts: -1}, 0, "a look pays 1 at most (eq 4)")
    for one, other in itertools.pairwise(CHORDS):
        yield Row({v("safety_mean"): high, v("activations avoid"): -one * other / n}, LONGEST - one - other,
                  "mean safety <= (12 - N/A) / 11 (eq 13)")
    for need in ("hunger_mean", "thirst_mean"):
        yield Row({v(need): -1}, 0, "needs that are not overfed")
        yield Row({v(need): 1}, r.need_max, "needs below their death")
        yield Row({v(need.replace("mean", "max train")): 1}, r.need_max, "needs below their death")
        yield Row({v(need.replace("mean", "max train")): -1}, -r.need_start, "a need starts at need_start")
    start = r.energy_start + 2 * r.need_start - (n + 1) / 2
    together = {v(name): 1.0 for name in ("energy_mean", "hunger_mean", "thirst_mean")}
    grown = (2 * r.need_k - 1) * activations
    yield Row(together, start + grown, "E + hunger + thirst changes by -e_u + (2k - e_nb) nb_act a cycle")
    yield Row(dict.fromkeys(together, -1), -start, "E + hunger + thirst does not start lower")
    yield Row({v("energy_max"): -1}, -r.energy_start + r.energy_start * 0.1, "energy starts at energy_start")
    if role == "treatment":  # enough for an energy that is always above E_well
        yield Row({v("energy_min"): -1}, -r.energy_well, "energy above E_well")
    early, late = v("survival episodes=[0, 250] phase=train"), v("survival_convergence block=50 level=99.5")
    yield Row({early: -1}, -LEAST_EARLY, "a sound reading")
    yield Row({early: 1}, 99, "below 99.5 % before it converges")
    yield Row({late: -1}, -250, "it converges after the early episodes")
    yield Row({late: 1}, 450, "and is watched for 500")


def _equal(terms: Terms, value: float, why: str) -> Iterator[Row]:
    yield Row(terms, value, why)
    yield Row({name: -factor for name, factor in terms.items()}, -value, why)
