"""The arena of attention, made by one command."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import time
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from attnlab.results.load import Study

NAME, STUDY = "arena", "arena_worlds"
LOGS = ("scitos-g5-24-ultrasound.csv.gz", "freiburg-079.carmen.log.gz")
READ = "sena-2006.rawlog"  # too short to learn on
CLAIMS = ("temporl", "amrl", "timing", "tacos")
FILES = {"index.html": "report.html", "standings.csv": "standings.csv", "ranks.csv": "ranks.csv",
         "leaderboard.jsonl": "leaderboard.jsonl"}  # what it writes: what it is called here
PRICE = "0.5"


def make(outputs: Path, to: Path, logs: Path, keep: bool, short: bool) -> bool:
    """Everything by the arena's command, then its tables into ``to``. False if it failed."""
    made, began = outputs / NAME, time.monotonic()
    typed = ["--worlds", "all", *(word for log in LOGS for word in ("--log", str(logs / log))), "--read",
             str(logs / READ), "--price", PRICE, "--name", STUDY, "--out", str(made)]
    typed += ["--seeds", "2", "--epochs", "1"] if short else []
    more = ["train_episodes=2", "validation_episodes=2", "max_cycles=150"] if short else []
    more += [*([f"outputs={outputs}"] if str(outputs) != "outputs" else []), *([] if keep else ["fresh=true"])]
    if subprocess.run([sys.executable, "-m", "attnlab.arena", *typed, *more], check=False).returncode:
        return False
    spent = {"wall_s": round(time.monotonic() - began)}
    collect(made, outputs / STUDY, to / NAME, {} if keep else spent)
    return True


def collect(made: Path, study: Path, target: Path, spent: dict[str, int]) -> None:
    """Tables and page of what was made; ``spent``: seconds that all of it took, if that is known."""
    import attnlab
    from attnlab.tables.csvs import csv_bytes
    target.mkdir(parents=True, exist_ok=True)
    for name, kept in FILES.items():  # in the site a folder's index.html is its README
        shutil.copy(made / name, target / kept)
    loaded = attnlab.load(study)
    (target / "claims.csv").write_bytes(csv_bytes(("claims", "claim", "title", "world", "verdict"), asked(loaded)))
    told = json.loads((made / "leaderboard.jsonl").read_text().splitlines()[0])["made"]
    about = [loaded.about(run) for run in loaded.complete]
    episodes = loaded.config(loaded.complete[0])
    (target / "made.json").write_text(json.dumps({
        "command": told["command"], "code": told["code"], "runs": len(about), "asked_for": len(loaded.runs),
        "engines": sorted({one["engine"] for one in about}), "episodes": [episodes["train_episodes"],
                                                                          episodes["validation_episodes"]],
        "cycles": sum(one["cycles"] for one in about), "cpu_s_of_runs": round(sum(one["cpu_s"] for one in about)),
        **spent}, indent=1) + "\n")


def asked(study: Study) -> Iterable[Sequence[str]]:
    """What the papers say of their ways, judged in each world."""
    from attnlab.claims.files import load_claims
    from attnlab.claims.judge import judge
    from attnlab.results.conditions import Conditions
    for name in CLAIMS:
        claims = load_claims(name)
        conditions = Conditions(study, claims.labels)
        for world in dict.fromkeys(str(study.config(run)["world"]["name"]) for run in study.complete):
            for verdict in judge(claims, conditions, {"world": world, "curiosity": "none"}):
                yield name, verdict.id, verdict.claim.title, world, verdict.word
