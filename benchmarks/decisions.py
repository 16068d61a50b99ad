"""``python benchmarks/decisions.py --publish``: what a machine cycle costs when somebody else decides, over the plain
loop of the same run as Python: CPU time of the same episodes, in turns, the least of each. ``--publish`` stores it and
writes the paragraph of docs/gym.md."""

from __future__ import annotations

import argparse
import json
import os
import re
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import gymnasium

import attnlab.gym  # noqa: F401  registers
from attnlab.api import compose
from attnlab.gym.aec import BehavioursEnv
from attnlab.robot.episodes import play_run
from attnlab.robot.plan import RunPlan

ROOT = Path(__file__).resolve().parents[1]
RESULT = ROOT / "benchmarks" / "results" / "batch" / "decisions.json"
PAGE = ROOT / "docs" / "gym.md"
PERIODS = (1, 4, 12)
BLOCK = re.compile(r"(<!-- decisions: .*? -->\n).*?(<!-- end -->)", re.DOTALL)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--publish", action="store_true", help=f"store it in {RESULT.relative_to(ROOT)}")
    given = parser.parse_args()
    found = {"load": os.getloadavg()[0], "cores": len(os.sched_getaffinity(0)),
             "ratios": {str(period): ratios(period) for period in PERIODS}}
    print(json.dumps(found, indent=1))
    if given.publish:
        RESULT.write_text(json.dumps(found, indent=1) + "\n")
        PAGE.write_text(page(PAGE.read_text(), found))
    return 0


def ratios(period: int, episodes: int = 12, times: int = 5, only: tuple[str, ...] = ()) -> dict[str, float]:
    """CPU time of an environment whose every action is ``period``, over that of ``learner=fixed_PERIOD``; ``plain_us``:
    what a cycle of that takes, microseconds."""
    how = [f"learner=fixed_{period}", "simulator=planar", "check_identities=false", "record=none"]
    plan = RunPlan(compose(*how, f"train_episodes={episodes}", "validation_episodes=0", "seed=1"))
    action = plan.settings.periods.index(period)
    cycles = 0

    def plain() -> None:
        nonlocal cycles
        _, cycles = play_run(plan)
    envs: dict[str, Any] = {"Attention-v0": gymnasium.make("attnlab/Attention-v0", overrides=how).unwrapped,
            "Survival-v0": gymnasium.make("attnlab/Survival-v0", overrides=how).unwrapped,
            "BehavioursEnv": BehavioursEnv(how)}
    entries: dict[str, Callable[[], None]] = {
        "plain": plain, "Attention-v0": lambda: _steps(envs["Attention-v0"], action, episodes),
        "Survival-v0": lambda: _steps(envs["Survival-v0"], [action] * len(plan.settings.behaviours), episodes),
        "BehavioursEnv": lambda: _turns(envs["BehavioursEnv"], action, episodes)}
    spent: dict[str, list[float]] = {name: [] for name in entries if not only or name in ("plain", *only)}
    for _ in range(times):
        for name, of in spent.items():
            begin = time.process_time()
            entries[name]()
            of.append(time.process_time() - begin)
    plain_s = min(spent.pop("plain"))
    return {"plain_us": plain_s / cycles * 1e6, **{name: min(of) / plain_s for name, of in spent.items()}}


def _steps(env: Any, action: Any, episodes: int) -> None:
    for episode in range(episodes):
        env.reset(seed=1 if episode == 0 else None)
        while not any(env.step(action)[2:4]):
            pass


def _turns(env: BehavioursEnv, action: int, episodes: int) -> None:
    for episode in range(episodes):
        env.reset(seed=1 if episode == 0 else None)
        for _ in env.agent_iter():
            _, _, died, out_of_time, _ = env.last()
            env.step(None if died or out_of_time else action)


def page(text: str, found: dict[str, Any]) -> str:
    """A page with its paragraph."""
    worst = {name: max(of[name] for of in found["ratios"].values()) for name in next(iter(found["ratios"].values()))
             if name != "plain_us"}
    said = ", ".join(f"{ratio:.1f} times in `{name}`" for name, ratio in worst.items())
    periods = ", ".join(found["ratios"])
    return BLOCK.sub(lambda m: f"{m[1]}A machine cycle takes, of the plain loop's CPU time as Python, at most {said} "
                     f"(constant periods of {periods}).\n{m[2]}", text)


if __name__ == "__main__":
    sys.exit(main())
