"""Nine conditions: a small panel for each or a row in rank, never nine lines in one."""

import csv

import numpy as np
import pytest

from attnlab.figures.base import FigureContext, make
from attnlab.figures.many import MOST_LINES
from attnlab.figures.panels import panels
from attnlab.figures.style import drawing, png_bytes
from attnlab.figures.values import as_csv, gid_of, plots
from attnlab.results import load
from attnlab.results.conditions import Conditions
from tests.report.small_study import write_study

NAMES = [f"rule{i}" for i in range(9)]


@pytest.fixture(scope="module")
def conditions(tmp_path_factory):
    study = write_study(tmp_path_factory.mktemp("many") / "study", 2, tuple(NAMES), train=10, cycles=20)
    return Conditions(load(study))


def drawn(conditions, name):
    with drawing():
        figure = make(name, FigureContext()).draw(conditions)
        png_bytes(figure)
    return figure


def test_a_curve_is_a_panel_a_condition(conditions):
    axes = [ax for ax in drawn(conditions, "survival").axes if ax.get_visible()]
    assert [ax.get_title(loc="left") for ax in axes] == NAMES and len(NAMES) > MOST_LINES
    for ax, name in zip(axes, NAMES, strict=True):
        assert [line.get_label() for line in ax.lines if not line.get_label().startswith("_")] == [name]
        assert len(ax.lines) == len(NAMES)  # the others behind it


def test_rewards_and_needs_are_ranked(conditions):
    (panel,) = panels(conditions)
    for name, columns in (("rewards", 4), ("maximum_need", 2)):
        axes = drawn(conditions, name).axes
        assert len(axes) == columns
        labels = [text.get_text() for text in axes[0].get_yticklabels()]
        assert sorted(labels) == sorted(NAMES)
        places = {line.get_gid(): line.get_xdata()[0] for line in axes[-1].lines if len(line.get_xdata()) == 1}
        means = [places[gid_of(label)] for label in labels]
        assert means == sorted(means) and len(panel.lines) == len(means)


def test_the_values_of_a_figure_are_those_drawn(conditions):
    found = plots(drawn(conditions, "survival"))
    rows = list(csv.DictReader(as_csv(found).decode().splitlines()))
    episodes = conditions.frame("episodes")
    mine = episodes[(episodes["phase"] == "train") & (episodes["curiosity"] == "rule0") & (episodes["episode"] == 0)]
    first = next(row for row in rows if row["panel"] == row["line"] == "rule0")
    assert float(first["y"]) == pytest.approx(100 * mine["survival"].mean())  # blocks of one episode
    assert float(first["low"]) < float(first["y"]) < float(first["high"]) and first["x"] == "1"
    left, top, right, bottom = found[0].box
    places = found[0].lines[0].places
    assert np.all((places[:, 0] >= left) & (places[:, 0] <= right) & (places[:, 1] >= top) & (places[:, 1] <= bottom))
