"""From checked jobs to results: what is missing runs, then the summary, the picture, and the next command to type."""

from __future__ import annotations

import shlex
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from attnlab.config import COSMETIC, RunSettings
from attnlab.launch import engines, robots
from attnlab.launch.jobs import OTHER_CODE, Job, split
from attnlab.launch.progress import Display
from attnlab.loading import plugin_hashes, plugin_versions
from attnlab.registry import make
from attnlab.results.old import recovered
from attnlab.robot.keeping import CHECKPOINT
from attnlab.robot.recorded import told_of
from attnlab.tables.claim import clear
from attnlab.tables.code import code
from attnlab.tables.ranges import compact, seeds
from attnlab.tables.study import FILE, Condition, grow

if TYPE_CHECKING:
    from attnlab.results.load import Study


def drive(jobs: Sequence[Job], typed: Sequence[str]) -> int:
    """Run a study; 0 if all of it is complete now, 1 if a run failed. ``typed``: the arguments that asked for it."""
    settings, folder = jobs[0].settings, jobs[0].folder.parent
    failed = complete(jobs, typed)
    _show(folder, jobs, settings, typed)
    if failed:
        print(f"{len(failed)} of {len(jobs)} runs failed; the traceback is in run.json of each. The same command runs "
              "them again.", file=sys.stderr)
    return 1 if failed else 0


def complete(jobs: Sequence[Job], typed: Sequence[str]) -> list[tuple[Job, str]]:
    """Run what is missing of a study; the runs that failed now, and why."""
    todo, done, reasons, old = split(jobs, jobs[0].settings.fresh)
    engines.prepare(todo)
    _ask(jobs, typed)
    clear(jobs[0].folder.parent, {job.key for job in done})
    if jobs[0].settings.fresh:
        for job in todo:
            (job.folder / CHECKPOINT).unlink(missing_ok=True)
    folder = jobs[0].folder.parent
    why = ", ".join(f"{count} {reason}" for reason, count in reasons.items())
    if not done and set(reasons) - {"missing"}:
        print(f"{folder}: no run is complete ({why})")
    if done:
        print(f"{folder}: {len(done)} of {len(jobs)} runs are complete already"
              + (f"; running the other {len(todo)} ({why})" if todo else "; nothing to run")
              + ". fresh=true runs all again.")
    if old:
        print(f"mind: {len(old)} of the complete runs were {OTHER_CODE} than this ({code()['version']} "
              f"{code()['hash']}); numbers of both would stand side by side. fresh=true makes all of them anew.",
              file=sys.stderr)
    return _run(todo, folder) if todo else []


def _ask(jobs: Sequence[Job], typed: Sequence[str]) -> None:
    """Write down what is asked for, before any of it runs."""
    folder = jobs[0].folder.parent
    asked: dict[str, tuple[Condition, list[tuple[str, str, int]]]] = {}
    for job in jobs:
        asked.setdefault(job.of.key, (job.of, []))[1].append((job.run, job.key, job.settings.seed))
    before = recovered(folder) if folder.is_dir() and not (folder / FILE).exists() else None
    study = grow(folder, as_typed(typed), list(asked.values()), jobs[0].settings.labels, _code(jobs), jobs[0].claims,
                 before, {name: jobs[0].config[name] for name in sorted(COSMETIC) if name in jobs[0].config})
    names = {condition.key: condition.name for condition in study.conditions}
    homes = {run.key: run.name for run in study.runs}
    for job in jobs:
        job.of.name = names[job.of.key]
        job.folder = folder / homes[job.key]  # another command may have named the run already


def _code(jobs: Sequence[Job]) -> dict[str, Any]:
    """The code that is to run: ours, files of ``plugins`` and versions of ``packages`` that a condition names."""
    plugins, packages = {}, {}
    for config in {job.of.key: job.config for job in jobs}.values():
        plugins.update(plugin_hashes(config))
        packages.update(plugin_versions(config))
    return {**code(), **({"plugins": plugins} if plugins else {}), **({"packages": packages} if packages else {})}


def _run(todo: Sequence[Job], folder: Path) -> list[tuple[Job, str]]:
    """Run what is missing; the failed ones and why."""
    cluster = make("cluster", todo[0].settings.cluster, None)
    episodes = sum(job.episodes for job in todo)
    print(f"{folder}: {len(todo)} run{'s' * (len(todo) > 1)}, {episodes:,} episodes, "
          f"{cluster.at_once(todo)} at a time", flush=True)
    if line := robots.at_start(todo):
        print(line, flush=True)
    for line in dict.fromkeys(line for job in todo for line in told_of(job.plan)):
        print(f"attnlab: {line}", file=sys.stderr, flush=True)
    with Display(len(todo), episodes, getattr(cluster.params, "stop_after", 0)) as display:
        cluster.run(todo, display)
    display.print_failed(folder)
    return display.failed


def _show(folder: Path, jobs: Sequence[Job], settings: RunSettings, typed: Sequence[str]) -> None:
    """Figures, summary and hints of what is complete."""
    from attnlab.report import statements_of
    from attnlab.results.load import Study
    from attnlab.results.summary import print_summary
    study = Study(folder)
    mine = {job.run for job in jobs}
    named = {run: name for run, name in study.named().items() if run in mine}
    if not named:
        return
    made: dict[str, Path] = {}
    said = ""
    if settings.picture:
        from attnlab.report import survival_picture
        print("drawing the picture", file=sys.stderr, flush=True)
        made["picture"] = survival_picture(study)
    if settings.report:
        page = _report(study, settings)
        made |= {"report": page} if page else {}
        said = statements_of(page) if page else ""
    hints = {"found": said} if said else {}
    if not settings.report:
        hints["next"] = f"python -m attnlab.report {shlex.quote(str(folder))}"
    hints |= robots.at_end(jobs, as_typed(typed))
    others = len(study.complete) - len(named)
    if others:
        hints["mind"] = (f"{folder} holds {others} more run{'s' * (others > 1)} of other settings, which the picture "
                         "and the report show too; study=NAME keeps studies apart")
    print_summary(study, named, made, hints)


def as_typed(typed: Sequence[str]) -> list[str]:
    """Arguments as they may be typed again, runs of seeds as such."""
    return [f"seed={compact(seeds('seed', a.partition('=')[2]))}" if a.startswith("seed=") else a for a in typed]


def _report(study: Study, settings: RunSettings) -> Path | None:
    """The study's page. A report that cannot be made loses no result: it says why and how to try again."""
    from attnlab.report import build_report
    from attnlab.report.steps import Steps
    try:
        with Steps("drawing the report", "figures") as steps:
            return build_report(study, claims=settings.claims_file, quiet=True, tell=steps)
    except Exception as cause:  # noqa: BLE001  whatever a measure or figure raises, the results are there
        print(f"no report: {type(cause).__name__}: {cause}. python -m attnlab.report {study.path} shows where",
              file=sys.stderr)
    return None
