"""Columns of the five tables (the contract with every reader)."""

from __future__ import annotations

SCHEMA_VERSION = 1
TABLES = ("episodes", "behaviours", "policy", "cycles", "coverage")

RUN = {"run": "string", "seed": "int64", "curiosity": "string"}
EPISODE = {**RUN, "phase": "string", "episode": "int32"}
COLUMNS: dict[str, dict[str, str]] = {
    "episodes": {**EPISODE, "cycles": "int32", "survival": "float64", "death": "string", "active_cycles": "int32",
                 "meals": "int32", "drinks": "int32", "safety_mean": "float64", "safety_min": "float64",
                 "safety_max": "float64", "energy_mean": "float64", "energy_min": "float64", "energy_max": "float64",
                 "hunger_mean": "float64", "hunger_max": "float64", "thirst_mean": "float64", "thirst_max": "float64",
                 "wanting_mean": "float64", "path_m": "float64"},
    "behaviours": {**EPISODE, "behaviour": "string", "activations": "int32", "releases": "int32", "reward": "float64",
                   "reward_extrinsic": "float64", "penalty": "float64", "liking_mean": "float64",
                   "period_mean": "float64"},
    "policy": {"run": "string", "behaviour": "string", "curiosity_level": "string", "period": "int32",
               "percept": "int32", "action": "int32", "q": "float64", "visits": "int64"},
    "cycles": {"run": "string", "phase": "string", "episode": "int32", "cycle": "int32", "x_m": "float64",
               "y_m": "float64", "heading_rad": "float64", "v_m_s": "float64", "w_rad_s": "float64",
               "hunger": "float64", "thirst": "float64", "energy": "float64", "wanting": "float64",
               "safety": "float64"},
    "coverage": {"run": "string", "phase": "string", "x_cell": "int32", "y_cell": "int32", "visits": "int64"},
}
PER_BEHAVIOUR = {"active": "bool", "period": "int32", "percept": "int32", "level": "string"}  # of cycles: b_active...
CELL_M = 0.1


def row_bytes(table: str, behaviours: int) -> int:
    """A guess, on the high side, of what a row takes in memory and on disk together (bytes)."""
    columns = len(COLUMNS[table]) + (len(PER_BEHAVIOUR) * behaviours if table == "cycles" else 0)
    return 8 * columns * (behaviours if table == "behaviours" else 1)
