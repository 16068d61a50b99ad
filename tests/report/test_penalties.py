"""Rewards and penalties apart: Table 5 on episodes that were survived, Fig 7 with penalties; both forms are shown."""

from __future__ import annotations

import csv
import io

import pandas as pd
import pytest

from attnlab.audit.table import load_table
from attnlab.figures.base import FigureContext, make
from attnlab.figures.style import drawing
from attnlab.report import table5
from attnlab.results import load
from attnlab.results.conditions import Conditions
from tests.report.small_study import write_study


@pytest.fixture
def conditions(tmp_path):
    """Two seeds, four validation episodes; in CR's last one, of both seeds, it crashed: AVOID paid 1500, its energy was
    another, and without the penalty AVOID earned 50 + 10 * episode (seed 0) or 150 + 10 * episode (seed 1)."""
    study = write_study(tmp_path / "died", seeds=2)
    for seed in (0, 1):
        run = study / f"litman-seed{seed}"
        episodes, behaviours = (pd.read_parquet(run / f"{table}.parquet") for table in ("episodes", "behaviours"))
        last = (episodes["phase"] == "validation") & (episodes["episode"] == 3)
        episodes.loc[last, ["death", "energy_mean"]] = ["crash", 1.0]
        mine = (behaviours["phase"] == "validation") & (behaviours["behaviour"] == "avoid")
        behaviours.loc[mine, "reward"] = 50.0 + 100 * seed + 10 * behaviours["episode"]
        behaviours.loc[mine & (behaviours["episode"] == 3), "penalty"] = -1500.0
        trained = (behaviours["phase"] == "train") & (behaviours["episode"] == 5)
        behaviours.loc[trained & (behaviours["behaviour"] == "avoid"), "penalty"] = -1500.0
        behaviours["reward_extrinsic"] = behaviours["reward"] + (2.0 if seed == 0 else 4.0)
        episodes.to_parquet(run / "episodes.parquet")
        behaviours.to_parquet(run / "behaviours.parquet")
    return Conditions(load(study), {"litman": "CR", "none": "NCR"})


def cell(conditions, quantity, condition="CR"):
    roles = {"CR": conditions.runs("litman"), "NCR": conditions.runs("none")}
    rows = table5.rows(load_table(), roles)
    return next(row for row in rows if (row.quantity, row.condition) == (quantity, condition)), rows


def test_table_5_is_held_against_episodes_that_were_survived(conditions):
    row, rows = cell(conditions, "reward.avoid")
    assert row.here == pytest.approx((110.0, 10.0, 100 / 2 ** 0.5))  # 50, 60, 70 and 150, 160, 170
    assert row.difference == pytest.approx(10.0)
    assert row.every.mean == pytest.approx(115.0 - 375.0)  # and 80, 180, less 1500, each once in four
    energy, _ = cell(conditions, "energy_mean")
    assert energy.here.mean > 4000 and energy.every.mean < 3100
    ncr, _ = cell(conditions, "reward.global", "NCR")
    assert ncr.here == pytest.approx(ncr.every)  # none of them died
    found = csv.DictReader(io.StringIO(table5.as_csv([("", rows)]).decode()))
    line = next(r for r in found if (r["quantity"], r["condition"]) == ("reward.avoid", "CR"))
    columns = ("here_mean", "here_sd_within_seeds", "all_mean", "difference")
    assert [line[column] for column in columns] == ["110", "10", "-260", "10"]
    assert table5.texts(row)[1:] == ("110 ± 10 (71)", "+10", "-260")


def test_nobody_survived(conditions):
    conditions.frame("episodes")["death"] = "crash"
    row, _ = cell(conditions, "hunger_mean")
    assert row.here is None and row.every.mean == pytest.approx(400.5, abs=0.5)
    assert table5.texts(row)[1:3] == ("-", "-")


def test_the_main_lines_of_fig_7_are_extrinsic_and_hold_penalties(conditions):
    with drawing():
        axes = make("rewards", FigureContext()).draw(conditions).axes
    lines = {line.get_label(): line for line in axes[0].lines}
    assert list(lines)[:4] == ["CR", "CR, no penalties", "CR, eq 4", "NCR"]
    assert lines["CR"].get_linewidth() > 1.5 > lines["CR, no penalties"].get_linewidth()
    gap = {name: lines[name].get_ydata() - lines["CR"].get_ydata() for name in ("CR, no penalties", "CR, eq 4")}
    assert sorted(gap["CR, no penalties"])[-1] == pytest.approx(750.0)  # one in a block of two
    assert gap["CR, eq 4"] == pytest.approx([-3.0] * 10)  # 2 and 4 less
