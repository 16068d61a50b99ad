"""A small synthetic study, written as the run writes one: seconds instead of minutes, and with known numbers."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import yaml

from attnlab.tables.files import write_json, write_parquet
from attnlab.tables.schema import OF_BEHAVIOUR, SCHEMA, SCHEMA_VERSION, columns_of

BEHAVIOURS = ("avoid", "eat", "drink")
WORLD = {"name": "paper", "part": "layout", "width_m": 4.0, "depth_m": 4.0,
         "boxes": [{"kind": "obstacle", "x_m": 1.2, "y_m": 2.8}, {"kind": "food", "x_m": 0.25, "y_m": 1.0}]}


def write_run(study: Path, curiosity: str, seed: int, *, train: int = 20, validation: int = 4, cycles: int = 120,
              swept: dict | None = None, name: str = "", labels: dict | None = None, safety: float = 0.0,
              claims: str | None = None, **config) -> Path:
    """One complete run folder; ``safety`` is added to the safety of curious runs."""
    name = name or "-".join([curiosity, *map(str, (swept or {}).values()), f"seed{seed}"])
    folder = study / name
    folder.mkdir(parents=True)
    rng = np.random.default_rng([seed, curiosity == "litman"])
    swept, run = swept or {}, {"run": name, "seed": seed, "curiosity": curiosity}
    tables = {table: {column: [] for column in columns} for table, columns in SCHEMA.items()}
    for behaviour in BEHAVIOURS:
        for column in OF_BEHAVIOUR:
            tables["cycles"][f"{behaviour}_{column}"] = []

    def add(table: str, **row) -> None:
        for column, value in row.items():
            tables[table].setdefault(column, []).append(value)
    for phase, count in (("train", train), ("validation", validation)):
        for episode in range(count):
            key = {**run, "phase": phase, "episode": episode}
            shift = safety * (curiosity == "litman")
            add("episodes", **key, cycles=cycles, survival=min(1.0, 0.9 + 0.1 * rng.random()), death="none",
                active_cycles=40, meals=1, drinks=1, safety_mean=0.3 + shift + 0.01 * rng.random(), safety_min=0.1,
                safety_max=0.9, safety_held_mean=0.3, safety_held_min=0.1, safety_held_max=0.9,
                energy_mean=4000 + 9 * rng.random(), energy_min=3500.0, energy_max=4600.0,
                hunger_mean=400 + rng.random(), hunger_max=600.0, thirst_mean=410 + rng.random(), thirst_max=610.0,
                wanting_mean=0.5, path_m=20.0, turn_rad=30.0, bouts=4, bout_switches=2,
                bout_interval_mean=250.0, bout_interval_sd=40.0, **swept)
            for behaviour in BEHAVIOURS:
                add("behaviours", **key, behaviour=behaviour, activations=int(rng.integers(18, 24)), releases=3,
                    reward=50 + rng.random(), reward_extrinsic=51.0, penalty=0.0, liking_mean=0.5, period_mean=8.0,
                    **swept)
    levels = ("none",) if curiosity == "none" else ("low", "LH", "HH")
    for behaviour in BEHAVIOURS:
        for level in levels:
            for period in (1, 12):
                for percept in range(1, 7):
                    for action in (1, 12):
                        best = 12 if percept <= 4 else 1
                        add("policy", run=name, behaviour=behaviour, curiosity_level=level, period=period,
                            percept=percept, action=action, q=float(action == best), visits=5)
    for cycle in range(cycles):
        row = {"run": name, "phase": "validation", "episode": validation - 1, "cycle": cycle,
               "x_m": 2 + np.cos(cycle / 20 + seed), "y_m": 2 + np.sin(cycle / 20 + seed), "heading_rad": 0.0,
               "v_m_s": 0.3, "w_rad_s": 0.1, "hunger": 300.0 + cycle % 60, "thirst": 300.0 + (cycle + 30) % 60,
               "energy": 4600.0 - cycle, "wanting": 0.5, "safety": 0.4, "safety_held": 0.4}
        for offset, behaviour in enumerate(BEHAVIOURS):
            row |= {f"{behaviour}_active": (cycle + offset) % 6 == 0, f"{behaviour}_period": 12 if cycle % 2 else 1,
                    f"{behaviour}_percept": 3, f"{behaviour}_level": levels[0]}
        add("cycles", **row)
    for phase in ("train", "validation"):
        for x in range(10 + seed):
            for y in range(10):
                add("coverage", run=name, phase=phase, x_cell=x + 5, y_cell=y + 5, visits=int(rng.integers(1, 50)))
    for table, columns in tables.items():
        write_parquet(folder / f"{table}.parquet", columns, columns_of(table, BEHAVIOURS, {}, {}))
    content = {"seed": seed, "train_episodes": train, "validation_episodes": validation, "max_cycles": cycles,
               "curiosity": {"name": curiosity}, "labels": labels or {}, "world": WORLD,
               "reading": {"name": "inferred", "non_curious": "plain"}, "simulator": {"name": "planar"},
               "learner": {"name": "q_learning"},
               "exploration": {"name": "softmax"}}
    for key, value in {**swept, **config}.items():
        node, parts = content, key.split(".")
        for part in parts[:-1]:
            node = node.setdefault(part, {})
        node[parts[-1]] = value
    (folder / "config.yaml").write_text(yaml.safe_dump(content, sort_keys=False))
    about = {"status": "complete", "key": name, "seed": seed, "curiosity": curiosity, "swept": swept,
             "overrides": [f"curiosity={curiosity}", f"seed={seed}", *(f"{k}={v}" for k, v in swept.items())],
             "schema": SCHEMA_VERSION, "versions": {"attnlab": "0.1.0"}, "wall_s": 1.0, "cpu_s": 1.0, "cycles": 9,
             "error": None}
    if claims:
        about["claims"] = {"name": "dinocera2014", "sha256": claims}
    write_json(folder / "run.json", about)
    return folder


def write_study(path: Path, seeds: int = 6, curiosities: tuple = ("litman", "none"), **kind) -> Path:
    for seed in range(seeds):
        for curiosity in curiosities:
            write_run(path, curiosity, seed, **kind)
    return path
