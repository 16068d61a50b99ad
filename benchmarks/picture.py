"""The picture of docs/benchmarks.md: side by side, against boxes and behaviours, over commits."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from benchmarks import history
from benchmarks.costs import BEHAVIOURS, BOXES
from benchmarks.run import LIMIT


def draw(every: list[dict[str, Any]], path: Path) -> None:
    """Four panels, as a PNG without the date it was drawn on."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import seaborn as sns
    sns.set_theme(style="whitegrid", context="paper")
    colours, found = sns.color_palette("colorblind"), every[-1]
    figure = plt.figure(figsize=(11, 7), layout="constrained")
    grid = figure.add_gridspec(3, 2, width_ratios=(3, 2))
    _contest(figure.add_subplot(grid[:, 0]), found["contest"], colours[0])
    series = {name: (BOXES, [found["boxes"][f"{name} {n}"] for n in BOXES])
              for name in ("planar", "pybullet", "compiled")}
    _lines(figure.add_subplot(grid[0, 1]), series, "boxes in the world", colours)
    numbers = [len(names) for names in BEHAVIOURS]
    series = {name: (numbers, [found["behaviours"][f"{name} {n}"] for n in numbers]) for name in ("compiled", "python")}
    _lines(figure.add_subplot(grid[1, 1]), series, "behaviours, whole run", colours)
    _commits(figure.add_subplot(grid[2, 1]), every, colours)
    figure.savefig(path, dpi=130, metadata={"Software": None})
    plt.close(figure)


def _contest(axes: Any, contest: dict[str, Any], colour: Any) -> None:
    """Bars on a log scale, with the spread of all rounds."""
    ours = ("compiled", "python", "pybullet", "planar")
    entries = sorted(contest.items(), key=lambda item: float(item[1]["median"]))
    for row, (name, s) in enumerate(entries):
        axes.barh(row, s["median"], color=colour if name.startswith(ours) else "0.6")
        axes.plot((s["least"], s["most"]), (row, row), color="black", linewidth=1)
        axes.text(s["most"] * 1.15, row, f"{s['median']:,.0f}", va="center", fontsize=7)
    axes.set_yticks(range(len(entries)), [name for name, _ in entries])
    axes.set_xscale("log")
    axes.set_xlim(right=entries[-1][1]["most"] * 6)
    axes.set_xlabel("machine cycles a CPU-second (bar: median, line: all rounds)")


def _lines(axes: Any, series: dict[str, tuple[Any, list[dict[str, Any]]]], what: str, colours: Any) -> None:
    for colour, (name, (numbers, speeds)) in zip(colours, series.items(), strict=False):
        axes.plot(numbers, [s["median"] for s in speeds], marker="o", color=colour, label=name)
        axes.fill_between(numbers, [s["least"] for s in speeds], [s["most"] for s in speeds], color=colour, alpha=0.2)
        axes.set_xticks(numbers, [str(n) for n in numbers])
    if max(numbers) > 10:
        axes.set_xscale("log", base=2)
        axes.set_xticks(numbers, [str(n) for n in numbers])
    axes.set_yscale("log")
    axes.set_xlabel(what)
    axes.set_ylabel("cycles a CPU-second")
    axes.legend()


def _commits(axes: Any, every: list[dict[str, Any]], colours: Any) -> None:
    """Shares of the limit, result by result."""
    for colour, name in zip(colours, history.ENTRIES, strict=False):
        shares = [(i, share) for i, one in enumerate(every) if (share := history.share(one, name)) is not None]
        axes.plot([i for i, _ in shares], [share for _, share in shares], marker="o", color=colour, label=name)
    axes.set_yscale("log")
    axes.set_xticks(range(len(every)), [f"{one['code']['commit'][:7]}\n{one['date'][5:10]}" for one in every],
                    fontsize=7)
    axes.set_ylabel(f"share of the {LIMIT}")
    axes.legend(fontsize=6)
