"""Nine conditions: a small panel for each or a row in rank, never nine lines in one."""

import csv
import json

import numpy as np
import pytest

from attnlab.figures.base import FigureContext, make
from attnlab.figures.many import MOST_LINES
from attnlab.figures.panels import panels
from attnlab.figures.style import drawing, png_bytes
from attnlab.figures.values import as_csv, as_json, gid_of, plots
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


def test_a_ranked_figure_tells_the_value_of_every_row(conditions):
    """Read from what is drawn: name, mean and interval of each condition, at its place."""
    figure = drawn(conditions, "maximum_need")
    for plot, ax in zip(plots(figure), figure.axes, strict=True):
        assert plot.rows and sorted(line.name for line in plot.lines) == sorted(NAMES)
        for line in plot.lines:
            (mean,), ((low, high),) = line.points[:, 0], line.ends
            assert low <= mean <= high and line.gid == gid_of(line.name)
            ends = next(of.get_xdata() for of in ax.lines if of.get_gid() == line.gid and len(of.get_xdata()) == 2)
            assert (low, high) == tuple(ends)
    told = json.loads(as_json(plots(figure)))[0]
    assert told["rows"] and all(said.startswith(f"{x:.4g}"[:3]) and "[" in said
                                for line in told["lines"] for _, _, x, said in line["at"])


def test_many_economies_are_ranked(conditions, monkeypatch):
    """By survival, who survives most on top; every row tells its mean."""
    monkeypatch.setattr("attnlab.figures.economics.MOST_MARKS", 8)
    figure = drawn(conditions, "attention_economics")
    looks, lived, *_ = found = plots(figure)
    assert len(found) == 4 and all(plot.rows and len(plot.lines) == len(NAMES) for plot in found)
    means = [line.points[0, 0] for line in lived.lines]
    assert means == sorted(means) and [line.name for line in looks.lines] == [line.name for line in lived.lines]


def test_a_heat_map_tells_its_cells(conditions):
    plot = plots(drawn(conditions, "policies"))[0]
    assert plot.cells.columns[2] == "percept 3" and plot.cells.rows[:3] == ["rule0, low", "rule0, LH", "rule0, HH"]
    assert {text for row in plot.cells.said for text in row} == {
        f"period {period}, in 2 of 2" for period in (1, 12)}
    across, up = plot.at
    assert across == sorted(across) and up == sorted(up) and (across[0], across[-1]) == (plot.box[0], plot.box[2])
    rows = list(csv.DictReader(as_csv([plot]).decode().splitlines()))
    assert len(rows) == 6 * len(plot.cells.rows) and rows[0]["x"] == "percept 1" and rows[0]["line"] == "rule0, low"


@pytest.mark.parametrize("mesh", [True, False])
def test_a_heat_map_of_anybodys_tells_its_numbers(mesh):
    import matplotlib.pyplot as plt
    with drawing():
        figure, ax = plt.subplots()
        values = np.array([[1.0, 2.0, np.nan], [4.0, 5.0, 6.0]])
        if mesh:
            ax.pcolormesh([0, 1, 2, 3], [0, 2, 4], values)
        else:
            ax.imshow(values, extent=(0, 3, 0, 4), origin="lower")
        ax.set_yticks([1, 3], ["few", "many"])
        png_bytes(figure)
        (plot,) = plots(figure)
    assert plot.cells.said == [["1", "2", ""], ["4", "5", "6"]] and plot.cells.rows == ["few", "many"]
    assert plot.cells.columns == ["0.5", "1.5", "2.5"] and plot.at[1][0] > plot.at[1][-1] and not plot.lines


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
