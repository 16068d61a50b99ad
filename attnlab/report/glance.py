"""Every condition of a study in one table: the first thing to look at where many are compared."""

from __future__ import annotations

from collections.abc import Mapping

from attnlab.report.page import Section, table
from attnlab.results.load import Study
from attnlab.results.summary import shown, summary_frame
from attnlab.tables.csvs import frame_csv

MOST = 40


def section(study: Study, marks: Mapping[str, str]) -> tuple[Section, bytes]:
    """The table for the page (of the first 40 conditions) and as CSV (of all); ``marks``: of conditions."""
    frame = summary_frame(study, study.named())
    names = ", ".join(study.plain("behaviours")["behaviour"].unique())
    rows = [shown({str(name): value for name, value in row.items()}) for row in frame.head(MOST).to_dict("records")]
    more = f" The first {MOST} of {len(frame)}; all are in conditions.csv." if len(frame) > MOST else ""
    html = table(list(frame.columns), rows, range(1, len(frame.columns)),
                 [marks.get(row[0], "") for row in rows]) + (
        "<p class=small>Means over seeds. Early, late, validation: survival in % of the episode, first and second "
        "half of training and in validation. The rest over validation episodes: crashed in % of them, needs and energy "
        "in UoE, safety by eq 13, "
        f"activations an episode of {names}.{more}</p>")
    csv = frame_csv(frame, "%.6g")
    return Section("conditions", "Conditions at a glance", html), csv
