"""One run: training episodes, then validation episodes, to tidy tables in a folder."""

from __future__ import annotations

import os
import platform
import time
import traceback
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from attnlab import __version__
from attnlab.cycle import Agent, machine_cycle
from attnlab.experiment import Experiment
from attnlab.exploration.base import Exploration
from attnlab.guards import PartError, diagnose, verdict
from attnlab.processes import birth
from attnlab.registry import plugin_hashes
from attnlab.results.files import write_bytes, write_json, write_parquet
from attnlab.results.record import Moment, Recorder
from attnlab.results.schema import COLUMNS, PER_BEHAVIOUR, SCHEMA_VERSION, TABLES

Progress = Callable[[int, int], None]  # (episodes done, cycles done)


def run_episode(agent: Agent, exploration: Exploration, start: tuple[float, float, float], learning: bool
                ) -> tuple[list[Moment], str | None, list[float]]:
    """One episode from ``start`` (m, m, rad): its history, the cause of death or None, each behaviour's penalty."""
    agent.start(*start)
    simulator, body = agent.simulator, agent.body
    history, death = [(0, 0, body.energy, *body.values)], None
    while death is None and simulator.cycle < agent.max_cycles:
        active, death = machine_cycle(agent, exploration, learning)
        history.append((simulator.cycle, active, body.energy, *body.values))
    body.dead = death is not None
    penalties = agent.died(death, learning) if death else [0.0] * len(agent.attentions)
    return history, death, penalties


def run_experiment(experiment: Experiment, run: str = "run", swept: Mapping[str, Any] | None = None,
                   progress: Progress | None = None, folder: Path | None = None
                   ) -> tuple[dict[str, dict[str, list]], int]:
    """All episodes of a run; (tables as lists by column, machine cycles simulated).

    ``folder``: where a learner that works offline keeps its journal."""
    s = experiment.settings
    recorder = Recorder(run, s.seed, s.curiosity["name"], dict(swept or {}), experiment.layout, s.check_identities)
    done = cycles = 0
    phases = [("train", s.train_episodes), ("validation", s.validation_episodes)]
    last = max(i for i, (_, episodes) in enumerate(phases) if episodes)
    experiment.prepare(folder)
    simulator, agent = experiment.simulator(), None
    try:
        agent = experiment.agent(simulator)
        for index, (phase, episodes) in enumerate(phases):
            exploration = experiment.exploration(phase)
            learning = phase == "train"
            if phase == "validation" and experiment.validation_spec is not None:
                simulator.close()
                agent.simulator = agent.now.simulator = simulator = experiment.simulator(validation=True)
            for episode in range(episodes):
                if learning:
                    exploration.start(episode)
                outcome = run_episode(agent, exploration, experiment.start_pose(phase, episode), learning)
                full = (s.record == "all" or (s.record == "validation" and phase == "validation")
                        or (s.record == "last" and index == last and episode == episodes - 1))
                recorder.episode(agent, phase, episode, *outcome, full)
                done, cycles = done + 1, cycles + simulator.cycle
                if progress:
                    progress(done, cycles)
        return recorder.finish(agent), cycles
    except PartError:
        raise
    except Exception:
        if agent is not None:
            diagnose(agent)  # raises, and names the part, if one gave what it must not
        raise
    finally:
        simulator.close()


def run_to_folder(config: Mapping[str, Any], folder: Path, info: Mapping[str, Any],
                  progress: Progress | None = None) -> bool:
    """Run and store; True if complete. A failure is stored with its traceback and goes no further.

    ``info``: run (name), key, overrides, swept, sources. run.json says ``running`` first and ``complete`` last, so a
    folder in any other state is never taken for a result.
    """
    from omegaconf import OmegaConf
    folder.mkdir(parents=True, exist_ok=True)
    started = time.perf_counter()
    about = {"status": "running", "key": info["key"], "seed": config["seed"], "overrides": list(info["overrides"]),
             "swept": dict(info["swept"]), "curiosity": config["curiosity"]["name"], "schema": SCHEMA_VERSION,
             "condition": info.get("condition"), "plugins": plugin_hashes(config),
             "versions": versions(), "claims": _claims(config),
             "pid": os.getpid(), "pid_birth": birth(os.getpid()), "host": platform.node(),
             "wall_s": None, "cpu_s": None, "cycles": None, "error": None}
    write_json(folder / "run.json", about)
    write_bytes(folder / "config.yaml", OmegaConf.to_yaml(OmegaConf.create(dict(config))).encode())
    for name in TABLES:
        (folder / f"{name}.parquet").unlink(missing_ok=True)
    cpu = time.process_time()
    try:
        experiment = Experiment(config)
        tables, cycles = run_experiment(experiment, info["run"], info["swept"], progress, folder)
        per_behaviour = {f"{b}_{column}": kind for b in config["behaviours"] for column, kind in PER_BEHAVIOUR.items()}
        for name in TABLES:
            types = {**COLUMNS[name], **(per_behaviour if name == "cycles" else {})}
            columns = tables[name] or {column: [] for column in COLUMNS[name]}
            write_parquet(folder / f"{name}.parquet", columns, types)
        about.update(status="complete", cycles=cycles)
    except Exception as cause:  # noqa: BLE001  a failed run is data: its traceback is stored, the sweep goes on
        about.update(status="failed", error=f"{traceback.format_exc()}\n{verdict(cause)}\n")
    about.update(wall_s=round(time.perf_counter() - started, 3), cpu_s=round(time.process_time() - cpu, 3))
    write_json(folder / "run.json", about)
    return about["status"] == "complete"


def _claims(config: Mapping[str, Any]) -> dict[str, str] | None:
    """Name and hash of the claims file as it is when the run starts, so that later changes show."""
    from attnlab.claims import claims_hash
    name = config.get("claims_file")
    return {"name": name, "sha256": claims_hash(name)} if name else None


def versions() -> dict[str, str]:
    """Of everything a number may depend on."""
    from importlib.metadata import PackageNotFoundError, version
    found = {"attnlab": __version__, "python": platform.python_version()}
    for package in ("numpy", "pybullet", "numba", "pyarrow", "hydra-core"):
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            continue
    return found
