"""docs/benchmarks.md and its figure, from the newest stored result."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from benchmarks.peers import NOTES
from benchmarks.run import BOXES, LIMIT, LOOP, ROOT

PREDICTED = (  # written before the first measurement, from the figures of earlier trials on another machine
    ("planar, whole loop: at least 120,000", lambda c: c[LOOP]["median"], 120_000),
    ("pybullet, whole loop: at least 10,000", lambda c: c["attnlab pybullet, whole loop"]["median"], 10_000),
    ("planar at least 1/12 of the fused kernel", lambda c: c[LOOP]["median"] / c[LIMIT]["median"], 1 / 12),
    ("planar at least 300 times ir-sim", lambda c: c[LOOP]["median"] / c["ir-sim"]["median"], 300),
)


def publish(results: Path) -> None:
    """Write the page and its figure."""
    stored = sorted(results.glob("*.json"))
    if not stored:
        raise SystemExit(f"benchmarks: nothing is stored in {results}; run python benchmarks/run.py first")
    found = json.loads(stored[-1].read_text())
    docs = ROOT / "docs"
    docs.mkdir(exist_ok=True)
    draw(found, docs / "benchmarks.png")
    (docs / "benchmarks.md").write_text(page(found, stored[-1].name))
    print(f"wrote {docs / 'benchmarks.md'}")


def page(found: dict[str, Any], source: str) -> str:
    """The page as Markdown."""
    contest, m = found["contest"], found["machine"]
    whole = contest[LOOP]["median"]
    lines = [
        "# Benchmarks", "",
        f"Machine cycles a CPU-second on one core of {m['cpu']} ({m['cores']} cores, load {m['load']:.1f} at the end), "
        f"median, least and most of {found['rounds']} rounds in which all entries take turns; "
        f"{', '.join(f'{k} {v}' for k, v in found['versions'].items())}. Made by `python benchmarks/run.py`, stored in "
        f"benchmarks/results/{source}, written by `python benchmarks/run.py --publish`.", "",
        "![Machine cycles a CPU-second, and against the number of boxes](benchmarks.png)", "",
        "| | median | least | most | times planar's loop |", "|---|---:|---:|---:|---:|"]
    lines += [f"| {name} | {s['median']:,.0f} | {s['least']:,.0f} | {s['most']:,.0f} | {s['median'] / whole:.3f} |"
              for name, s in contest.items()]
    lines += [f"| {name} | {why} | | | |" for name, why in found["missing"].items()]
    reads = found["reads_a_cycle"]
    lines += [
        "", "A whole loop is AVOID, EAT and DRINK with Litman's curiosity and Q-learning in the paper's world: "
        "sensing, learning, needs, checked identities, and all tables; starting the process is left out. *Sensors and "
        "motion only* and the fused kernel read and move as often as that loop does "
        f"({reads['sonar']:.2f} sonar readings, {reads['blobs']:.2f} images, {reads['advance']:.2f} motions a cycle) "
        "with control of two lines; in the fused kernel that control is compiled too, and no Python is left. Peers do "
        "the nearest work they offer, without learning:", ""]
    lines += [f"- {name}: {note}." for name, note in NOTES.items()]
    lines += ["", "## What was predicted and what came out", "", "| prediction | came out | |", "|---|---|---|"]
    for text, value, least in PREDICTED:
        try:
            got = value(contest)
        except KeyError:
            lines.append(f"| {text} | not measured | |")
            continue
        shown = f"1/{1 / got:.1f}" if got < 1 else f"{got:,.0f}"
        lines.append(f"| {text} | {shown} | {'holds' if got >= least else '**does not hold**'} |")
    p, help_s = found["parallel"], found["commands"]["help"]["wall_s"]
    tries = ", ".join(f"{t:.2f}" for t in p["tries"])
    lines += [
        f"| two processes at least 0.9 of twice one | {p['efficiency']:.2f} (tries {tries}; a CPU-second "
        f"{p['efficiency_cpu']:.2f}; load before {p['load_before']:.1f}) | "
        f"{'holds' if p['efficiency'] >= 0.9 else '**does not hold**'} |",
        f"| --help under 1 s | {help_s:.2f} s | {'holds' if help_s < 1 else '**does not hold**'} |"]
    if "study" in found["commands"]:
        study_s = found["commands"]["study"]["wall_s"]
        verdict = "holds" if study_s < 180 else "**does not hold**"
        lines.append(f"| full study under 180 s | {study_s:.0f} s | {verdict} |")
    else:
        lines.append("| full study under 180 s | not measured in this result (`--study`) | |")
    lines += ["", "## Where the time of planar's loop goes", "",
              "Shares of a profiled run (profiling makes small calls dearer than they are):", "",
              "| part | share |", "|---|---:|"]
    lines += [f"| {part} | {share:.0%} |" for part, share in list(found["profile"].items())[:14]]
    lines += ["", "## Against the number of boxes", "", "Sensors and motion only, in a floor of 3 m2 a cube.", "",
              "| boxes | planar | pybullet |", "|---:|---:|---:|"]
    speed = {name: s["median"] for name, s in found["boxes"].items()}
    lines += [f"| {n} | {speed[f'planar {n}']:,.0f} | {speed[f'pybullet {n}']:,.0f} |" for n in BOXES]
    mem = found["memory"]
    lines += ["", "## Memory and commands", "",
              f"Resident memory of a run of {mem['episodes']:,} episodes: {mem['mb_after_a_fifth']:.0f} MB after a "
              f"fifth of it, {mem['mb_at_the_end']:.0f} MB at its end; all entries above are loaded in that process.",
              "",
              "| command | wall s | CPU s | load before, after |", "|---|---:|---:|---|"]
    lines += [f"| `{c['command']}` | {c['wall_s']:.1f} | {c['cpu_s']:.1f} | {c['load_before']:.1f}, "
              f"{c['load_after']:.1f} |" for c in found["commands"].values()]
    lines += ["", "Wall times, and the efficiency of two processes, mean what they say only on a machine that does "
              "nothing else: a load before them well above 0 says that it did.", "",
              (ROOT / "benchmarks" / "notes.md").read_text().strip()]
    return "\n".join(lines) + "\n"


def draw(found: dict[str, Any], path: Path) -> None:
    """Two panels: the contest on a log scale with its spread, and speed against boxes."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import seaborn as sns
    sns.set_theme(style="whitegrid", context="paper")
    blue, grey = sns.color_palette("colorblind")[0], "0.6"
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), width_ratios=(3, 2), layout="constrained")
    contest = sorted(found["contest"].items(), key=lambda item: item[1]["median"])
    for row, (name, s) in enumerate(contest):
        left.barh(row, s["median"], color=blue if name.startswith("attnlab") else grey)
        left.plot((s["least"], s["most"]), (row, row), color="black", linewidth=1)
        left.text(s["most"] * 1.15, row, f"{s['median']:,.0f}", va="center", fontsize=7)
    left.set_yticks(range(len(contest)), [name for name, _ in contest])
    left.set_xscale("log")
    left.set_xlim(right=contest[-1][1]["most"] * 6)
    left.set_xlabel("machine cycles a CPU-second (bar: median, line: all rounds)")
    for name, colour in (("planar", blue), ("pybullet", sns.color_palette("colorblind")[1])):
        speeds = [found["boxes"][f"{name} {n}"] for n in BOXES]
        right.plot(BOXES, [s["median"] for s in speeds], marker="o", color=colour, label=name)
        right.fill_between(BOXES, [s["least"] for s in speeds], [s["most"] for s in speeds], color=colour, alpha=0.2)
    right.set_xscale("log", base=2)
    right.set_yscale("log")
    right.set_xticks(BOXES, [str(n) for n in BOXES])
    right.set_xlabel("boxes in the world")
    right.set_ylabel("sensors and motion only, cycles a CPU-second")
    right.legend()
    figure.savefig(path, dpi=150)
