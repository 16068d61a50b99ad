"""The measures of a certificate: sensors at random poses, blind drives, closed loops, policies that move over."""

from __future__ import annotations

import platform
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from typing import Any

from attnlab.certify.verdict import judge
from attnlab.cli.calls import composed
from attnlab.errors import ConfigError
from attnlab.tables.code import commit, versions

Tick = Callable[[], None]
Progress = Callable[[int, int], AbstractContextManager[list[Tick]]]

WORLDS = ("paper", "open", "cluttered", "random")
DRIVES = 20
PAIR = ("planar", "pybullet")


@contextmanager
def quiet(_poses: int, _episodes: int) -> Iterator[list[Tick]]:
    """Counts nothing."""
    yield [lambda: None, lambda: None]


def compose(world: str, seed: int, simulator: str, episodes: int, overrides: Sequence[str], **more: Any
            ) -> dict[str, Any]:
    """The shipped default config with these changes, as plain data."""
    try:
        config = composed([f"world={world}", f"simulator={simulator}", f"seed={seed}", "record=all",
                           f"train_episodes={max(1, episodes)}", f"validation_episodes={(episodes + 1) // 2}",
                           *overrides])
    except ConfigError as error:
        raise ConfigError(error.setting, error.problem, f"{error.hint}. Settings are name=value, worlds go to --worlds"
                          ) from None
    return {**config, **more}


def certify(worlds: Sequence[str], poses: int, episodes: int, seeds: int, overrides: Sequence[str],
            wheels: bool = True, first: int = 0, progress: Progress = quiet) -> dict[str, Any]:
    """All measures of all worlds, and the verdict. ``progress(poses, episodes)`` is a context manager that gives the
    two functions that count them."""
    made_by = commit().replace("-dirty", " with local changes") or "unknown"  # now: the checkout may move on meanwhile
    runs = len(worlds) * seeds * (episodes + (episodes + 1) // 2)
    with progress(len(worlds) * (poses + DRIVES), runs * (5 if wheels else 4)) as ticks:
        measures = {}
        for world in worlds:
            measures[world] = _poses(world, poses, overrides, ticks[0])
            if episodes and seeds:
                measures[world] |= _loops(world, episodes, range(first, first + seeds), overrides, wheels, ticks[1])
    verdict = judge(measures)
    shown = compose(worlds[0], 0, "pybullet", 1, overrides)["simulator"]
    return {"passes": all(row["passes"] for row in verdict), "commit": made_by, "poses": poses, "seeds": seeds,
            "train": episodes, "validation": (episodes + 1) // 2 if episodes else 0,
            "camera": f"{shown['camera_columns']}x{shown['camera_rows']}", "versions": versions(),
            "machine": platform.machine(), "verdict": verdict, "worlds": measures}


def _poses(world: str, poses: int, overrides: Sequence[str], tick: Tick) -> dict[str, Any]:
    from attnlab.certify.poses import compare_drives, compare_poses
    from attnlab.robot.plan import RunPlan
    from attnlab.streams import stream
    planar, pybullet = (RunPlan(compose(world, 0, name, 1, overrides)).simulator() for name in PAIR)
    with planar, pybullet:
        found = compare_poses(planar, pybullet, poses, stream(0, "certificate", world, "poses"), tick)
        found |= compare_drives(planar, pybullet, DRIVES, stream(0, "certificate", world, "drives"), tick)
    return {**found, "rays_grazing_share": found["rays_grazing"] / max(1, found["rays"])}


def _loops(world: str, episodes: int, seeds: range, overrides: Sequence[str], wheels: bool, tick: Tick
           ) -> dict[str, Any]:
    """Runs that stay in their simulator, and the same ones validated in the other (and on wheels)."""
    import numpy as np

    from attnlab.certify.episodes import counts, divergence, exchangeable, run, survival, total_variation
    kept: dict[str, list[float]] = {}
    totals: dict[str, dict[str, Counter[Any]]] = {name: {} for name in PAIR}
    by_seed: dict[str, list[dict[str, Counter[Any]]]] = {name: [] for name in PAIR}
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
