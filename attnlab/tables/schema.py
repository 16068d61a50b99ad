"""Columns of the five tables, the contract with every reader: type, unit and meaning of each stand here alone."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NamedTuple

SCHEMA_VERSION = 2  # 1: rewards with penalties, safety as held
OLDEST_SCHEMA = 1  # that can still be read
TABLES = ("episodes", "behaviours", "policy", "cycles", "coverage")
CELL_M = 0.1


class Column(NamedTuple):
    """A column: its Arrow type, its unit (1: a plain number; empty: no number), and what it means."""
    type: str
    unit: str
    meaning: str


RUN = {
    "run": Column("string", "", "name of the run's folder"),
    "seed": Column("int64", "", "of the run"),
    "curiosity": Column("string", "", "model of curiosity"),
}
EPISODE = {
    **RUN,
    "phase": Column("string", "", "train or validation"),
    "episode": Column("int32", "", "counted from 0 in each phase"),
}
SCHEMA: dict[str, dict[str, Column]] = {
    "episodes": {
        **EPISODE,
        "cycles": Column("int32", "mc", "machine cycles lived"),
        "survival": Column("float64", "1", "cycles lived of the most there can be"),
        "death": Column("string", "", "none, crash, energy, or the name of the need"),
        "active_cycles": Column("int32", "mc", "cycles with at least one activation"),
        "meals": Column("int32", "1", "times that hunger was satisfied"),
        "drinks": Column("int32", "1", "times that thirst was satisfied"),
        "safety_mean": Column("float64", "1", "eq 13 in every cycle from where the robot is: mean"),
        "safety_min": Column("float64", "1", "the same: smallest"),
        "safety_max": Column("float64", "1", "the same: largest"),
        "safety_held_mean": Column("float64", "1", "eq 13 in every cycle from what AVOID last perceived: mean"),
        "safety_held_min": Column("float64", "1", "the same: smallest"),
        "safety_held_max": Column("float64", "1", "the same: largest"),
        "energy_mean": Column("float64", "UoE", "eq 10 over the cycles: mean"),
        "energy_min": Column("float64", "UoE", "the same: smallest"),
        "energy_max": Column("float64", "UoE", "the same: largest"),
        "hunger_mean": Column("float64", "UoE", "eq 5 over the cycles: mean; empty without that need"),
        "hunger_max": Column("float64", "UoE", "the same: largest"),
        "thirst_mean": Column("float64", "UoE", "eq 6 over the cycles: mean; empty without that need"),
        "thirst_max": Column("float64", "UoE", "the same: largest"),
        "wanting_mean": Column("float64", "1", "wanting, as last computed by the first behaviour: mean"),
        "path_m": Column("float64", "m", "length of the path"),
        "turn_rad": Column("float64", "rad", "sum of the absolute turns"),
        "bouts": Column("int32", "1", "runs of meals or drinks of one kind less than 60 cycles apart"),
        "bout_switches": Column("int32", "1", "bouts that followed one of the other kind"),
        "bout_interval_mean": Column("float64", "mc", "from the start of a bout to that of the next: mean"),
        "bout_interval_sd": Column("float64", "mc", "the same: standard deviation; empty under 3 bouts"),
    },
    "behaviours": {
        **EPISODE,
        "behaviour": Column("string", "", "whose row this is"),
        "activations": Column("int32", "1", "looks"),
        "releases": Column("int32", "1", "looks at which its motor schema was on"),
        "reward": Column("float64", "UoR", "sum over the periods that ended, eq 4, without the penalty"),
        "reward_extrinsic": Column("float64", "UoR", "the same without the intrinsic part"),
        "penalty": Column("float64", "UoR", "for a death; in neither of both"),
        "liking_mean": Column("float64", "1", "mean over the looks"),
        "period_mean": Column("float64", "mc", "mean of the periods granted"),
    },
    "policy": {
        "run": RUN["run"],
        "behaviour": Column("string", "", "whose table"),
        "curiosity_level": Column("string", "", "of the state: none, low, LH or HH (the paper's)"),
        "period": Column("int32", "mc", "of the state: the period in force"),
        "percept": Column("int32", "", "of the state: from 1"),
        "action": Column("int32", "mc", "a period"),
        "q": Column("float64", "UoR", "value learned at the end of training"),
        "visits": Column("int64", "1", "updates of that value"),
    },
    "cycles": {
        "run": RUN["run"],
        "phase": EPISODE["phase"],
        "episode": EPISODE["episode"],
        "cycle": Column("int32", "mc", "counted from 0"),
        "x_m": Column("float64", "m", "centre, after the cycle"),
        "y_m": Column("float64", "m", "centre, after the cycle"),
        "heading_rad": Column("float64", "rad", "after the cycle"),
        "v_m_s": Column("float64", "m/s", "as moved"),
        "w_rad_s": Column("float64", "rad/s", "as turned, left positive"),
        "hunger": Column("float64", "UoE", "after the cycle; empty without that need"),
        "thirst": Column("float64", "UoE", "after the cycle; empty without that need"),
        "energy": Column("float64", "UoE", "after the cycle"),
        "wanting": Column("float64", "1", "as last computed by the first behaviour"),
        "safety": Column("float64", "1", "eq 13 from where the robot is"),
        "safety_held": Column("float64", "1", "eq 13 from what AVOID last perceived"),
    },
    "coverage": {
        "run": RUN["run"],
        "phase": EPISODE["phase"],
        "x_cell": Column("int32", "", f"cells of {CELL_M} m from the south-west corner"),
        "y_cell": Column("int32", "", f"cells of {CELL_M} m from the south-west corner"),
        "visits": Column("int64", "mc", "cycles that ended with the robot's centre in the cell"),
    },
}
OF_BEHAVIOUR = {  # of cycles, with the behaviour's name before it: avoid_active ...
    "active": Column("bool", "", "did its clock fire?"),
    "period": Column("int32", "mc", "in force"),
    "percept": Column("int32", "", "as last seen, from 1"),
    "level": Column("string", "", "of curiosity, as last computed"),
}


def columns_of(table: str, behaviours: Iterable[str], needs: Mapping[str, str],
               probes: Mapping[str, Column]) -> dict[str, Column]:
    """All columns of a run's table. ``needs``: unit by need; ``probes``: what they add to this table."""
    found = dict(SCHEMA[table])
    if table == "episodes":
        for need, unit in needs.items():
            found.setdefault(f"{need}_mean", Column("float64", unit, f"{need} over the cycles: mean"))
            found.setdefault(f"{need}_max", Column("float64", unit, "the same: largest"))
    if table == "cycles":
        for need, unit in needs.items():
            found.setdefault(need, Column("float64", unit, "after the cycle"))
        for behaviour in behaviours:
            found |= {f"{behaviour}_{name}": column for name, column in OF_BEHAVIOUR.items()}
    return {**found, **probes}


def row_bytes(table: str, behaviours: int) -> int:
    """A guess, on the high side, of what a row takes in memory and on disk together (bytes)."""
    columns = len(SCHEMA[table]) + (len(OF_BEHAVIOUR) * behaviours if table == "cycles" else 0)
    return 8 * columns * (behaviours if table == "behaviours" else 1)
