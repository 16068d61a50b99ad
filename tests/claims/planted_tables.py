"""Whole studies with a known truth: what the paper says, the reverse, nothing at all, a clock that never changes."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "report"))
from small_study import BEHAVIOURS, write_run

from attnlab.tables.files import write_parquet
from attnlab.tables.schema import SCHEMA, columns_of

TRAIN, VALIDATION, CYCLES = 500, 10, 1150
BLOCK = np.arange(TRAIN) // 50
LEVELS = ("low", "LH", "HH")
CURVES = {  # by block of 50 episodes
    "survival": {"CR": np.where(BLOCK < 6, 0.85, 1.0), "NCR": np.where(BLOCK < 8, 0.96, 1.0)},
    "avoid": {"CR": np.select([BLOCK < 4, BLOCK < 6], [20.0, 60.0], 100.0), "NCR": np.full(TRAIN, 66.0)},
    "eat": {"CR": np.full(TRAIN, 78.0), "NCR": np.where(BLOCK < 8, 20.0, 83.0)},
    "drink": {"CR": np.full(TRAIN, 70.0), "NCR": np.where(BLOCK < 8, 20.0, 85.0)},
}
TABLE5 = {  # Table 5, and what else is said of validation
    "energy_max": (4484, 4525), "energy_min": (2781, 2683), "energy_mean": (3720, 3809), "safety_mean": (0.61, 0.38),
    "safety_min": (0.18, 0.12), "hunger_mean": (328, 420), "thirst_mean": (311, 363), "hunger_max": (700, 900),
    "thirst_max": (700, 900), "active_cycles": (418, 260), "turn_rad": (20, 30), "bouts": (8, 8),
    "bout_switches": (7, 3), "bout_interval_sd": (20, 60), "bout_interval_mean": (100, 100), "path_m": (20, 20)}
ACTIVATIONS = {"avoid": (204, 156), "eat": (109, 103), "drink": (130, 105)}
CELLS = (900, 790)  # visited by the centre, of those that it can reach
PATTERNS = {"any": [12, 12, 12, 12, 1, 1], "low": [12, 12, 12, 1, 1, 1], "LH": [1] * 6, "HH": [4] * 6}
WELL = 2700  # between CR's smallest energy and NCR's: with the paper's own 3067, C12 and Table 5 exclude each other


def write(study: Path, kind: str, seeds: int = 8) -> Path:
    """A study of CR, NCR and NCR with CR's states. ``kind``: paper, swapped, same_states (CR is the robot with its
    states and nothing curious), none (nobody learns, nobody differs), constant (every clock stays at 12)."""
    for seed in range(seeds):
        _write(study, kind, "litman", "plain", "CR" if kind == "paper" else "NCR", seed)
        _write(study, kind, "none", "plain", "CR" if kind == "swapped" else "NCR", seed)
        _write(study, kind, "none", "same_states", "NCR", seed)
    return study


def _write(study: Path, kind: str, curiosity: str, states: str, who: str, seed: int) -> None:
    folder = write_run(study, curiosity, seed, train=0, validation=0, cycles=0, name=f"{curiosity}-{states}-{seed}",
                       swept={"reading.non_curious": states}, **{"reading.energy_well": WELL})
    rng = np.random.default_rng([seed, curiosity == "litman", states == "plain"])
    run = {"run": folder.name, "seed": seed, "curiosity": curiosity}
    mine, learns = who == "NCR", kind in ("paper", "swapped", "same_states")

    def near(value: float) -> float:
        return value * (1 + 0.004 * rng.standard_normal())

    def curve(name: str) -> np.ndarray:
        at_the_end = CURVES[name][who][-1]
        train = CURVES[name][who] if learns else np.full(TRAIN, 0.6 if name == "survival" else at_the_end)
        return np.concatenate([train, np.full(VALIDATION, at_the_end)])
    n = TRAIN + VALIDATION
    phases = {"phase": ["train"] * TRAIN + ["validation"] * VALIDATION,
              "episode": [*range(TRAIN), *range(VALIDATION)]}
    episodes = {**{name: [value] * n for name, value in run.items()}, **phases,
                "survival": np.minimum(1.0, curve("survival") * np.where(curve("survival") < 1, near(1), 1)).tolist(),
                "death": ["none"] * n, "cycles": [CYCLES] * n}
    for name, values in TABLE5.items():
        value = values[mine] if name.startswith("bout") else near(values[mine])
        episodes[name] = [288 if kind == "constant" and name == "active_cycles" else value] * n
    for name in ("safety_mean", "safety_min"):
        episodes[name.replace("safety", "safety_held")] = episodes[name]
    rows: dict[str, list] = {name: [] for name in (*run, *phases, "behaviour", "activations", "reward",
                                                   "reward_extrinsic", "penalty")}
    for behaviour in BEHAVIOURS:
        looks = CYCLES // 12 if kind == "constant" else round(near(ACTIVATIONS[behaviour][mine]))
        reward = (curve(behaviour) * near(1)).tolist()
        for name, values in {**{k: [v] * n for k, v in run.items()}, **phases, "behaviour": [behaviour] * n,
                             "activations": [looks] * n, "reward": reward, "reward_extrinsic": reward,
                             "penalty": [0.0] * n}.items():
            rows[name] += values
    visited = round(near(CELLS[mine]))
    from attnlab.simulators.robot import RADIUS_M
    places = [(x, y) for x in range(3, 37) for y in range(3, 37) if _free(x, y, RADIUS_M)][:visited]
    coverage = [{"run": folder.name, "phase": "train", "x_cell": x, "y_cell": y,
                 "visits": 10 if not mine or i % 2 else 100} for i, (x, y) in enumerate(places)]
    _store(folder, "episodes", episodes)
    _store(folder, "behaviours", rows)
    _store(folder, "coverage", {name: [row[name] for row in coverage] for name in coverage[0]})
    policy = [row for level in (("none",) if curiosity == "none" and states == "plain" else LEVELS)
              for behaviour in BEHAVIOURS for row in _policy(folder.name, behaviour, level, kind, who, states)]
    _store(folder, "policy", {name: [row[name] for row in policy] for name in policy[0]})


def _policy(run: str, behaviour: str, level: str, kind: str, who: str, states: str) -> list[dict]:
    if kind in ("none", "constant"):
        periods = [12 if kind == "constant" else 8] * 6
    elif who == "NCR":
        periods = PATTERNS["any"]  # at every level, if it has levels
    else:
        periods = PATTERNS["LH" if level == "none" else level]
    return [{"run": run, "behaviour": behaviour, "curiosity_level": level, "period": 1, "percept": percept + 1,
             "action": action, "q": float(action == best), "visits": 10}
            for percept, best in enumerate(periods) for action in (1, 4, 8, 12)]


def _free(x: int, y: int, radius_m: float) -> bool:
    """Can the robot's centre be in the middle of this cell, in the world of small_study?"""
    for cx, cy in ((1.2, 2.8), (0.25, 1.0)):
        dx, dy = (max(abs((i + 0.5) * 0.1 - c) - 0.25, 0.0) for i, c in ((x, cx), (y, cy)))
        if dx * dx + dy * dy <= radius_m ** 2 + 1e-9:
            return False
    return True


def _store(folder: Path, table: str, columns: dict[str, list]) -> None:
    n = len(next(iter(columns.values())))
    full = {name: columns.get(name, [None] * n) for name in SCHEMA[table]}
    write_parquet(folder / f"{table}.parquet", full, columns_of(table, BEHAVIOURS, {}, {}))
