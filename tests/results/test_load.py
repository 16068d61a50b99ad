"""Studies of older versions are read."""

from __future__ import annotations

import json

import pandas as pd

from attnlab.results.load import load
from tests.report.small_study import write_run


def test_tables_of_the_first_schema_are_read_as_todays(tmp_path):
    """Rewards held their penalty, and safety was what AVOID had last perceived: the true one is not known."""
    run = write_run(tmp_path / "old", "none", 0)
    about = json.loads((run / "run.json").read_text())
    (run / "run.json").write_text(json.dumps({**about, "schema": 1}))
    for table, change in (("episodes", lambda f: f.drop(columns=[c for c in f if "held" in c])),
                          ("behaviours", lambda f: f.assign(penalty=-1500.0, reward=f["reward"] - 1500.0,
                                                            reward_extrinsic=f["reward_extrinsic"] - 1500.0))):
        before = pd.read_parquet(run / f"{table}.parquet")
        change(before).to_parquet(run / f"{table}.parquet")
    study = load(tmp_path / "old")
    assert study.complete == [run.name]
    assert study.behaviours["reward"].between(50, 51).all() and (study.behaviours["penalty"] == -1500).all()
    assert study.episodes["safety_mean"].isna().all() and study.episodes["safety_held_mean"].between(0.3, 0.4).all()
