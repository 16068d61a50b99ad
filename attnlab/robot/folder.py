"""A run's folder: run.json, config.yaml and the tables, written whole or not at all."""

from __future__ import annotations

import contextlib
import os
import platform
import time
import traceback
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from attnlab.errors import describe
from attnlab.loading import plugin_hashes, plugin_versions
from attnlab.robot.agents import FILE as AGENT
from attnlab.robot.engines import Choice, choose, exempt
from attnlab.robot.episodes import Progress, play_run
from attnlab.robot.guards import verdict
from attnlab.robot.keeping import Keeping
from attnlab.robot.observers import Observers
from attnlab.robot.plan import RunPlan
from attnlab.robot.recorded import told_of
from attnlab.tables.claim import Claim
from attnlab.tables.code import versions
from attnlab.tables.files import mark_of, sweep_temporary, write_bytes, write_json, write_parquet
from attnlab.tables.numbers import numbers_of
from attnlab.tables.processes import birth, cpu_s
from attnlab.tables.schema import SCHEMA_VERSION, TABLES

LONGEST = 20_000  # characters of an error that are kept; a message may have megabytes


class ClaimLostError(Exception):
    """Somebody else took the run over, for nothing was heard of this process; it must write no more."""


def run_to_folder(config: Mapping[str, Any], folder: Path, info: Mapping[str, Any],
                  progress: Progress | None = None, claim: Claim | None = None) -> bool:
    """Run and store; True if complete. A failure is stored with its traceback and goes no further.

    ``info``: run (name), key, overrides, swept, sources. run.json says ``running`` first and ``complete`` last, so a
    folder in any other state is never taken for a result. ``claim``: on this run; looked at once more before anything
    that was made is written. Raises :class:`ClaimLostError`.
    """
    from omegaconf import OmegaConf
    folder = folder.absolute()  # a part may change the working folder
    folder.mkdir(parents=True, exist_ok=True)
    sweep_temporary(folder)
    started = time.perf_counter()
    about = {"status": "running", "run": info["run"], "key": info["key"], "seed": config["seed"],
             "overrides": list(info["overrides"]),
             "swept": dict(info["swept"]), "curiosity": config["curiosity"]["name"], "schema": SCHEMA_VERSION,
             "condition": info.get("condition"), "plugins": plugin_hashes(config),
             "versions": {**versions(), **plugin_versions(config)}, "code": info.get("code"),
             "claims": info.get("claims"), "claim": claim.token if claim else None, "engine": None, "engine_why": None,
             "pid": os.getpid(), "pid_birth": birth(os.getpid()), "host": platform.node(),
             "wall_s": None, "cpu_s": None, "cycles": None, "error": None}
    write_json(folder / "run.json", about)
    write_bytes(folder / "config.yaml", OmegaConf.to_yaml(OmegaConf.create(dict(config))).encode())
    for name in (*(f"{table}.parquet" for table in TABLES), AGENT):
        (folder / name).unlink(missing_ok=True)
    cpu, observers, keeping = cpu_s(), Observers(), None
    interrupt = None
    try:
        with _here():
            plan = RunPlan(config)
            if skipped := told_of(plan):
                about["skipped"] = skipped
            keeping = Keeping(plan, folder, info["key"], lambda: claim is None or claim.held())
            observers = Observers(plan.callbacks(info["run"], folder))
            observers.start(config)
            engine = Choice(*(info.get("engine") or choose(plan)))
            about.update(engine=engine.name, engine_why=engine.why)
            if why := exempt(plan):
                about["exempt_from_same_bytes"] = why
            try:
                tables, cycles = play_run(plan, info["run"], info["swept"], progress, folder, observers, engine.name,
                                          keeping)
            except Exception as cause:
                if engine.name == "python":
                    raise
                about.update(engine="python", engine_why=f"compiled, it raised {describe(cause)}; played again")
                tables, cycles = play_run(plan, info["run"], info["swept"], progress, folder, observers,
                                          keeping=keeping)
        _check_held(claim)
        about["tables"] = {}
        for name in TABLES:
            columns = plan.columns(name)
            about["tables"][name] = write_parquet(folder / f"{name}.parquet",
                                                  tables[name] or {column: [] for column in columns}, columns)
        if keeping.agent is not None:
            write_bytes(folder / AGENT, keeping.agent)
            about["agent"] = mark_of(keeping.agent)
        about.update(status="complete", cycles=cycles, numbers=numbers_of(tables))
    except ClaimLostError:
        raise
    except KeyboardInterrupt as cause:
        about.update(status="failed", error="interrupted before it was complete\n", interrupted=True)
        interrupt = cause
    except BaseException as cause:  # noqa: BLE001  a failed run is data, and a part may raise anything
        about.update(status="failed", error=f"{_cut(traceback.format_exc())}\n{_cut(verdict(cause))}\n")
    observers.end(str(about["status"]))
    if observers.errors:
        about["callbacks"] = observers.errors
    wall, spent = time.perf_counter() - started, cpu_s() - cpu
    if keeping is not None:
        about.update(keeping.notes)
        wall, spent = wall + keeping.wall_s, spent + keeping.cpu_s
    about.update(wall_s=round(wall, 3), cpu_s=round(spent, 3))
    _check_held(claim)
    write_json(folder / "run.json", about)
    if keeping is not None and about["status"] == "complete":
        keeping.forget()
    if interrupt is not None:
        raise interrupt
    return bool(about["status"] == "complete")


def _check_held(claim: Claim | None) -> None:
    if claim is not None and not claim.held():
        raise ClaimLostError(claim.path.name)


def _cut(text: str) -> str:
    """A text of bearable length: its two ends."""
    half = LONGEST // 2
    return text if len(text) <= LONGEST else f"{text[:half]} [{len(text) - LONGEST:,} characters] {text[-half:]}"


@contextlib.contextmanager
def _here() -> Iterator[None]:
    """Come back to the working folder, wherever a part went."""
    try:
        home = Path.cwd()
    except OSError:  # it was deleted
        yield
        return
    try:
        yield
    finally:
        with contextlib.suppress(OSError):
            os.chdir(home)
