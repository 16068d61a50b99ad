"""``python benchmarks/reliability.py``: docs/reliability.md from stored figures; a test holds the page against them.

    python benchmarks/kills.py --kills 500 --publish
    python benchmarks/claims.py --publish
    python benchmarks/many_runs.py --runs 1000 --publish     and --runs 10000
    python benchmarks/reliability.py --bytes      the same runs by both engines, on each Python that is there
    python benchmarks/reliability.py --count      count the bad inputs that the tests try, and write the page
"""

from __future__ import annotations

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))
RESULTS = ROOT / "benchmarks" / "results" / "reliability"
PAGE, CLUSTERS = ROOT / "docs" / "reliability.md", ROOT / "docs" / "clusters.md"
BEGIN, END = "<!-- many runs: by python benchmarks/reliability.py -->\n", "<!-- end -->"
BAD = {"command lines and settings": ["tests/system/test_bad_input.py"],
       "results folders": ["tests/results/test_hostile_folders.py"],
       "plugins": ["tests/plugins/test_bad_plugins.py"],
       "logs of robots": ["tests/logs/test_hostile.py"],
       "terminals, systems, disks, configs of strangers": ["tests/system/test_faults.py"]}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", action="store_true", help="count the bad inputs anew")
    parser.add_argument("--bytes", action="store_true", help="compare engines, Pythons and processors anew (minutes)")
    given = parser.parse_args()
    RESULTS.mkdir(parents=True, exist_ok=True)
    if given.count:
        (RESULTS / "bad_inputs.json").write_text(json.dumps(counted(), indent=1) + "\n")
    if given.bytes:
        (RESULTS / "bytes.json").write_text(json.dumps(compared(), indent=1) + "\n")
    PAGE.write_text(page())
    CLUSTERS.write_text(clusters(CLUSTERS.read_text()))
    print(f"wrote {PAGE} and the table of {CLUSTERS}")
    return 0


def counted() -> dict[str, int]:
    """Cases of the tables of bad input, by what they are about."""
    found = dict[str, int]()
    for about, files in BAD.items():
        done = subprocess.run([sys.executable, "-m", "pytest", "--collect-only", "-q", *files], cwd=ROOT, text=True,
                              capture_output=True, env={**os.environ, "PYTHONPATH": str(ROOT)})
        found[about] = Counter(bool(re.match(r"tests/.+::", line)) for line in done.stdout.splitlines())[True]
    from tests.results.test_hostile_folders import FIELDS, VALUES, WHOLE
    found["results folders"] += len(FIELDS) * len(VALUES) + len(WHOLE) - 1  # one test tries them all
    return found


def compared() -> dict[str, Any]:
    """Python -> engine and processor -> whether the short runs of the tests have the golden bytes."""
    from tests.system import short_runs, test_bytes
    found: dict[str, Any] = {"runs": len(short_runs.RUNS), "compiled": len(short_runs.COMPILED), "table": {}}
    for version in test_bytes.VERSIONS:
        python = test_bytes.interpreter(version)
        if python is not None:
            with tempfile.TemporaryDirectory() as name:
                folder = Path(name)
                found["table"][version] = test_bytes.table(test_bytes.installed(python, folder), folder / "cache")
    return found


def stored(name: str) -> dict[str, Any] | None:
    file = RESULTS / f"{name}.json"
    return json.loads(file.read_text()) if file.exists() else None


def page() -> str:
    """The whole page as Markdown."""
    lines = ["# Reliability", "", "What was done to sweeps, and what came of it. Figures are stored in "
             "benchmarks/results/reliability and put here by `python benchmarks/reliability.py`.", ""]
    for name, section in (("kills", _kills), ("bad_inputs", _inputs), ("claims", _claims), ("many_runs", _many),
                          ("bytes", _bytes)):
        found = stored(name)
        lines += section(found) if found else []
    return "\n".join([*lines, *SUPPORT]) + "\n"


def clusters(text: str) -> str:
    """The page of clusters with its table of many runs anew."""
    found = stored("many_runs")
    table = "\n".join(_many(found)[2:] if found else [])
    return re.sub(f"(?<={re.escape(BEGIN)}).*?(?={re.escape(END)})", lambda _: table, text, flags=re.S)


def _kills(k: dict[str, Any]) -> list[str]:
    kinds = ", ".join(f"{n} of a {kind}" for kind, n in k["kinds"].items())
    over = "" if k["taken_over_median_s"] is None else (
        f" In {k['taken_over']} of them another command was free within 3 s and had one of the dead one's runs after "
        f"{k['taken_over_median_s']:.2f} s (median; longest {k['taken_over_most_s']:.2f} s).")
    lost = {kind: (k["lost_median_s"][kind], k["lost_most_s"][kind]) for kind in k["sweeps"]}
    return [
        "## Killed at random", "", "    python benchmarks/kills.py --kills 500 --publish", "",
        f"{k['kills']} kills ({kinds}) with SIGKILL in {sum(k['sweeps'].values())} sweeps, half of their runs on "
        f"pybullet: {k['sweeps']['short']} of 16 short runs, and {k['sweeps']['kept']} of 12 longer ones that kept a "
        f"checkpoint every 0.6 s. Each "
        f"sweep was typed by {k['copies'][0]} to {k['copies'][1]} commands at once, and commands that died were typed "
        f"again. The campaign keeps a journal and can itself be interrupted.", "",
        "| | |", "|---|---:|",
        f"| tables compared with those of an undisturbed sweep | {k['tables']:,} |",
        f"| tables that differ | {k['differing_tables']} |",
        f"| runs completed twice | {k['completed_twice']} of {k['runs']:,} |",
        f"| sweeps that did not end complete | {k['unfinished_sweeps']} of {sum(k['sweeps'].values())} |",
        f"| runs that went on from a checkpoint | {k['went_on_from_a_checkpoint']} |",
        f"| claims left behind | {k['claims_left']} |",
        f"| most runs at work that one kill cost | {k['most_runs_lost_by_a_kill']} |",
        f"| work that one of them had done since it began | median {lost['short'][0]:.1f} s, most "
        f"{lost['short'][1]:.1f} s |",
        f"| the same with checkpoints, since the last | median {lost['kept'][0]:.1f} s, most {lost['kept'][1]:.1f} s |",
        "",
        "A run costs at most what was done since its last checkpoint, or all of a short one; one is kept after the "
        f"episode in which its time comes. Seconds are those of a clock on the wall, on a machine with other work."
        f"{over}", ""]


def _inputs(found: dict[str, int]) -> list[str]:
    rows = [f"| {about} | {count} |" for about, count in found.items()]
    return ["## Bad input", "", f"{sum(found.values())} bad inputs are tried by the tests, each with what it must come "
            "to: a line that names the setting, exit code 2 and nothing written; or a run that failed, is named, and "
            "takes no other with it. None ends in a traceback.", "",
            "    python -m pytest " + " ".join(file for files in BAD.values() for file in files), "",
            "| about | cases |", "|---|---:|", *rows, ""]


def _claims(found: dict[str, Any]) -> list[str]:
    rows = [f"| {engine} | {of['run_cpu_s']:.2f} | {of['beats']} | {1000 * of['claim_cpu_s']:.2f} | {of['share']:.2%} |"
            for engine, of in found["engines"].items()]
    return ["## What claims cost", "", "    python benchmarks/claims.py --publish", "",
            f"A run of 600 episodes, with {found['others']} claims of others beside its own. Signs of life are given "
            "every 5 s.", "", "| engine | CPU s of the run | signs of life | CPU ms of its claim | share |",
            "|---|---:|---:|---:|---:|", *rows, ""]


def _many(sizes: dict[str, Any]) -> list[str]:
    """The largest study that was measured, and how much memory smaller ones took."""
    *smaller, m = sizes.values()
    what = {"plan": "planning: composed, checked, written down", "make": "the runs themselves, in one process",
            "watch": "`watch --once`", "again": "the same command when all is done: each table's mark checked, summary",
            "load": "`attnlab.load(...).episodes`", "report": "the report"}
    rows = [f"| {text} | {m[name]['wall_s']:.1f} | {m[name]['cpu_s']:.1f} | {m[name]['mb']:,.0f} |"
            + "".join(f" {of[name]['mb']:,.0f} |" for of in smaller) for name, text in what.items() if name in m]
    return [f"## A study of {m['runs']:,} runs", "",
            f"    python benchmarks/many_runs.py --runs {m['runs']} --publish", "",
            f"{m['conditions']} conditions of {m['runs'] // m['conditions']:,} seeds, with the shortest runs there can "
            f"be; {m['files']['number']:,} files, {m['files']['mb']:,.0f} MB. The load of the machine was "
            f"{m['load_before']:.1f} when it began.", "", "| step | wall s | CPU s | most memory, MB |"
            + "".join(f" of {of['runs']:,} runs, MB |" for of in smaller),
            "|---|---:|---:|---:|" + "---:|" * len(smaller), *rows, ""]


def _bytes(b: dict[str, Any]) -> list[str]:
    ways = list(next(iter(b["table"].values())))
    rows = [f"| {version} | {' | '.join(of[way] for way in ways)} |" for version, of in b["table"].items()]
    return ["## The same bytes", "", "    python benchmarks/reliability.py --bytes", "",
            f"{b['runs']} short runs, some of each part, by Python, and {b['compiled']} of them compiled, on a "
            "processor as it is and as numba's `generic`, which has no extensions; against the golden digests of the "
            "tests.", "",
            f"| Python | {' | '.join(ways)} |", "|---|" + "---|" * len(ways), *rows, ""]


SUPPORT = """## What is supported

Linux, Python 3.11 to 3.13; that is what the tests run on. macOS has all that the code asks for (fork server, file
locks, signals) and is not tested. Windows has no fork server and no SIGTERM: runs start as fresh processes there, a
stop from outside gives no claim back until it is 120 s silent, and it is not tested either. Where a process may map
less than 4 GB (`ulimit -v`), runs start as fresh processes too; with less than 1 GB a command says so and stops.
""".splitlines()


if __name__ == "__main__":
    sys.exit(main())
