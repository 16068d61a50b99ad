"""``python benchmarks/kills.py --kills 200``: sweeps whose processes are killed at random, and what is left of them.

Every sweep is typed by two to four commands at once, in a folder that they share. At random instants a parent, a
worker, a whole group of processes or a fork server gets SIGKILL, and whatever command died is typed again. At the end
the command is typed until it says that all is done, and all tables are compared with those of a sweep that nobody
disturbed. The journal is a line a sweep, so that the campaign itself can be interrupted and goes on. Every other sweep
has longer runs, which keep a checkpoint every 0.6 s and go on from it.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import random
import shutil
import signal
import statistics
import subprocess
import sys
import threading
import time
from collections import Counter
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
RESULT = ROOT / "benchmarks" / "results" / "reliability" / "kills.json"
SAME = ("curiosity=litman,none", "simulator=planar,pybullet", "engine=python", "picture=false", "report=false",
        "cluster.jobs=2")
SWEEPS = {"short": (*SAME, "seed=0-3", "train_episodes=30", "validation_episodes=6", "max_cycles=300"),
          "kept": (*SAME, "seed=0-2", "train_episodes=200", "validation_episodes=10", "max_cycles=1000",
                   "checkpoint_minutes=0.01")}
KINDS = ("parent", "worker", "group", "forkserver")
KILLS_A_SWEEP = {"short": 6, "kept": 10}
AGAIN = 20  # times that a command is typed until all is done


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kills", type=int, default=200, help="in all, those in the journal included (200)")
    parser.add_argument("--home", type=Path, default=Path("outputs/kills"), help="folder of the campaign, its journal")
    parser.add_argument("--seed", type=int, default=0, help="of the instants and targets (0)")
    parser.add_argument("--publish", action="store_true", help=f"store the sums in {RESULT.relative_to(ROOT)}")
    given = parser.parse_args()
    home = given.home.resolve()
    journal = home / "journal.jsonl"
    home.mkdir(parents=True, exist_ok=True)
    done = [json.loads(line) for line in journal.read_text().splitlines()] if journal.exists() else []
    while sum(len(sweep["kills"]) for sweep in done) < given.kills:
        kind = list(SWEEPS)[len(done) % 2]
        truth = undisturbed(home / f"undisturbed_{kind}", kind)
        found = Campaign(home / f"sweep{len(done)}", kind, random.Random(f"{given.seed} {len(done)}")).run(truth)
        with journal.open("a") as file:
            file.write(json.dumps(found) + "\n")
        done.append(found)
        print(said(sums(done)), file=sys.stderr, flush=True)
    total = sums(done)
    print(said(total))
    if given.publish:
        RESULT.parent.mkdir(parents=True, exist_ok=True)
        RESULT.write_text(json.dumps(total, indent=1) + "\n")
    return int(total["differing_tables"] + total["completed_twice"] + total["unfinished_sweeps"] > 0)


def typed(folder: Path, kind: str) -> subprocess.Popen[bytes]:
    """The command, in this folder, in a session of its own."""
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "said.log").open("ab") as log:
        return subprocess.Popen([sys.executable, "-m", "attnlab", "-m", *SWEEPS[kind]], cwd=folder,
                                stdin=subprocess.DEVNULL, stdout=log, stderr=log, start_new_session=True,
                                env={**os.environ, "PYTHONPATH": str(ROOT)})


def tables(folder: Path) -> dict[str, bytes]:
    return {f"{file.parent.name}/{file.name}": file.read_bytes() for file in folder.glob("outputs/main/*/*.parquet")}


def undisturbed(folder: Path, kind: str) -> dict[str, bytes]:
    """Tables of the same sweep, left alone."""
    if typed(folder, kind).wait():
        raise SystemExit(f"kills: the sweep fails though nobody disturbs it; see {folder / 'said.log'}")
    return tables(folder)


class Campaign:
    """One sweep, typed by several at once, and its kills."""

    def __init__(self, folder: Path, sweep: str, rng: random.Random):
        self.folder, self.sweep, self.rng = folder, sweep, rng
        self.kills: list[dict[str, Any]] = []
        self.completed: dict[str, set[str]] = {}
        self._over = threading.Event()

    def run(self, truth: dict[str, bytes]) -> dict[str, Any]:
        shutil.rmtree(self.folder, ignore_errors=True)
        watcher = threading.Thread(target=self._watch, daemon=True)
        watcher.start()
        copies = [typed(self.folder, self.sweep) for _ in range(self.rng.randint(2, 4))]
        for _ in range(KILLS_A_SWEEP[self.sweep]):
            self._begun()
            time.sleep(self.rng.uniform(0.0, 2.0))
            self._kill(copies)
            copies = [copy if copy.poll() is None else typed(self.folder, self.sweep) for copy in copies]
        for copy in copies:
            copy.wait()
        typings = 1
        while (code := typed(self.folder, self.sweep).wait()) and typings < AGAIN:
            typings += 1
        self._over.set()
        watcher.join()
        made = tables(self.folder)
        differing = sorted(name for name in made.keys() | truth.keys() if made.get(name) != truth.get(name))
        twice = sorted(run for run, tokens in self.completed.items() if len(tokens) > 1)
        left = [path.name for path in self.folder.glob("outputs/main/.claims/*")]
        went_on = sum("went_on_at" in path.read_text() for path in self.folder.glob("outputs/main/*/run.json"))
        if not (differing or twice or code or left):
            shutil.rmtree(self.folder)
        return {"sweep": self.sweep, "went_on": went_on, "copies": len(copies), "kills": self.kills,
                "differing": differing, "twice": twice, "code": code, "typings": typings, "tables": len(truth),
                "runs": len({name.split("/")[0] for name in truth}), "claims_left": left}

    def _begun(self, patience_s: float = 30.0) -> None:
        """Wait until somebody is at work; one kill in six comes before."""
        until = time.monotonic() + patience_s * (self.rng.random() > 1 / 6)
        while not self._claims(None) and time.monotonic() < until:
            time.sleep(0.1)

    def _kill(self, copies: list[subprocess.Popen[bytes]]) -> None:
        """SIGKILL to one of them, and what it cost: runs at work that it had, seconds of each since it began or its
        last checkpoint, and how long until somebody else has them."""
        kind = self.rng.choice(KINDS)
        living = [copy for copy in copies if copy.poll() is None]
        if not living:
            return
        busy = [copy for copy in living if self._claims(copy.pid)]
        copy = self.rng.choice(busy or living)
        below = children(copy.pid)
        servers = [pid for pid, line in below.items() if "forkserver" in line and children(pid)]
        workers = [pid for server in servers for pid in children(server)]
        target = {"worker": workers, "forkserver": servers}.get(kind, [copy.pid])
        if not target:  # it has not begun yet, or has ended
            kind, target = "parent", [copy.pid]
        before = self._claims(copy.pid)
        pid = self.rng.choice(target)
        try:
            (os.killpg if kind == "group" else os.kill)(pid, signal.SIGKILL)
        except ProcessLookupError:
            return
        lost = before if kind in ("parent", "group") else {}
        self.kills.append({"kind": kind, "runs_at_work": len(before), "work_lost_s": [s for _, s in before.values()],
                           "taken_over_s": self._taken_over(lost) if len(living) > 1 else None})

    def _taken_over(self, lost: dict[str, tuple[str, float]], patience_s: float = 3.0) -> float | None:
        """Seconds until the first of these claims is somebody else's; None if nobody was free that soon."""
        begin = time.monotonic()
        while lost and time.monotonic() < begin + patience_s:
            now = self._claims(None)
            if any(key in now and now[key][0] != token for key, (token, _) in lost.items()):
                return time.monotonic() - begin
            time.sleep(0.01)
        return None

    def _claims(self, pid: int | None) -> dict[str, tuple[str, float]]:
        """Of the claims of a process, or of all: key -> token, seconds since its run began or kept a checkpoint."""
        found, main = {}, self.folder / "outputs" / "main"
        runs = {path.name.rpartition("-")[2]: path for path in main.glob("*-*")}
        for path in sorted(main.glob(".claims/*/owner.json")):
            key = path.parent.name.rpartition(".")[0]
            try:
                owner, since = json.loads(path.read_text()), path.stat().st_mtime
            except (OSError, ValueError):
                continue
            if pid in (None, owner["pid"]):
                for file in ("run.json", "checkpoint.json"):  # written when it began, and when it kept one
                    with contextlib.suppress(OSError, KeyError):
                        since = max(since, (runs[key] / file).stat().st_mtime)
                found[key] = (owner["token"], time.time() - since)
        return found

    def _watch(self) -> None:
        """Who completed which run: a second one would be another claim's."""
        while not self._over.wait(0.02):
            for path in self.folder.glob("outputs/main/*/run.json"):
                try:
                    about = json.loads(path.read_text())
                except (OSError, ValueError):
                    continue
                if about.get("status") == "complete":
                    self.completed.setdefault(path.parent.name, set()).add(about["claim"])


def children(pid: int) -> dict[int, str]:
    """Processes right below one, and below those: number -> command line."""
    found = dict[int, str]()
    queue = [pid]
    while queue:
        parent = queue.pop()
        for task in Path(f"/proc/{parent}/task").glob("*/children"):
            try:
                for child in map(int, task.read_text().split()):
                    found[child] = Path(f"/proc/{child}/cmdline").read_text()
                    queue.append(child)
            except OSError:
                continue
    return found


def sums(sweeps: list[dict[str, Any]]) -> dict[str, Any]:
    """What the journal says in all. Older lines name no kind of sweep (they are short), and of lost work they say the
    time since a claim, which is left out."""
    kills = [kill for sweep in sweeps for kill in sweep["kills"]]
    over = sorted(kill["taken_over_s"] for kill in kills if kill["taken_over_s"] is not None)
    of = {kind: [sweep for sweep in sweeps if sweep.get("sweep", "short") == kind] for kind in SWEEPS}
    lost = {kind: sorted(s for sweep in of[kind] for kill in sweep["kills"] if kill["kind"] in ("parent", "group")
                         for s in kill.get("work_lost_s", ())) for kind in SWEEPS}
    return {
        "commands": {kind: f"python -m attnlab -m {' '.join(SWEEPS[kind])}" for kind in SWEEPS},
        "sweeps": {kind: len(of[kind]) for kind in SWEEPS}, "kills": len(kills),
        "kinds": dict(sorted(Counter(kill["kind"] for kill in kills).items())),
        "copies": [min(sweep["copies"] for sweep in sweeps), max(sweep["copies"] for sweep in sweeps)],
        "runs": sum(sweep["runs"] for sweep in sweeps), "tables": sum(sweep["tables"] for sweep in sweeps),
        "differing_tables": sum(len(sweep["differing"]) for sweep in sweeps),
        "completed_twice": sum(len(sweep["twice"]) for sweep in sweeps),
        "unfinished_sweeps": sum(sweep["code"] != 0 for sweep in sweeps),
        "claims_left": sum(len(sweep["claims_left"]) for sweep in sweeps),
        "most_typings_after": max(sweep["typings"] for sweep in sweeps),
        "most_runs_lost_by_a_kill": max((kill["runs_at_work"] for kill in kills), default=0),
        "lost_median_s": {kind: statistics.median(lost[kind]) if lost[kind] else None for kind in SWEEPS},
        "lost_most_s": {kind: max(lost[kind], default=None) for kind in SWEEPS},
        "went_on_from_a_checkpoint": sum(sweep.get("went_on", 0) for sweep in sweeps),
        "taken_over": len(over), "taken_over_median_s": statistics.median(over) if over else None,
        "taken_over_most_s": max(over, default=None)}


def said(total: dict[str, Any]) -> str:
    return (f"{total['kills']} kills in {sum(total['sweeps'].values())} sweeps of {total['runs']} runs: "
            f"{total['differing_tables']} of {total['tables']} tables differ, {total['completed_twice']} runs "
            f"completed twice, {total['unfinished_sweeps']} sweeps not done")


if __name__ == "__main__":
    sys.exit(main())
