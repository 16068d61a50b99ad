"""``python -m attnlab.certify``: do planar and pybullet agree? Exit 0 if within every tolerance, 1 if not.

    python -m attnlab.certify                                     every shipped world, some minutes
    python -m attnlab.certify --worlds paper --episodes 0         sensors and motion only
    python -m attnlab.certify reading.v_max_m_s=0.3               any setting of a run

Prints a table and stores certificate.json and certificate.md in --out.
"""

from __future__ import annotations

import argparse
import platform
import subprocess
import sys
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from attnlab import registry
from attnlab.console import guarded
from attnlab.errors import ConfigError
from attnlab.paths import PACKAGE, conf_dir

WORLDS = ("paper", "open", "cluttered", "random")
DRIVES = 20
PAIR = ("planar", "pybullet")


def main(argv: Sequence[str] | None = None) -> int:
    """Entry point; returns the exit code."""
    return guarded(_main, argv)


def _main(argv: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m attnlab.certify", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--poses", type=_count, default=5000, help="random poses a world (5000)")
    parser.add_argument("--episodes", type=_count, default=60,
                        help="training episodes of a closed-loop run, with half as many to validate; 0: none (60)")
    parser.add_argument("--seeds", type=_count, default=3, help="closed-loop runs a world (3)")
    parser.add_argument("--first-seed", type=_count, default=0, help="the first of them (0)")
    parser.add_argument("--worlds", default=",".join(WORLDS), help=f"names with commas ({','.join(WORLDS)})")
    parser.add_argument("--no-wheels", action="store_true", help="leave the unjudged row of drive=wheels out (slow)")
    parser.add_argument("--out", type=Path, default=Path("outputs/certificate"), help="folder (outputs/certificate)")
    parser.add_argument("overrides", nargs="*", help="settings of a run, name=value")
    arguments = parser.parse_args(argv)
    if not arguments.poses:
        raise ConfigError("--poses", "is 0, must be at least 1")
    registry.load_all()
    worlds = [world for world in arguments.worlds.split(",") if world]
    compose(worlds[0] if worlds else "", 0, "planar", 1, arguments.overrides)  # complain before anything runs
    found = certify(worlds, arguments.poses, arguments.episodes, arguments.seeds, arguments.overrides,
                    not arguments.no_wheels, arguments.first_seed)
    found["command"] = " ".join(["python -m attnlab.certify", *argv])
    _store(found, arguments.out)
    _show(found, arguments.out)
    return 0 if found["passes"] else 1


def _count(text: str) -> int:
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number of 0 or more")
    return int(text)


def compose(world: str, seed: int, simulator: str, episodes: int, overrides: Sequence[str], **more: Any) -> dict:
    """The shipped default config with these changes, as plain data."""
    from hydra import compose, initialize_config_dir
    from hydra.errors import HydraException
    from omegaconf import OmegaConf
    from omegaconf.errors import OmegaConfBaseException

    from attnlab.store import store_options
    store_options()
    try:
        with initialize_config_dir(str(conf_dir()), version_base="1.3"):
            config = compose("config", [f"world={world}", f"simulator={simulator}", f"seed={seed}", "record=all",
                                        f"train_episodes={max(1, episodes)}",
                                        f"validation_episodes={(episodes + 1) // 2}", *overrides])
    except (HydraException, OmegaConfBaseException) as cause:
        raise ConfigError("certify", " ".join(str(cause).split()), "Settings are name=value, worlds go to --worlds") \
            from None
    return {**OmegaConf.to_container(config, resolve=True), **more}


def certify(worlds: Sequence[str], poses: int, episodes: int, seeds: int, overrides: Sequence[str],
            wheels: bool = True, first: int = 0) -> dict[str, Any]:
    """All measures of all worlds, and the verdict."""
    from attnlab.certificate.verdict import judge
    from attnlab.run import versions
    commit = _commit()  # before anything runs: the checkout may move on meanwhile
    runs = len(worlds) * seeds * (episodes + (episodes + 1) // 2)
    with _progress(len(worlds) * (poses + DRIVES), runs * (5 if wheels else 4)) as ticks:
        measures = {}
        for world in worlds:
            measures[world] = _poses(world, poses, overrides, ticks[0])
            if episodes and seeds:
                measures[world] |= _loops(world, episodes, range(first, first + seeds), overrides, wheels, ticks[1])
    verdict = judge(measures)
    shown = compose(worlds[0], 0, "pybullet", 1, overrides)["simulator"]
    return {"passes": all(row["passes"] for row in verdict), "commit": commit, "poses": poses, "seeds": seeds,
            "train": episodes, "validation": (episodes + 1) // 2 if episodes else 0,
            "camera": f"{shown['camera_columns']}x{shown['camera_rows']}", "versions": versions(),
            "machine": platform.machine(), "verdict": verdict, "worlds": measures}


def _poses(world: str, poses: int, overrides: Sequence[str], tick) -> dict[str, Any]:
    from attnlab.certificate.poses import compare_drives, compare_poses
    from attnlab.experiment import Experiment
    from attnlab.streams import stream
    planar, pybullet = (Experiment(compose(world, 0, name, 1, overrides)).simulator() for name in PAIR)
    with planar, pybullet:
        found = compare_poses(planar, pybullet, poses, stream(0, "certificate", world, "poses"), tick)
        found |= compare_drives(planar, pybullet, DRIVES, stream(0, "certificate", world, "drives"), tick)
    return {**found, "rays_grazing_share": found["rays_grazing"] / max(1, found["rays"])}


def _loops(world: str, episodes: int, seeds: range, overrides: Sequence[str], wheels: bool, tick) -> dict[str, Any]:
    """Runs that stay in their simulator, and the same ones validated in the other (and on wheels)."""
    import numpy as np

    from attnlab.certificate.episodes import counts, divergence, exchangeable, run, survival, total_variation
    kept: dict[str, list[float]] = {}
    totals: dict[str, dict[str, Counter]] = {name: {} for name in PAIR}
    by_seed: dict[str, list[dict[str, Counter]]] = {name: [] for name in PAIR}
    pairs = []
    for seed in seeds:
        stayed = {}
        for name, other in (PAIR, PAIR[::-1]):
            config = compose(world, seed, name, episodes, overrides)
            stayed[name] = run(config, tick)
            kept.setdefault(f"{name}_on_{name}", []).extend(survival(stayed[name]))
            by_seed[name].append(counts(stayed[name], config["behaviours"]))
            for key, count in by_seed[name][-1].items():
                totals[name][key] = totals[name].get(key, Counter()) + count
            moves = [(other, {"simulator": other, "drive": None})]
            if name == "planar" and wheels:
                moves.append(("wheels", {"simulator": "pybullet", "drive": "wheels"}))
            for label, validation in moves:
                moved = run({**config, "record": "none", "validation": validation}, tick)
                kept.setdefault(f"{name}_on_{label}", []).extend(survival(moved))
        pairs.append(divergence(stayed["planar"], stayed["pybullet"]))
    gaps = [gap for pair in pairs for gap in pair["gaps_m"]]
    apart = {key: total_variation(count, totals["pybullet"][key]) for key, count in totals["planar"].items()}
    found = {name: float(np.mean(values)) for name, values in kept.items()}
    if len(seeds) > 1:
        found["loops_differ"] = 1 - exchangeable(by_seed["planar"], by_seed["pybullet"])
    return {
        **found, "loop_episodes": len(gaps), "loop_identical": sum(pair["identical"] for pair in pairs),
        "loop_first": min(pair["first"] for pair in pairs), "loop_gap_m_median": float(np.median(gaps)),
        "loop_gap_m_p99": float(np.quantile(gaps, 0.99)), "loop_gap_m_max": max(gaps),
        **{f"{what}_tv": max(v for key, v in apart.items() if key.startswith(what))
           for what in ("percepts", "periods", "deaths")},
        "transfer_planar_pybullet_points": 100 * (found["planar_on_pybullet"] - found["planar_on_planar"]),
        "transfer_pybullet_planar_points": 100 * (found["pybullet_on_planar"] - found["pybullet_on_pybullet"]),
    }


def _progress(poses: int, episodes: int):
    """A context manager with a bar for poses and one for episodes: the two functions that advance them."""
    from contextlib import contextmanager

    from rich.console import Console
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    @contextmanager
    def bars():
        with Progress(TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn(),
                      TextColumn("left"), TimeRemainingColumn(), console=Console(stderr=True)) as progress:
            tasks = [progress.add_task(name, total=total) for name, total in (("poses", poses), ("episodes", episodes))]
            yield [lambda task=task: progress.advance(task) for task in tasks]
    return bars()


def _commit() -> str:
    """Of the code that ran, marked where files differ from it; unknown outside of a checkout."""
    try:
        shown = subprocess.run(["git", "-C", str(PACKAGE), "describe", "--always", "--dirty", "--abbrev=10"],
                               capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return "unknown"
    return shown.replace("-dirty", " with local changes")


def _store(found: dict[str, Any], folder: Path) -> None:
    from attnlab.certificate.page import page
    from attnlab.results.files import write_bytes, write_json
    folder.mkdir(parents=True, exist_ok=True)
    write_json(folder / "certificate.json", found)
    write_bytes(folder / "certificate.md", page(found).encode())


def _show(found: dict[str, Any], folder: Path) -> None:
    from rich.console import Console
    from rich.table import Table

    from attnlab.certificate.page import number
    table = Table("measure", "tolerance", "worst", "in world", "", title="planar against pybullet")
    for row in found["verdict"]:
        table.add_row(row["meaning"], f"{number(row['limit'])} {row['unit']}", number(row["worst"]), row["world"],
                      "passes" if row["passes"] else "FAILS")
    Console().print(table)
    print(f"{'Certified' if found['passes'] else 'Not certified'}; all numbers in {folder / 'certificate.md'}")


if __name__ == "__main__":
    sys.exit(main())
