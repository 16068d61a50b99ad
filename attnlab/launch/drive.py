"""From checked jobs to results: what is missing runs, then the summary, the picture, and the next command to type."""

from __future__ import annotations

import shlex
import sys
from collections.abc import Sequence
from pathlib import Path

from attnlab.launch.local import cores, run_jobs
from attnlab.launch.progress import Display
from attnlab.launch.ranges import compact, seeds
from attnlab.launch.study import Job, split


def drive(jobs: Sequence[Job], typed: Sequence[str]) -> int:
    """Run a study; 0 if all of it is complete now, 1 if a run failed. ``typed``: the arguments that asked for it."""
    first = jobs[0].config
    todo, done, reasons = split(jobs, first["fresh"])
    folder = jobs[0].folder.parent
    why = ", ".join(f"{count} {reason}" for reason, count in reasons.items())
    if not done and set(reasons) - {"missing"}:
        print(f"{folder}: no run is complete ({why})")
    if done:
        print(f"{folder}: {len(done)} of {len(jobs)} runs are complete already"
              + (f"; running the other {len(todo)} ({why})" if todo else "; nothing to run")
              + ". fresh=true runs all again.")
    failed = []
    if todo:
        folder.mkdir(parents=True, exist_ok=True)
        at_once = first["cluster"].get("jobs") or cores()
        episodes = sum(job.episodes for job in todo)
        print(f"{folder}: {len(todo)} run{'s' * (len(todo) > 1)}, {episodes:,} episodes, "
              f"{min(at_once, len(todo))} at a time", flush=True)
        with Display(len(todo), episodes) as display:
            run_jobs(todo, at_once, display)
        failed = display.failed
    _show(folder, jobs, first, typed)
    for job, why in failed[:10]:
        print(f"failed: {job.folder}: {why}", file=sys.stderr)
    if failed:
        print(f"{len(failed)} of {len(jobs)} runs failed; the traceback is in run.json of each. The same command runs "
              "them again.", file=sys.stderr)
    return 1 if failed else 0


def _show(folder: Path, jobs: Sequence[Job], config: dict, typed: Sequence[str]) -> None:
    """Figures, summary and hints of what is complete."""
    from attnlab.results.load import Study
    from attnlab.results.summary import print_summary
    study = Study(folder)
    labels = [str(label) for label in config["labels"].values()]
    named = {job.run: job.condition for job in sorted(jobs, key=lambda job: labels.index(job.condition)
                                                      if job.condition in labels else len(labels))}
    if not any(run in named for run in study.complete):
        return
    made: dict[str, Path] = {}
    if config["picture"]:
        from attnlab.report import survival_picture
        made["picture"] = survival_picture(folder)
    if config["report"]:
        made["report"] = _report(folder, config)
    hints = {} if config["report"] else {"next": f"python -m attnlab.report {shlex.quote(str(folder))}"}
    if config["simulator"]["name"] == "planar":
        hints["on pybullet"] = "python -m attnlab " + shlex.join(_on_pybullet(typed, folder.name))
    others = len(set(study.complete) - set(named))
    if others:
        hints["mind"] = (f"{folder} holds {others} more run{'s' * (others > 1)} of other settings, which the picture "
                         "and the report show too; study=NAME keeps studies apart")
    print_summary(study, named, {k: v for k, v in made.items() if v}, hints)


def _on_pybullet(typed: Sequence[str], study: str) -> list[str]:
    """The same arguments for the other robot; seeds as they may be typed."""
    kept = [argument for argument in typed if not argument.startswith(("simulator=", "study="))]
    kept = [f"seed={compact(seeds('seed', a.partition('=')[2]))}" if a.startswith("seed=") else a for a in kept]
    return [*kept, "simulator=pybullet", f"study={study}_pybullet"]


def _report(folder: Path, config: dict) -> Path | None:
    """The study's page. A report that cannot be made loses no result: it says why and how to try again."""
    from attnlab.report import build_report
    try:
        return build_report(folder, claims=config["claims_file"], quiet=True)
    except Exception as cause:  # noqa: BLE001  whatever a measure or figure raises, the results are there
        print(f"no report: {type(cause).__name__}: {cause}. python -m attnlab.report {folder} shows where",
              file=sys.stderr)
    return None
