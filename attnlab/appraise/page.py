"""Table and figure of what models of curiosity make of the same percepts (see :mod:`attnlab.appraise`)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from attnlab.tables.csvs import frame_csv
from attnlab.tables.files import write_bytes

if TYPE_CHECKING:
    import pandas as pd

EARLY, LATE = slice(0, 10), slice(80, 100)


def correlations(table: pd.DataFrame, names: Sequence[str]) -> pd.DataFrame:
    """Spearman correlation of the models' likings over the same views; empty cells where a liking never changes."""
    wide = table.assign(view=table.groupby("curiosity").cumcount()).pivot(index="view", columns="curiosity",
                                                                          values="liking")[list(names)]
    return wide.rank().corr()


def summary(table: pd.DataFrame, probed: Mapping[str, pd.DataFrame], names: Sequence[str]) -> pd.DataFrame:
    """A row a model: its signals over the run, and what the probes make of it."""
    import pandas as pd
    rows = []
    for name in names:
        mine = table[table["curiosity"] == name]
        likes = {probe: frame.loc[frame["curiosity"] == name, "liking"].to_numpy() for probe, frame in probed.items()}
        rows.append({"curiosity": name, "wanting": mine["wanting"].mean(), "liking": mine["liking"].mean(),
                     "sd": mine["liking"].std(), "high liking": (mine["level"] == "HH").mean(),
                     "at first": likes["boredom"][EARLY].mean(), "bored": likes["boredom"][LATE].mean(),
                     "new object": likes["a new object"][100:102].max(), "noise": likes["a noisy sonar"][100:].mean(),
                     "cycle": likes["a cycle"][100:].mean()})
    return pd.DataFrame(rows).set_index("curiosity")


def markdown(frame: pd.DataFrame) -> str:
    """A frame of numbers as a Markdown table."""
    name = frame.index.name
    head = ["" if name is None else str(name), *map(str, frame.columns)]
    lines = ["| " + " | ".join(head) + " |", "|" + " --- |" * len(head)]
    for name, row in frame.iterrows():
        cells = ["" if value != value else f"{value:.2f}" for value in row]
        lines.append("| " + " | ".join([str(name), *cells]) + " |")
    return "\n".join(lines)


def write(table: pd.DataFrame, probed: Mapping[str, pd.DataFrame], names: Sequence[str], out: Path, what: str
          ) -> list[Path]:
    """The three files. ``what``: was shown to the models."""
    together, signals = correlations(table, names), summary(table, probed, names)
    text = "\n\n".join([
        "# What models of curiosity make of the same percepts",
        f"{len(table) // len(names)} looks of {table['behaviour'].nunique()} behaviours. Wanting, liking, its standard "
        f"deviation and the share of looks at level HH are over {what}. The other columns are likings in "
        "the probes: the first 10 of the same view, its 81st to 100th, the first two looks at a new object after 100 "
        "at another, the mean of percepts at random and of percepts in a fixed order, after 100 looks.",
        markdown(signals), "## Rank correlation of the likings",
        "Empty: that liking never changed.", markdown(together)]) + "\n"
    csv, page, figure = out / "appraisal.csv", out / "appraisal.md", out / "appraisal.png"
    write_bytes(csv, frame_csv(table))
    write_bytes(page, text.encode())
    draw(table, probed, names, together, figure)
    return [csv, page, figure]


def draw(table: pd.DataFrame, probed: Mapping[str, pd.DataFrame], names: Sequence[str], together: pd.DataFrame,
         path: Path) -> None:
    """Likings over the episode and in the probes, a row a model, and their correlations."""
    from attnlab.figures.style import BLUE, drawing, save_png
    with drawing():
        import matplotlib.pyplot as plt
        import seaborn as sns
        first = table["behaviour"].iloc[0]
        columns = {f"run: {first}": table[table["behaviour"] == first], **probed}
        figure = plt.figure(figsize=(12.0, 0.62 * len(names) + 7.0))
        halves: Any = figure.subfigures(2, 1, height_ratios=[0.62 * len(names) + 1.0, 6.0])
        upper, lower = halves
        axes = upper.subplots(len(names), len(columns), sharey=True, sharex="col", squeeze=False)
        for i, name in enumerate(names):
            for j, (title, frame) in enumerate(columns.items()):
                mine, panel = frame[frame["curiosity"] == name], axes[i][j]
                panel.plot(mine["cycle"], mine["liking"], color=BLUE, linewidth=1.0)
                panel.set_ylim(-0.05, 1.05)
                panel.set_yticks([0, 1])
                panel.grid(visible=False)
                if i == 0:
                    panel.set_title(title)
            axes[i][0].set_ylabel(name, rotation=0, ha="right", va="center")
        for j, title in enumerate(columns):
            axes[-1][j].set_xlabel("cycle" if title.startswith("run") else "look")
        panel = lower.subplots(1, 1)
        sns.heatmap(together, ax=panel, vmin=-1, vmax=1, cmap="vlag", annot=True, fmt=".1f", annot_kws={"size": 7},
                    cbar_kws={"label": "rank correlation of likings"})
        panel.set(xlabel="", ylabel="")
        save_png(figure, path)
