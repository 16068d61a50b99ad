"""Makes docs/tables.md from the schema: ``python docs/make_tables.py``. A test holds the page against it."""

from __future__ import annotations

from pathlib import Path

from attnlab.tables.schema import OF_BEHAVIOUR, RUN, SCHEMA, Column

PAGE = Path(__file__).with_name("tables.md")
ROWS = {"episodes": "a row an episode", "behaviours": "a row an episode and behaviour",
        "policy": "a row a behaviour, state and action of its learned table, at the end of training",
        "cycles": "a row a machine cycle of recorded episodes (`record=last`, `validation`, `all`, `none`)",
        "coverage": "a row a phase and cell that was visited"}
HEAD = """# Tables

Made by `python docs/make_tables.py` from `attnlab/tables/schema.py`.

A run writes five Parquet tables; `attnlab.load("outputs/STUDY")` reads those of all complete runs as pandas frames of
the same names, and adds `study` and `condition` to each. Swept settings are columns of `episodes` and `behaviours`
(`learner.alpha`, `variant`, ...). mc: machine cycles, UoE: units of energy, UoR: units of reward, 1: a plain number.
Missing values: the run has no such need, or no AVOID. Units and meanings are in the files too, as Arrow field metadata.
"""
TAIL = """
A need that a plugin brings has the columns `<need>_mean`, `<need>_max` and `<need>` as hunger has; a probe adds what it
declares ([authors.md](authors.md)).

`study.runs` has a row a run that was asked for, missing and failed ones too: `study`, `run`, `condition`, `status`,
`why`, `seed`, `curiosity`, `key`, `wall_s`, `cpu_s`, `cycles`, `error`, `overrides`, and the swept settings.
`study.config(run)` is a run's whole config.
"""


def table(columns: dict[str, Column], prefix: str = "") -> list[str]:
    """Rows of a Markdown table."""
    return [f"| `{prefix}{name}` | {column.unit} | {column.meaning} |" for name, column in columns.items()]


def page() -> str:
    """The whole page."""
    parts = [HEAD.rstrip()]
    for name, columns in SCHEMA.items():
        shown = {column: of for column, of in columns.items() if column not in RUN or name == "episodes"}
        parts += [f"\n## {name}: {ROWS[name]}\n", "| column | unit | |", "|---|---|---|", *table(shown)]
        if name == "cycles":
            parts += table(OF_BEHAVIOUR, "<behaviour>_")
        if name in ("behaviours",):
            parts.append("\nAnd `run`, `seed`, `curiosity` as above.")
        elif name != "episodes":
            parts.append("\nAnd `run` as above.")
    return "\n".join(parts) + "\n" + TAIL


if __name__ == "__main__":
    PAGE.write_text(page())
