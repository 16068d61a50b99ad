"""What an author brings shows up: a need of a behaviour's own, a box of an own kind."""

import pandas as pd
import pytest
from matplotlib.colors import to_hex

from attnlab import plot
from attnlab.claims.files import load_claims
from attnlab.claims.judge import judge
from attnlab.figures.base import FigureContext, make
from attnlab.measures.needs import needs_of, unit_of
from attnlab.report.page import headline
from attnlab.results.conditions import Conditions
from attnlab.results.load import load
from attnlab.tables.files import read_json, write_json
from attnlab.tables.yamls import read_yaml
from attnlab.testing.build import BOXES, node
from attnlab.testing.study import conditions, plant


@pytest.fixture(scope="module")
def tired(tmp_path_factory) -> Conditions:
    """Robots that rest: a need called fatigue; in their world stands a sofa."""
    world = node("world", "layout", boxes=[*BOXES, {"kind": "sofa", "x_m": 3.0, "y_m": 2.6}])
    return Conditions(load(plant(tmp_path_factory.mktemp("studies") / "tired", (0, 1), world=world,
                                 behaviours=("avoid", "eat", "drink", "rest"))))


def said(name, study):
    return make(name, FigureContext()).say(study)


def test_needs_of_a_study(tired):
    assert needs_of(tired) == ["hunger", "thirst", "fatigue"]
    assert needs_of(conditions()) == needs_of(conditions("bare")) == needs_of(conditions("empty")) == \
        ["hunger", "thirst"]


def test_it_is_drawn_within_an_episode(tired):
    drawn = plot.needs(tired)
    for ax in drawn.axes:
        assert [line.get_label() for line in ax.lines] == ["hunger", "thirst", "fatigue"]
        assert len({line.get_color() for line in ax.lines}) == 3
    assert [text.get_text() for text in drawn.legends[0].texts] == ["hunger", "thirst", "fatigue"]
    assert "fatigue fell" in said("needs", tired) and "fatigue" not in said("needs", conditions())
    assert "fatigue" in [line.get_label() for line in plot.attention_raster(tired).axes[1].lines]


def test_its_maximum_has_a_panel(tired):
    drawn = plot.maximum_need(tired)
    assert [ax.get_title(loc="left") for ax in drawn.axes] == ["Hunger", "Thirst", "Fatigue"]
    assert all(len(ax.lines) == 2 for ax in drawn.axes)
    assert "UoE fatigue" in said("maximum_need", tired)


def test_it_counts_in_the_economics(tired):
    drawn = plot.attention_economics(tired)
    assert drawn.axes[2].get_ylabel() == "mean of hunger, thirst and fatigue, UoE"
    rows = tired.runs("none").rows("episodes", phase="validation")
    by_hand = rows.groupby("seed")[["hunger_mean", "thirst_mean", "fatigue_mean"]].mean().mean(axis=1)
    marks = [line for line in drawn.axes[2].lines if len(line.get_ydata()) == 2 and line.get_alpha()]
    assert any(list(line.get_ydata()) == pytest.approx(list(by_hand)) for line in marks)


def test_a_unit_that_its_column_declares(tired, tmp_path):
    """Then it has an axis of its own, and is not added to needs in UoE."""
    import shutil

    import pyarrow as pa
    import pyarrow.parquet as pq
    assert unit_of(tired, "fatigue") == "UoE"
    study = shutil.copytree(tired.study.path, tmp_path / "volts")
    for file in study.glob("*/episodes.parquet"):
        table = pq.read_table(file)
        place = table.schema.get_field_index("fatigue_max")
        field = table.schema.field(place).with_metadata({"unit": "mV"})
        pq.write_table(table.cast(pa.schema(table.schema).set(place, field)), file)
        about = read_json(file.with_name("run.json"))
        write_json(file.with_name("run.json"), {name: of for name, of in about.items() if name != "tables"})
    volts = Conditions(load(study))
    assert unit_of(volts, "fatigue") == "mV" and unit_of(volts, "hunger") == "UoE"
    assert plot.maximum_need(volts).axes[2].get_title(loc="left") == "Fatigue, mV"
    assert plot.needs(volts).axes[0].lines[2].get_label() == "fatigue, mV"
    assert plot.attention_economics(volts).axes[2].get_ylabel() == "mean of hunger and thirst, UoE"
    assert "mV fatigue" in said("maximum_need", volts)


def test_a_claim_about_it(tired):
    from attnlab.testing import make as make_part
    found = make_part("measure", "episode", column="fatigue_max").of(tired.runs("none"))
    frame = pd.concat([tired.runs("none").rows("episodes", phase="validation")])
    assert found == {0: pytest.approx(frame[frame["seed"] == 0]["fatigue_max"].mean()),
                     1: pytest.approx(frame[frame["seed"] == 1]["fatigue_max"].mean())}


def test_an_own_kind_has_its_colour_and_a_legend(tired):
    drawn = plot.paths(tired)
    fills = {to_hex(patch.get_facecolor()) for patch in drawn.axes[0].patches}
    legend = {text.get_text(): to_hex(handle.get_facecolor())
              for text, handle in zip(drawn.legends[0].texts, drawn.legends[0].legend_handles, strict=True)}
    assert set(legend) == {"wall", "obstacle", "food", "water", "sofa"}
    assert set(legend.values()) == fills and len(fills) == 5
    assert not plot.paths(conditions()).legends


@pytest.fixture(scope="module")
def restless(tmp_path_factory) -> Conditions:
    """Robots that rest, and robots of the same curiosity that cannot."""
    folder = plant(tmp_path_factory.mktemp("studies") / "restless", (0, 1, 2), ("litman",),
                   behaviours=("avoid", "eat", "drink", "rest"))
    plant(folder, (3, 4, 5), ("litman",))
    for file in folder.glob("*/run.json"):
        names = ",".join(read_yaml(file.with_name("config.yaml").read_text())["behaviours"])
        write_json(file, {**read_json(file), "swept": {"behaviours": f"[{names}]"}})
    return Conditions(load(folder))


def test_ticks_of_a_behaviour_that_one_robot_lacks(restless):
    drawn = plot.attention_raster(restless)
    assert [len(ax.get_yticklabels()) for ax in drawn.axes[::2]] == [4, 3]


def test_its_rewards_have_room(restless):
    drawn = plot.rewards(restless)
    drawn.draw_without_rendering()
    page = drawn.get_window_extent()
    legend = drawn.legends[0].get_window_extent()
    assert page.x0 <= legend.x0 and legend.x1 <= page.x1
    labels = [ax.xaxis.label.get_window_extent() for ax in drawn.axes if ax.get_xlabel()]
    assert len(labels) == 3 and not any(a.overlaps(b) for i, a in enumerate(labels) for b in labels[:i])


@pytest.mark.parametrize("wanted", [["avoid", "eat", "drink", "rest"], ["rest", "drink", "eat", "avoid"],
                                    "[avoid,eat,drink,rest]"])
def test_a_role_by_its_behaviours(restless, wanted):
    runs, note = restless.matching({"behaviours": wanted}, {})
    assert sorted(runs.runs) == [0, 1, 2] and not note and "rest" in runs.config(0)["behaviours"]
    assert not restless.matching({"behaviours": ["avoid", "eat"]}, {})[0].runs


@pytest.mark.parametrize(("tests", "told"), [
    (["test: level, role: treatment, direction: higher, reference: 1",
      "test: level, role: control, direction: lower, reference: 99"],
     "calm is behaviours=[rest,avoid,eat,drink]; "),
    (["test: paired, direction: higher"], "<p>The one claim of <cite>Rest</cite> cannot be tested here. ")])
def test_the_page_tells_who_rests(restless, tmp_path, tests, told):
    parts = "".join(f"""
      - {{measure: {{name: survival, phase: validation}}, {test}, unit: "%"}}""" for test in tests)
    file = tmp_path / "rest.yaml"
    file.write_text(f"""
title: Rest
own: true
roles:
  treatment: {{label: calm, where: {{behaviours: [rest, avoid, eat, drink]}}}}
  control: {{label: restless, where: {{behaviours: [avoid, eat, drink]}}}}
rules: {{confidence: 0.95, least_seeds: 3}}
claims:
  one:
    title: Calm robots live
    where: page 1
    says: They survive.
    parts:{parts}
""")
    claims = load_claims(str(file))
    assert told in headline(claims, judge(claims, restless))
