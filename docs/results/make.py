"""Make the studies of this folder and its page anew.

    python docs/results/make.py                         all studies, then the page: the numbers of README.md beside this
    python docs/results/make.py cr_vs_ncr controls      some of them
    python docs/results/make.py search                  the search for a reading in which the paper is true, an hour
    python docs/results/make.py toys                    the ways on their papers' toys, minutes
    python docs/results/make.py arena --logs FOLDER     the arena; FOLDER holds logs of real robots (docs/logs.md)
    python docs/results/make.py --keep                  go on where it was interrupted
    python docs/results/make.py --page                  no runs: the page from the tables that are here
    python docs/results/make.py --short --outputs DIR --to DIR   does it work? Minutes, numbers mean nothing
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import os
import shutil
import subprocess
import sys
import time
from functools import reduce
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import arena_page  # noqa: E402  a folder of scripts, no package
import arena_study  # noqa: E402
import contrasts  # noqa: E402
import own_tables  # noqa: E402
import page  # noqa: E402
import toys  # noqa: E402
import truth  # noqa: E402
import universe  # noqa: E402
from studies import BY_NAME, SHORT, STUDIES, Study  # noqa: E402

ROOT = HERE.parents[1]
READINGS = "readings.csv"  # of a multiverse: which are sound
FIGURES = ("fig06_survival", "fig07_rewards", "fig09_safety", "fig11_paths", "policies", "attention_economics")


def main() -> int:
    """Entry point; the exit code."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="STUDY", help=f"of {', '.join(BY_NAME)} (all), "
                        "audit, search, toys, arena")
    parser.add_argument("--logs", type=Path, default=Path("logs"), help="where the arena's logs are (logs)")
    parser.add_argument("--outputs", type=Path, default=Path("outputs"), help="where runs are kept (outputs)")
    parser.add_argument("--to", type=Path, default=HERE, help="where tables, figures and page go (beside this script)")
    parser.add_argument("--keep", action="store_true", help="keep what is complete already in the outputs")
    parser.add_argument("--short", action="store_true", help="two seeds of a few short episodes; give --to, too")
    parser.add_argument("--page", action="store_true", help="make no run, write the page alone")
    a = parser.parse_args()
    unknown = sorted(set(a.names) - {*BY_NAME, truth.SEARCH, truth.AUDIT, toys.TOYS, arena_study.NAME})
    if unknown or (a.short and a.to == HERE):
        parser.error(f"there is no study {', '.join(unknown)}" if unknown else "--short needs --to, not these results")
    for study in () if a.page else STUDIES:
        if not a.names or study.name in a.names:
            if study.extra and not a.short and importlib.util.find_spec(study.extra[0]) is None:
                print(f"{study.name} is left out: pip install 'attnlab[{study.extra[1]}]'", file=sys.stderr)
                continue
            minutes = run(study, a.outputs, a.keep, a.short)
            if minutes is None:
                print(f"{study.name} is not complete: nothing of it was copied; --keep goes on", file=sys.stderr)
                return 1
            collect(study, a.outputs / study.name, a.to / study.name, None if a.keep else minutes)
    if not a.page and not truth.make(a.names, a.outputs, a.to):
        print("the search was stopped: nothing of it was copied; the same command goes on", file=sys.stderr)
        return 1
    if not a.page and toys.TOYS in a.names:
        toys.make(a.to, a.short)
    elif a.page:
        toys.write_page(a.to)
    if not a.page and arena_study.NAME in a.names and \
            not arena_study.make(a.outputs, a.to, a.logs, a.keep, a.short):
        print("the arena was not made: nothing of it was copied; --keep goes on", file=sys.stderr)
        return 1
    write_pages(a.to)
    return 0


def run(study: Study, outputs: Path, keep: bool, short: bool) -> float | None:
    """Do the runs of a study and its report; minutes of wall time, None if a run failed."""
    typed = [word for word in study.typed if not (short and word.startswith("seed="))]
    own = {word.partition("=")[0] for word in study.short}
    typed += [*((*(word for word in SHORT if word.partition("=")[0] not in own), *study.short) if short else ()),
              f"outputs={outputs}", *(() if keep else ("fresh=true",))]
    typed += ["report=false", "picture=false"] if study.figures else []  # its page is made when it is collected
    started = time.monotonic()
    done = subprocess.run([sys.executable, "-m", "attnlab", *typed], check=False)
    return (time.monotonic() - started) / 60 if done.returncode == 0 else None


def collect(study: Study, made: Path, target: Path, minutes: float | None = None) -> None:
    """Copy tables and main figures of a study that was made; contrasts, and what it was made with, are written here."""
    import attnlab
    shutil.rmtree(target, ignore_errors=True)
    target.mkdir(parents=True)
    report = made / "report"
    began = sum(os.times()[:4])  # of this process and of those that draw for it
    if study.figures:
        from attnlab.report.build import build
        shutil.rmtree(report, ignore_errors=True)
        build(made, None, None, None, quiet=True, only=study.figures)
    page_cpu_s = sum(os.times()[:4]) - began
    for file in [*sorted(report.glob("*.csv")), made / READINGS, *(report / "figures" / f"{name}.png"
                                                                   for name in (*FIGURES, *study.figures))]:
        if file.exists() and file.stem not in study.leave:
            shutil.copy(file, target)
    if study.page and (report / "index.html").exists():
        shutil.copy(report / "index.html", target / "report.html")
    loaded = attnlab.load(made)
    if study.pairs:
        contrasts.write(target / "contrasts.csv", contrasts.rows(loaded, study.pairs))
    own_tables.write(study.name, loaded, target)
    with_ = made_with(study, loaded, minutes)
    if study.figures:
        with_["page_cpu_s"] = round(page_cpu_s, 1)
    with_ |= universe.pilots(made, attnlab.load)
    (target / "made.json").write_text(json.dumps(with_, indent=1) + "\n")


def made_with(study: Study, loaded: Any, minutes: float | None) -> dict[str, Any]:
    """What a study was made with; one value where all runs agree, else all of them."""
    about = [loaded.about(run) for run in loaded.complete]

    def of(*keys: str) -> Any:
        found = []
        for value in (reduce(lambda node, key: (node or {}).get(key), keys, one) for one in about):
            if value not in found:
                found.append(value)
        return found[0] if len(found) == 1 else found
    return {"command": study.command, "runs": len(about), "asked_for": len(loaded.runs),
            "seeds": int(loaded.runs["seed"].nunique()), "claims_sha256": of("claims", "sha256"),
            "code": {key: of("code", key) for key in ("version", "commit", "dirty", "hash")},
            "python": of("versions", "python"), "cycles": sum(one.get("cycles") or 0 for one in about),
            "cpu_s_of_runs": round(sum(one.get("cpu_s") or 0.0 for one in about)),
            "wall_min": None if minutes is None else round(minutes, 1)}


def write_pages(folder: Path) -> None:
    """README.md of the folder, and where that is this one, what the project's own README says of the results."""
    (folder / "README.md").write_text(page.page(folder))
    if text := arena_page.page(folder):
        (folder / arena_study.NAME / "README.md").write_text(text)
    if folder == HERE:
        readme = ROOT / "README.md"
        readme.write_text(page.readme(readme.read_text(), folder))
    print(f"page     {folder / 'README.md'}")


if __name__ == "__main__":
    sys.exit(main())
