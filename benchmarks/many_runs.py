"""``python benchmarks/many_runs.py --runs 10000``: what a study of that size costs apart from its robots.

The study is a real one with the shortest runs there can be. Its runs are made one after the other by the code that
makes every run, without the processes that a cluster would bring; each step that a user waits for is a command.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
RESULT = ROOT / "benchmarks" / "results" / "reliability" / "many_runs.json"
CONDITIONS = 10
SHORT = ("simulator=planar", "engine=python", "train_episodes=2", "validation_episodes=1", "max_cycles=20",
         "record=none", "picture=false", "report=false")
PLAN = "import sys, attnlab.launch.drive as d; d._run = lambda todo, folder: []; " \
       "from attnlab.cli.main import main; sys.exit(main(sys.argv[1:]))"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=10_000, help="of the study (10000)")
    parser.add_argument("--home", type=Path, default=Path("outputs/many"), help="folder for it, emptied before")
    parser.add_argument("--report", action="store_true", help="draw its report, too (minutes)")
    parser.add_argument("--publish", action="store_true", help=f"store them in {RESULT.relative_to(ROOT)}")
    given = parser.parse_args()
    home = given.home.resolve()
    shutil.rmtree(home, ignore_errors=True)
    home.mkdir(parents=True)
    alphas = ",".join(f"{0.05 * (i + 1):.2f}" for i in range(CONDITIONS))
    asked = ("-m", *SHORT, f"learner.alpha={alphas}", f"seed=0-{given.runs // CONDITIONS - 1}")
    study = home / "outputs" / "main"
    found: dict[str, Any] = {"runs": given.runs, "conditions": CONDITIONS, "load_before": os.getloadavg()[0],
                             "command": f"python -m attnlab {' '.join(asked)}"}
    found["plan"] = timed(home, "-c", PLAN, *asked)
    found["make"] = timed(home, "-c", "from benchmarks.many_runs import make; import sys; make(sys.argv[1])",
                          str(study))
    files = [path for path in study.rglob("*") if path.is_file()]
    found["files"] = {"number": len(files), "mb": sum(path.stat().st_size for path in files) / 1e6}
    found["watch"] = timed(home, "-m", "attnlab.watch", str(study), "--once")
    found["again"] = timed(home, "-m", "attnlab", *asked)
    found["load"] = timed(home, "-c", f"import attnlab; assert len(attnlab.load({str(study)!r}).episodes) == "
                                      f"{3 * given.runs}")
    if given.report:
        found["report"] = timed(home, "-m", "attnlab.report", str(study))
    print(json.dumps(found, indent=1))
    if given.publish:
        RESULT.parent.mkdir(parents=True, exist_ok=True)
        sizes = {**(json.loads(RESULT.read_text()) if RESULT.exists() else {}), str(given.runs): found}
        RESULT.write_text(json.dumps(dict(sorted(sizes.items(), key=lambda of: int(of[0]))), indent=1) + "\n")
    return 0


def timed(folder: Path, *arguments: str) -> dict[str, float]:
    """Wall and CPU seconds and the most memory (MB) of a Python command. Raises RuntimeError if it fails."""
    begin = time.perf_counter()
    with (folder / "said.log").open("w+") as log:
        process = subprocess.Popen([sys.executable, *arguments], cwd=folder, stdout=log, stderr=log,
                                   env={**os.environ, "PYTHONPATH": str(ROOT)})
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            log.seek(0)
            raise RuntimeError(f"{' '.join(arguments)[:200]}: {log.read()[-500:]}")
    return {"wall_s": time.perf_counter() - begin, "cpu_s": used.ru_utime + used.ru_stime, "mb": used.ru_maxrss / 1000}


def make(study: str) -> None:
    """All runs that a study asks for."""
    from attnlab.launch.asked import jobs_of, study_of
    from attnlab.loading import load_all
    from attnlab.robot.folder import run_to_folder
    load_all()
    folder, file = study_of(study)
    for job in jobs_of(folder, file):
        if not run_to_folder(dict(job.config), job.folder, job.info):
            raise RuntimeError(f"{job.run} failed")


if __name__ == "__main__":
    sys.exit(main())
