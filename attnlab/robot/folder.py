"""A run's folder: run.json, config.yaml and the tables, written whole or not at all."""

from __future__ import annotations

import os
import platform
import time
import traceback
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from attnlab.loading import plugin_hashes
from attnlab.robot.episodes import Progress, play_run
from attnlab.robot.guards import verdict
from attnlab.robot.observers import Observers
from attnlab.robot.plan import RunPlan
from attnlab.tables.code import versions
from attnlab.tables.files import write_bytes, write_json, write_parquet
from attnlab.tables.processes import birth
from attnlab.tables.schema import SCHEMA_VERSION, TABLES


def run_to_folder(config: Mapping[str, Any], folder: Path, info: Mapping[str, Any],
                  progress: Progress | None = None) -> bool:
    """Run and store; True if complete. A failure is stored with its traceback and goes no further.

    ``info``: run (name), key, overrides, swept, sources. run.json says ``running`` first and ``complete`` last, so a
    folder in any other state is never taken for a result.
    """
    from omegaconf import OmegaConf
    folder.mkdir(parents=True, exist_ok=True)
    started = time.perf_counter()
    about = {"status": "running", "run": info["run"], "key": info["key"], "seed": config["seed"],
             "overrides": list(info["overrides"]),
             "swept": dict(info["swept"]), "curiosity": config["curiosity"]["name"], "schema": SCHEMA_VERSION,
             "condition": info.get("condition"), "plugins": plugin_hashes(config),
             "versions": versions(), "code": info.get("code"), "claims": info.get("claims"),
             "pid": os.getpid(), "pid_birth": birth(os.getpid()), "host": platform.node(),
             "wall_s": None, "cpu_s": None, "cycles": None, "error": None}
    write_json(folder / "run.json", about)
    write_bytes(folder / "config.yaml", OmegaConf.to_yaml(OmegaConf.create(dict(config))).encode())
    for name in TABLES:
        (folder / f"{name}.parquet").unlink(missing_ok=True)
    cpu, observers = time.process_time(), Observers()
    try:
        plan = RunPlan(config)
        observers = Observers(plan.callbacks(info["run"], folder))
        observers.start(config)
        tables, cycles = play_run(plan, info["run"], info["swept"], progress, folder, observers)
        for name in TABLES:
            columns = plan.columns(name)
            write_parquet(folder / f"{name}.parquet", tables[name] or {column: [] for column in columns}, columns)
        about.update(status="complete", cycles=cycles)
    except Exception as cause:  # noqa: BLE001  a failed run is data: its traceback is stored, the sweep goes on
        about.update(status="failed", error=f"{traceback.format_exc()}\n{verdict(cause)}\n")
    observers.end(str(about["status"]))
    if observers.errors:
        about["callbacks"] = observers.errors
    about.update(wall_s=round(time.perf_counter() - started, 3), cpu_s=round(time.process_time() - cpu, 3))
    write_json(folder / "run.json", about)
    return bool(about["status"] == "complete")
