"""The table at the end of a study, and the command to type next."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from attnlab.console import table_width
from attnlab.results.load import Study
from attnlab.tables.numbers import kept, needs_in

if TYPE_CHECKING:
    import pandas as pd
    from rich.table import Table

MOST = 40  # conditions of which a table in the terminal can be read
EDGES = 3  # characters of a table that no column has
FORMS = {"early": ".1%", "late": ".1%", "validation": ".1%", "crashed": ".1%", "energy": ".0f", "safety": ".2f"}


def summary_frame(study: Study, named: Mapping[str, str]) -> pd.DataFrame:
    """One row a condition (pandas frame): means over seeds of survival (early and late half of training, validation),
    needs, activations and safety (all of validation, or of training where there is none). ``named``: the runs to take,
    and what the condition of each is called; rows come in that order. From the numbers in run.json where all runs have
    them, else from the tables."""
    import pandas as pd
    rows = []
    names = behaviours_of(study, named)
    for name in dict.fromkeys(named.values()):
        runs = [run for run, of in named.items() if of == name]
        numbers = [found for run in runs if (found := kept(study.about(run))) is not None]
        if len(numbers) < len(runs):
            return _from_tables(study, named)
        needs = dict.fromkeys(need for n in numbers for need in n["needs"])
        acts = [_mean([n["activations"].get(behaviour) for n in numbers]) for behaviour in names]
        rows.append({
            "condition": name, "runs": len(runs),
            **{key: _mean([n[key] for n in numbers]) for key in ("early", "late", "validation", "crashed")},
            **{need: _mean([n["needs"].get(need) for n in numbers]) for need in needs},
            **{key: _mean([n[key] for n in numbers]) for key in ("energy", "safety")},
            "activations": " ".join(f"{n:.0f}" if n == n else "-" for n in acts)})
    return pd.DataFrame(rows)


def behaviours_of(study: Study, named: Mapping[str, str]) -> list[str]:
    """The behaviours of these runs, in the order in which they come first."""
    found = dict.fromkeys(name for run in named for name in study.condition(run).config.get("behaviours", {}))
    return list(found or study.behaviours["behaviour"].unique())


def _mean(values: Sequence[float | None]) -> float:
    found = [value for value in values if value is not None]
    return sum(found) / len(found) if found else float("nan")


def _from_tables(study: Study, named: Mapping[str, str]) -> pd.DataFrame:
    """The same for runs of versions that kept no numbers."""
    import pandas as pd
    episodes, behaviours = (frame[frame["run"].isin(set(named))] for frame in (study.episodes, study.behaviours))
    episodes = episodes.assign(condition=episodes["run"].map(named))
    behaviours = behaviours.assign(condition=behaviours["run"].map(named))
    rows, names = [], behaviours_of(study, named)
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


def print_summary(study: Study, named: Mapping[str, str], made: dict[str, Path], hints: dict[str, str],
                  width: int | None = None) -> None:
    """Print the table of the runs in ``named`` (run -> condition), or of very many conditions how many there are; where
    everything is (``made``: what -> path), and what to type next (``hints``: why -> command). ``width``: columns to
    print in, those of the terminal if left out."""
    conditions = len(set(named.values()))
    if conditions > MOST:
        print(f"{study.path.name}: {len(named):,} runs of {conditions:,} conditions, whose means over seeds are in "
              "conditions.csv of the report")
    else:
        _print_table(study, named, width)
    lines = {"results": study.path, **made, **hints}
    wide = max(map(len, lines))
    for what, where in lines.items():
        print(f"{what:{wide}}  {where}")


def _print_table(study: Study, named: Mapping[str, str], width: int | None) -> None:
    """Means over seeds, a row a condition."""
    from rich.console import Console
    frame = summary_frame(study, named)
    console = Console(width=width or table_width(), highlight=False, force_jupyter=False)
    heads = {"early": "survival\nearly", "late": "survival\nlate", "validation": "survival\nvalid.",
             "activations": "activations\n" + " ".join(behaviours_of(study, named))}
    rows = [shown({str(name): value for name, value in row.items()}) for row in frame.to_dict("records")]
    columns = [[heads.get(str(key), str(key)), *cells] for key, cells in
               zip(frame.columns, zip(*rows, strict=True), strict=True)]
    console.print(f"{study.path.name}: means over seeds", markup=False)
    for part in parts_of(columns, console.width):
        console.print(_table(part, console.width))


def parts_of(columns: list[list[str]], width: int) -> list[list[list[str]]]:
    """Columns (head, then a cell a row) in as many tables as it takes to fit ``width``; each begins with the first
    column, the condition."""
    first, *others = columns
    left = min(_wide(first), width // 2)
    parts, room = [[first]], width - left - EDGES
    for column in others:
        if len(parts[-1]) > 1 and _wide(column) + 1 > room:
            parts.append([first])
            room = width - left - EDGES
        parts[-1].append(column)
        room -= _wide(column) + 1
    return parts


def _wide(column: list[str]) -> int:
    return max(len(line) for cell in column for line in cell.split("\n")) + 1


def _table(columns: list[list[str]], width: int) -> Table:
    """A table whose first column is never cut: it goes on in the next line. "survival" stands once over its columns."""
    from rich import box
    from rich.table import Table
    from rich.text import Text
    table, before = Table(box=box.SIMPLE_HEAD, padding=(0, 1), collapse_padding=True, pad_edge=False), ""
    for i, (head, *_) in enumerate(columns):
        above, _, below = head.rpartition("\n")
        text = f"\n{below}" if above and above == before else head
        left = min(_wide(columns[0]) - 1, width // 2) if i == 0 else None
        table.add_column(Text(text), justify="left" if i == 0 or "activations" in head else "right", overflow="fold",
                         no_wrap=i > 0, width=left)
        before = above
    for row in zip(*(cells for _, *cells in columns), strict=True):
        table.add_row(*map(Text, row))
    return table
