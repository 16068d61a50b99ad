"""The table at the end of a study, and the command to type next."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from attnlab.results.load import Study

if TYPE_CHECKING:
    import pandas as pd

FORMS = {"early": ".1%", "late": ".1%", "validation": ".1%", "crashed": ".1%", "energy": ".0f", "safety": ".2f"}


def needs_in(columns: Iterable[str]) -> list[str]:
    """Names of the needs that the table ``episodes`` tells of: hunger, thirst, and those that plugins bring."""
    columns = list(columns)
    return [name for column in columns if column.endswith("_mean") and (name := column[:-5]) not in ("energy", "safety")
            and f"{name}_max" in columns and f"{name}_min" not in columns]


def summary_frame(study: Study, named: Mapping[str, str]) -> pd.DataFrame:
    """One row a condition (pandas frame): means over seeds of survival (early and late half of training, validation),
    needs, activations and safety (all of validation, or of training where there is none). ``named``: the runs to take,
    and what the condition of each is called; rows come in that order."""
    import pandas as pd
    episodes, behaviours = (frame[frame["run"].isin(set(named))] for frame in (study.episodes, study.behaviours))
    episodes = episodes.assign(condition=episodes["run"].map(named))
    behaviours = behaviours.assign(condition=behaviours["run"].map(named))
    rows, names = [], study.behaviours["behaviour"].unique()
    groups, clocks = (dict(list(frame.groupby("condition", sort=False))) for frame in (episodes, behaviours))
    for name in dict.fromkeys(named.values()):
        if name not in groups:
            continue
        group = groups[name]
        train, valid = group[group["phase"] == "train"], group[group["phase"] == "validation"]
        half = (train["episode"].max() + 1) / 2
        shown = valid if len(valid) else train
        acts = clocks[name][clocks[name]["phase"] == shown["phase"].iloc[0]]
        acts = acts.groupby("behaviour", sort=False)["activations"].mean().reindex(names)
        rows.append({
            "condition": name, "runs": group["run"].nunique(),
            "early": train.loc[train["episode"] < half, "survival"].mean(),
            "late": train.loc[train["episode"] >= half, "survival"].mean(),
            "validation": valid["survival"].mean() if len(valid) else float("nan"),
            "crashed": (shown["death"] == "crash").mean(),
            **{need: shown[f"{need}_mean"].mean() for need in needs_in(shown.columns)},
            "energy": shown["energy_mean"].mean(), "safety": shown["safety_mean"].mean(),
            "activations": " ".join(f"{n:.0f}" if n == n else "-" for n in acts)})
    return pd.DataFrame(rows)


def shown(row: Mapping[str, Any]) -> list[str]:
    """A row of the frame as texts; what no run has is a dash."""
    return ["-" if value != value else value if isinstance(value, str) else
            format(value, FORMS.get(key, "" if isinstance(value, int) else ".0f")) for key, value in row.items()]


def print_summary(study: Study, named: Mapping[str, str], made: dict[str, Path], hints: dict[str, str]) -> None:
    """Print the table of the runs in ``named`` (run -> condition), where everything is (``made``: what -> path), and
    what to type next (``hints``: why -> command)."""
    from rich import box
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text
    frame = summary_frame(study, named)
    table = Table(title=Text(f"{study.path.name}: means over seeds"), title_justify="left", box=box.SIMPLE_HEAD,
                  padding=(0, 1), collapse_padding=True, pad_edge=False)
    names = list(study.behaviours["behaviour"].unique())
    heads = {"early": "survival\nearly", "late": "\nlate", "validation": "\nvalid.",
             "activations": "activations\n" + " ".join(names)}
    for key in frame.columns:
        head = heads.get(key, key)
        table.add_column(head, justify="left" if key in ("condition", "activations") else "right", overflow="fold",
                         no_wrap=key != "condition")
    for row in frame.to_dict("records"):
        table.add_row(*map(Text, shown({str(name): value for name, value in row.items()})))
    console = Console(width=None if _is_terminal() else 110)
    console.print(table)
    lines = {"results": study.path, **made, **hints}
    width = max(map(len, lines))
    for what, where in lines.items():
        print(f"{what:{width}}  {where}")


def _is_terminal() -> bool:
    import sys
    return sys.stdout.isatty()
