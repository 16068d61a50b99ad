"""``python benchmarks/run.py --page``: docs/benchmarks.md, its picture, and the speeds that other pages name, from what
is stored; a test holds the pages against it. A place for a speed in another page is ``<!-- measured: KIND NAME -->``,
what is written there, ``<!-- end -->``; the kinds are functions below."""

from __future__ import annotations

import json
import re
from typing import Any

from benchmarks import asked, history
from benchmarks.costs import BEHAVIOURS, BOXES
from benchmarks.peers import ELSEWHERE, NOTES
from benchmarks.picture import draw
from benchmarks.run import LIMIT, RESULTS, ROOT

DOCS = ROOT / "docs"
PAGES = ("simulators.md", "engine.md")  # that name speeds
PLACE = re.compile(r"(<!-- measured: (\w+) ([^>]*?) -->).*?(<!-- end -->)")


def publish() -> None:
    """Write them all."""
    every = history.results(RESULTS)
    draw(every, DOCS / "benchmarks.png")
    (DOCS / "benchmarks.md").write_text(page(every))
    for name in PAGES:
        (DOCS / name).write_text(filled((DOCS / name).read_text(), every[-1]))
    print(f"wrote {DOCS / 'benchmarks.md'}, its picture, and the speeds in {' and '.join(PAGES)}")


def filled(text: str, found: dict[str, Any]) -> str:
    """A page with its speeds as they were measured."""
    return PLACE.sub(lambda place: f"{place[1]}{KINDS[place[2]](found, place[3])}{place[4]}", text)


def _us(found: dict[str, Any], name: str) -> str:
    us = 1e6 / found["calls"][name]["median"]
    return f"{us:,.0f} us" if us >= 10 else f"{us:.1f} us" if us >= 1 else f"{us:.2f} us"


def _share(found: dict[str, Any], names: str) -> str:
    one, other = (found["contest"][name.strip()]["median"] for name in names.split("/"))
    return f"1/{other / one:.0f}" if one < other else f"{one / other:.1f} times"


KINDS = {"us": _us, "share": _share, "compile": lambda found, _: f"{asked.compile_s(found):.0f}",
         "warm": lambda found, _: f"{found['starts']['compiled']['wall_s'] - found['starts']['python']['wall_s']:.1f}"}


def page(every: list[dict[str, Any]]) -> str:
    """The page as Markdown, from all results, the newest of which it is about."""
    found, first = every[-1], next(one for one in every if one["file"] == asked.FIRST)
    m, code = found["machine"], found["code"]
    lines = [
        "# Benchmarks", "",
        f"Measured on {found['date'][:16]} (UTC) at commit {code['commit'] or '?'}"
        f"{' with changes' * code['dirty']}, code {code['hash']}, on one core of {m['cpu']} ({m['cores']} cores; load "
        f"{m['load']:.1f} before, {m['load_after']:.1f} after), in {found['minutes']:.0f} minutes; "
        f"{', '.join(f'{name} {version}' for name, version in found['versions'].items())}. A load well above 0 before "
        "says that the machine had other work, and then wall times mean little.", "",
        "![Side by side, against boxes and behaviours, and over commits](benchmarks.png)", "",
        "## Side by side", "",
        f"Machine cycles a CPU-second: median, least and most of {found['rounds']} rounds in which all entries take "
        "turns.", "", *_contest(found), "", *_explained(found),
        "", "## What was asked and what came out", "", *asked.table(found, first),
        "", "## More behaviours, boxes, runs and cores", "", *_costs(found),
        "", "## Starts", "", *_starts(found),
        "", "## Single calls of a simulator", "", "| call | time |", "|---|---:|",
        *(f"| {name} | {_us(found, name)} |" for name in found["calls"]),
        "", "## Where the time of the interpreted loop goes", "",
        "Shares of a profiled run on planar (profiling makes small calls dearer than they are):", "",
        "| part | share |", "|---|---:|", *(f"| {part} | {share:.0%} |" for part, share in
                                            list(found["profile"].items())[:10]),
        "", "## Over commits", "", f"Shares of the {LIMIT} of the same result:", "", *history.table(every), "",
        *HISTORY, "", "## Tried and measured", "", *_tried()]
    return "\n".join(lines) + "\n"


HISTORY = (
    "`python benchmarks/run.py` adds a result, a JSON file in benchmarks/results; with `--page` it makes this page of",
    "all there are. It is no asv: asv builds each commit in an environment of its own, which takes minutes where",
    "pybullet is compiled, measures one commit after the other, and compares seconds. Here a kernel without Python,",
    "peers and both engines take turns in the same minutes, and what is compared over commits is their ratio,",
    "which other work on the machine, or another machine, changes least.")


def _contest(found: dict[str, Any]) -> list[str]:
    contest = found["contest"]
    limit, python = contest[LIMIT]["median"], contest["python, whole run"]["median"]
    lines = ["| | median | least | most | of the kernel | times python |", "|---|---:|---:|---:|---:|---:|"]
    lines += [f"| {name} | {s['median']:,.0f} | {s['least']:,.0f} | {s['most']:,.0f} | {s['median'] / limit:.4f} | "
              f"{s['median'] / python:.3f} |" for name, s in contest.items()]
    lines += [f"| {name} | {why} | | | | |" for name, why in {**found["missing"], **ELSEWHERE}.items()]
    lines += [f"| {name}, published | {one['steps_a_second']:,} | | | | |" for name, one in _published().items()]
    return lines


def _published() -> dict[str, Any]:
    published: dict[str, Any] = json.loads((ROOT / "benchmarks" / "published.json").read_text())
    return published


def _explained(found: dict[str, Any]) -> list[str]:
    reads = found["reads_a_cycle"]
    return [
        "A whole run is AVOID, EAT and DRINK with Litman's curiosity and Q-learning in the paper's world: sensing, "
        "learning, needs, checked identities, and all tables; starting the process is left out. *Compiled* and *python*"
        " are the two engines on planar; the loop alone makes no tables. *Sensors and motion only* and the fused kernel"
        f" read and move as often as a run does ({reads['sonar']:.2f} sonar readings, {reads['blobs']:.2f} images, "
        f"{reads['advance']:.2f} motions a cycle) with control of two lines; in the fused kernel that control is "
        "compiled too, no Python is left, and nothing is learned or written down. Peers do the nearest work "
        "they offer:",
        "", *(f"- {name}: {note}." for name, note in NOTES.items() if name in found["contest"]),
        *(f"- {name}: {one['what']}; {one['source']}." for name, one in _published().items())]


def _costs(found: dict[str, Any]) -> list[str]:
    speed = {name: s["median"] for series in ("behaviours", "boxes") for name, s in found[series].items()}
    lines = ["Cycles a CPU-second of whole runs on planar, by behaviours:", "",
             "| behaviours | python | compiled |", "|---|---:|---:|"]
    lines += [f"| {', '.join(names)} | {speed[f'python {len(names)}']:,.0f} | {speed[f'compiled {len(names)}']:,.0f} |"
              for names in BEHAVIOURS]
    lines += ["", "By boxes, in a floor of 3 m2 a cube: sensors and motion only, and whole compiled runs on planar.",
              "", "| boxes | planar | pybullet | whole run, compiled |", "|---:|---:|---:|---:|"]
    lines += [f"| {n} | {speed[f'planar {n}']:,.0f} | {speed[f'pybullet {n}']:,.0f} | {speed[f'compiled {n}']:,.0f} |"
              for n in BOXES]
    if "runs" not in found:
        return [*lines, "", "Runs and cores were not measured in this result."]
    lines += ["", "Studies of compiled runs of 30 episodes without a report, all cores, as processes (`cluster=local`) "
              "and over threads:", "", "| cluster | runs | wall s | CPU s | CPU s a run |", "|---|---:|---:|---:|---:|"]
    lines += [f"| {cluster} | {n} | {t['wall_s']:.1f} | {t['cpu_s']:.1f} | {t['cpu_s'] / t['runs']:.2f} |"
              for cluster, row in found["runs"].items() for n, t in row.items()]
    some = found["cores"]["local"]["1"]["runs"]
    lines += ["", f"The same {some} runs of 600 episodes, by how many are done side by side:", "",
              "| cluster | at once | wall s | CPU s | times one |", "|---|---:|---:|---:|---:|"]
    lines += [f"| {cluster} | {n} | {t['wall_s']:.1f} | {t['cpu_s']:.1f} | {row['1']['wall_s'] / t['wall_s']:.2f} |"
              for cluster, row in found["cores"].items() for n, t in row.items()]
    return lines


def _starts(found: dict[str, Any]) -> list[str]:
    told = {**found["starts"], **{f"study on {name}": t for name, t in found.get("study", {}).items()}}
    mem = found["memory"]
    return ["| | command | wall s | CPU s | load before |", "|---|---|---:|---:|---:|",
            *(f"| {name} | `{t['command']}` | {t['wall_s']:.1f} | {t['cpu_s']:.1f} | {t['load_before']:.1f} |"
              for name, t in told.items()), "",
            "CPU seconds are those of all processes. *Cold start* and *first compile* begin with an empty cache; "
            "*python* and *compiled* find theirs filled.", "",
            f"Resident memory of an interpreted run of {mem['episodes']:,} episodes: {mem['mb_after_a_fifth']:.0f} MB "
            f"after a fifth of it, {mem['mb_at_the_end']:.0f} MB at its end; all entries above are loaded in that "
            "process."]


def _tried() -> list[str]:
    tried = json.loads((ROOT / "benchmarks" / "tried.json").read_text())
    return ["| what | predicted | came out | |", "|---|---|---|---|",
            *(f"| {one['what']} | {one['predicted']} | {one['came_out']} | {'kept' if one['kept'] else 'dropped'} |"
              for one in tried)]
